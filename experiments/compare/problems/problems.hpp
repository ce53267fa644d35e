#pragma once

#include "experiments/compare/race.hpp"

#include <Eigen/Core>

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

/// A random knapsack of Pisinger's weakly correlated kind. Weights and values are whole, 1 to 100, and a
/// value is within 20 of its weight. The capacity is half of all weight. The precision is relative.
BitsInstance knapsack_instance(std::size_t things, std::uint64_t seed);

using Town = std::array<double, 2>;

/// Towns drawn uniformly in the unit square.
std::vector<Town> scattered_towns(std::size_t count, std::uint64_t seed);
/// Length of a closed tour.
double tour_length(const std::vector<Town>& towns, const std::vector<std::uint32_t>& order);
/// Length of the shortest tour, by dynamic programming over sets (Held and Karp 1962); up to 16 towns.
double shortest_tour(const std::vector<Town>& towns);

/// A tour of scattered towns (up to 16); the precision is relative.
TourInstance scattered_instance(std::size_t count, std::uint64_t seed);

/// berlin52 of TSPLIB (Reinelt 1991). Distances are rounded; the optimum is 7542.
TourInstance berlin_instance();
/// A square grid of towns with an even side. The shortest tour has one unit for each town.
TourInstance grid_instance(std::size_t side);
/// The job shop ft10 (Fisher and Thompson 1963); the optimum is 930. A permutation of the 100 operations is a
/// list of priorities. It gives an active schedule (Giffler and Thompson 1960).
TourInstance job_shop_instance();

/// Names of test problems with a known front, with the numbers of genes of their papers. Two objectives: zdt1
/// to zdt4 and zdt6 (Zitzler, Deb and Thiele 2000). Three: dtlz1, dtlz2 and dtlz7 (Deb, Thiele, Laumanns and
/// Zitzler 2005). dtlz2-5 is dtlz2 with five objectives.
std::vector<std::string> front_problems();

/// One of them by name.
RealInstance front_instance(const std::string& name);

/// Names of the functions g01 to g11 of CEC 2006 (Liang et al. 2006, Problem definitions and evaluation
/// criteria for the CEC 2006 special session on constrained real-parameter optimization).
std::vector<std::string> constrained_problems();

/// One of them by name. An equality holds up to 1e-4.
RealInstance constrained_instance(const std::string& name);

} // namespace app
