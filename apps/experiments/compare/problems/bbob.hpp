#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace app {

/// One of BBOB's 24 noiseless functions (Hansen, Finck, Ros and Auger 2009, INRIA RR-6829), in an instance of
/// COCO. Lower is better. Optima lie in [-5, 5]^n, and the functions are defined everywhere.
class Bbob {
  public:
    static constexpr int functions = 24;

    /// @param function   1 to 24
    /// @param dimension  2 to 40
    /// @param instance   from 1
    Bbob(int function, int dimension, int instance);

    double operator()(const std::vector<double>& x) const;
    const std::vector<double>& optimum() const { return optimum_; } ///< the best x
    double value() const { return value_; }                         ///< the function's value there

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
    Array heights_;                             ///< heights of Gallagher's peaks
    Eigen::ArrayXXd peaks_, widths_;            ///< one column per peak
    std::vector<double> optimum_;
};

} // namespace app

/// BBOB's random generator of 2009, which gives instances the optima, rotations and peaks of COCO.
namespace app::bbob {

/// n numbers in (0, 1): Park and Miller's minimal generator (1988) through a shuffling table of 32 (Bays and
/// Durham 1976).
std::vector<double> uniform(std::size_t n, long seed);

/// n normal numbers (Box and Muller 1958).
std::vector<double> gauss(std::size_t n, long seed);

/// An orthogonal matrix by Gram and Schmidt from normal columns.
Eigen::MatrixXd rotation(int dimension, long seed);

/// The optimum, on a lattice of 8e-4 in [-4, 4]^n.
Eigen::VectorXd place_of_optimum(int dimension, long seed);

/// The seed of a function's instance; 3 and 4, 17 and 18 share theirs.
long seed_of(int function, int instance);

/// The value at the optimum: 100 times a ratio of normal numbers, with two decimals, from -1000 to 1000.
double value_of_optimum(int function, int instance);

} // namespace app::bbob
