#pragma once

#include "domain/design/search.hpp"

namespace rough {

/// Options of the checks of an answer.
struct TrustOptions {
    int phase_draws = 30;                                     ///< number of genomes with redrawn phases
    std::optional<double> hardness = {};                      ///< hardness of the answer and of a measured target, MPa
    std::uint64_t seed = 1;                                   ///< seed of the noise and of the redrawn phases
    int threads = 0;                                          ///< number of threads; 0: all
    double seconds = std::numeric_limits<double>::infinity(); ///< wall time of all checks, s
    const std::atomic<bool>* stop = nullptr;                  ///< true ends the checks, as `seconds` does
};

/// The similarity of an answer under one change of the model or the heights.
struct Check {
    std::string name;  ///< the change, in words
    double similarity; ///< similarity under the change; NaN: no response
    /// Whether the verdict depends on this check. It does for a given noise, tilt or hardness.
    bool decides = false;
};

/// The results of the checks of an answer.
struct Trust {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN(); ///< value if not checked
    /// The checks: as designed, finer grids, more load steps, farther datum, noise, tilt, hardness.
    std::vector<Check> checks;
    double under = unknown;     ///< lowest similarity of the checks that decide; NaN if one has no response
    bool all_decided = true;    ///< whether all checks that decide were made
    std::vector<Check> kernels; ///< similarities of the profile on other bodies, only for comparison
    /// Similarities of genomes with the answer's spectrum, redrawn phases and a fitted amplitude; of a map on half of
    /// its nodes along each side. If the highest is near the similarity of the answer, the response follows from the
    /// spectrum. Otherwise the response follows from the phases.
    std::vector<double> redrawn;
    double rms_slope = 0;              ///< root mean square slope of the profile, dimensionless
    double peak_pressure = 0;          ///< highest node pressure at the last load step, MPa
    double shortest_wave_nodes = 0;    ///< shortest wavelength in units of the node spacing
    bool contact_at_ends = false;      ///< whether an end touches at the last load step; false if periodic
    ContactState last;                 ///< contact at the last load step
    std::vector<std::string> flags;    ///< doubtful assumptions of the model, one line each
    std::vector<std::string> left_out; ///< names of the checks that were omitted for lack of time
};

/// Checks a genome under changes of the model and under the set-up's errors. The genome must be in its final form
/// (in_final_form()). Three similarities are taken from `verified`, if it is given: as designed, with more nodes, and
/// with more load steps. Those that are NaN are left out. The check with a farther datum uses the targets of
/// with_datum(). `designed` is response_of(), if known.
Trust trust_in(DesignSetup setup, const Genome& genome, const TrustOptions& options, const Answer* verified = nullptr,
               const DesignResponse* designed = nullptr);

/// Converts targets exactly to a datum that is `factor` times the model's. Only for the free kernel. With c =
/// (2 L/(pi E*)) ln factor, 1/K grows by c and displacements grow by c P at equal load. Contact area against
/// pressure and interface stiffness do not change. Targets that cannot be converted are left out: area
/// against displacement, and load against displacement with a band.
std::vector<Target> with_datum(const std::vector<Target>& targets, const Model& model, double factor);

} // namespace rough
