#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace app {

/// One of BBOB's 24 noiseless functions (Hansen, Finck, Ros and Auger 2009, INRIA RR-6829), in an instance of
/// COCO's: less is better, optima lie in [-5, 5]^n, functions are defined everywhere.
class Bbob {
  public:
    static constexpr int functions = 24;

    /// @param function   1 to 24
    /// @param dimension  2 to 40
    /// @param instance   from 1
    Bbob(int function, int dimension, int instance);

    double operator()(const std::vector<double>& x) const;
    const std::vector<double>& optimum() const { return optimum_; } ///< the best x
    double value() const { return value_; }                         ///< what it is worth

  private:
    using Array = Eigen::ArrayXd;

    double above(const Array& x) const; ///< the value less the optimum's
    double step_ellipsoid(const Array& x) const;
    double schwefel(const Array& x) const;
    double gallagher(const Array& x) const;
    double lunacek(const Array& x) const;
    void draw_peaks(long seed);
    Array scales(double condition) const; ///< the diagonal of Lambda^condition
    Array turned(const Array& x) const { return (first_ * x.matrix()).array(); }

    int function_, dimension_;
    double value_;
    Array ramp_;                                ///< 0 to 1 over the coordinates
    Array shift_;                               ///< x_opt of the report, or its signs
    Eigen::MatrixXd first_, second_, combined_; ///< R, Q and R Lambda Q of the report
    Array heights_;                             ///< of Gallagher's peaks
    Eigen::ArrayXXd peaks_, widths_;            ///< a column a peak
    std::vector<double> optimum_;
};

} // namespace app

/// What BBOB's functions draw by: its generator of 2009, so that instances have COCO's own optima, rotations
/// and peaks.
namespace app::bbob {

/// n numbers in (0, 1): Park and Miller's minimal generator (1988) through a shuffling table of 32 (Bays and
/// Durham 1976).
std::vector<double> uniform(std::size_t n, long seed);

/// n normal numbers (Box and Muller 1958).
std::vector<double> gauss(std::size_t n, long seed);

/// An orthogonal matrix of normal columns, made so by Gram and Schmidt.
Eigen::MatrixXd rotation(int dimension, long seed);

/// Where an optimum lies, on a lattice of 8e-4 in [-4, 4]^n.
Eigen::VectorXd place_of_optimum(int dimension, long seed);

/// The seed of a function's instance; 3 and 4, 17 and 18 share theirs.
long seed_of(int function, int instance);

/// An optimum's value: a ratio of normal numbers, times 100, to two digits behind the point, within 1000 of
/// 0.
double value_of_optimum(int function, int instance);

} // namespace app::bbob
