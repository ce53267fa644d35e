#pragma once

#include "domain/mwm/sampling.hpp"
#include "ga/refinement/landscape.hpp"

namespace rough {

/// The bounds within which a design may move its genes. Lengths in mm.
struct GeneBounds {
    double H_from = 0.05;     ///< lowest Hurst exponent
    double H_to = 2.5;        ///< highest Hurst exponent
    double gamma_from = 1.05; ///< lowest ratio of neighbouring wavenumbers, > 1
    double gamma_to = 4;      ///< highest ratio of neighbouring wavenumbers
    double lambda_from = 0;   ///< lowest value of a series' longest wavelength, mm
    double lambda_to = 0;     ///< highest value of a series' longest wavelength, mm
};

/// The largest change of a phase from its value before the first refinement: the sum of two parts.
struct PhaseReach {
    double relative = 0.1; ///< part that is this share of the phase's value; it hardly moves phases near 0
    double absolute = 0;   ///< constant part, rad
};

/// Chooses chromosomes by the indices of the series and of the chromosome in it.
using ChosenChromosomes = std::function<bool(std::size_t series, std::size_t chromosome)>;

/// A variable for each phase of the genome, or only of the chosen chromosomes.
std::vector<ga::Variable> phase_variables(const Genome& genome, PhaseReach reach, const ChosenChromosomes& chosen = {});

/// Limits of manufacturing. By default nothing is limited.
struct MakingLimits {
    static constexpr double none = std::numeric_limits<double>::infinity(); ///< no upper limit
    double shortest_wave = 0;                                               ///< shortest wavelength, mm
    double max_slope = none;  ///< largest |dZ/dx| of a profile, or gradient of a map
    double max_height = none; ///< largest height range max Z - min Z, mm
    double min_radius = 0;    ///< smallest radius of curvature 1/|d2Z/dx2|, in any direction of a map, mm

    /// Whether slope, height or radius is limited, not only the wavelengths.
    bool any_shape() const { return max_slope < none || max_height < none || min_radius > 0; }
};

/// A limit and the genome's value.
struct Margin {
    std::string name; ///< "shortest_wave_mm", "slope", "height_mm", "radius_mm"
    double limit;     ///< the limit; 0 or infinity: no limit
    double value;     ///< the genome's value, or a bound of it that errs on the safe side
    bool is_lower;    ///< whether the limit is a lower limit
    /// Whether the value keeps the limit.
    bool holds() const { return is_lower ? value >= limit : value <= limit; }
    bool is_limited() const { return limit > 0 && limit < MakingLimits::none; } ///< whether there is a limit
    /// The relative distance from the limit: 1 - value/limit, for a lower limit 1 - limit/value. It is
    /// negative beyond the limit, and 1 without a limit.
    double margin() const { return 1 - (is_lower ? limit / value : value / limit); }
};

/// A genome's shortest wavelength, largest slope, height range and smallest radius of curvature over [0,
/// length]. They are found on a grid eight times finer than `grid` (a map: four times). A bound for points
/// between the nodes is added, so that a finer grid never shows a larger value.
std::vector<Margin> margins(const Genome& genome, const Grid& grid, const MakingLimits& limits);

/// The sum of the relative excesses of slope, height and curvature over their limits; 0 within the limits.
double excess(const Genome& genome, const Grid& grid, const MakingLimits& limits);

/// The residuals max(0, value/limit - (1 - guard)) of the limits on shape, and their derivatives with respect
/// to every gene. There is one row per limit; it is 0 if the limit, tightened by the share `guard`, is kept.
/// Derivatives are central differences of the profile at the position of the extreme. If the genome's scale
/// depends on the genes, `d_scale` has its derivatives; otherwise it is empty.
ga::Sensitivity limit_rows(const Genome& genome, const Grid& grid, const MakingLimits& limits, double guard,
                           const Eigen::RowVectorXd& d_scale = {});

} // namespace rough
