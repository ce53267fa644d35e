#pragma once

#include "domain/problem/response.hpp"

namespace rough {

/// Gaussian height noise of rms 1 and autocorrelation exp(-(d/length)^2) at the distance d, sampled at the
/// grid's nodes. The field belongs to the line or map: equal seeds give the same field on every grid. It is a
/// Fourier series of period 2 L, or L if the grid is periodic.
Eigen::VectorXd height_noise(const Grid& grid, double length, std::uint64_t seed);

/// Heights of a plane that rises by 1 over the length; then, for a map, of one that does so over the width.
std::vector<Eigen::VectorXd> unit_tilts(const Grid& grid);

/// A surface that is manufactured with errors in its heights. Eq. 11 does not rescale these heights, and
/// displacement counts from their first touch. The surface is loaded as far as in the search.
class SurfaceWithErrors {
  public:
    SurfaceWithErrors(DesignSetup setup, Genome genome); ///< the surface of a genome from in_final_form()

    const Profile& surface() const { return surface_; } ///< the surface without errors
    /// Response with these errors of the heights (mm, N entries). Throws what respond() throws.
    DesignResponse response(const Eigen::VectorXd& errors) const;
    /// Similarity with these errors of the heights; -infinity without a response. Throws
    /// ga::Stopped if ContactOptions::stop ends the solution.
    double similarity(const Eigen::VectorXd& errors) const;
    /// Misfits with these errors, and their derivatives with respect to the genes. `plain` are the rows of the genome
    /// without errors, because under Eq. 11 the amplitude depends on the genes. Throws what respond() throws.
    ga::Sensitivity misfits(const Eigen::VectorXd& errors, const Rows& plain) const;

  private:
    DesignSetup setup_; ///< without Eq. 11
    Genome genome_;
    Profile surface_;
    std::vector<Loading> loadings_;
};

/// The errors of a search, equal for every genome: fixed draws of noise, and each tilt in both directions.
struct CommonErrors {
    explicit CommonErrors(const DesignSetup& setup); ///< the errors of a set-up
    std::vector<Eigen::VectorXd> noise = {};         ///< errors of the heights in each draw, mm
    std::vector<Eigen::VectorXd> tilts = {};         ///< errors of the heights for each tilt, mm
    /// The lower of two similarities; 1 without errors. The first is the mean of the lowest tenth of the
    /// similarities under noise. This mean is near the similarity that 95 % of the draws keep, and changes
    /// smoothly. The second is the lowest similarity over the tilts.
    double similarity(const SurfaceWithErrors& made) const;
};

} // namespace rough
