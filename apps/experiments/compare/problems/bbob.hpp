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
