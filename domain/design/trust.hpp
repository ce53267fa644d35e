#pragma once

#include "domain/design/search.hpp"

#include <atomic>
#include <limits>
#include <optional>

namespace rough {

/// How an answer is put to the test.
struct TrustOptions {
    int phase_draws = 30;   ///< how many genomes with phases drawn anew
    double hardness = 0;    ///< MPa: no node bears more, the measured target's neither; 0: not given
    std::uint64_t seed = 1; ///< of noise and redrawn phases
    int threads = 0;        ///< 0: all
    double seconds = std::numeric_limits<double>::infinity(); ///< what is not done by then is left out
    const std::atomic<bool>* stop = nullptr; ///< somebody asks it to end, as if the seconds were over
};

/// One way to ask the same again, and the similarity it gives; NaN where it has no answer.
struct Check {
    std::string name;     ///< what was asked, in words
    double similarity;    ///< NaN: no answer
    bool decides = false; ///< noise, tilt or hardness that was given: an answer is to hold under it
};

/// How far an answer is to be believed.
struct Trust {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN(); ///< of what was not tried
    std::vector<Check> checks; ///< as designed, finer grids, more load steps, farther datum, noise, tilt,
                               ///< nodes held at the hardness where the peaks would flow
    /// The least similarity of checks that decide; NaN where there is none, or one without an answer.
    double under = unknown;
    bool all_decided = true;    ///< no check that decides was left out
    double median = unknown;    ///< of the checks' similarities
    double tenth = unknown;     ///< tenth percentile of the checks' similarities
    std::vector<Check> kernels; ///< the same profile on other bodies, for comparison: no check of the answer
    /// Similarity of genomes of the same spectrum with phases drawn anew (amplitude by Eq. 11, or fitted):
    /// where the best of them is near the answer the spectrum does it, where it is not the phases do.
    double redrawn_best = unknown;
    double redrawn_median = unknown;   ///< as redrawn_best, the median
    double redrawn_tenth = unknown;    ///< as redrawn_best, the tenth percentile
    int redrawn = 0;                   ///< how many were drawn
    double rms_slope = 0;              ///< of the profile, dimensionless
    double peak_pressure = 0;          ///< highest node pressure at the last load step, MPa
    double shortest_wave_nodes = 0;    ///< in units of the grid's spacing
    bool contact_at_ends = false;      ///< of a free or strip profile, at the last load step
    ContactState last;                 ///< what touches at the last load step
    std::vector<std::string> flags;    ///< where the model strains, a line each
    std::vector<std::string> left_out; ///< what there was no time for
};

/// Re-verifies a genome in final amplitude, under the set-up's errors too, whose response as designed may be
/// given (response_of). On an area what the search has verified already is taken from its answer, where that
/// is given: a fine area's curve costs a minute; what it had no time for is left out. The datum's change is
/// exact on the target side: 1/K(4 d) = 1/K(d)
/// + (2 L/(pi E*)) ln 4 at the same load, displacements grow by (2 P L/(pi E*)) ln 4, areas and interface
/// stiffness stay.
Trust trust_in(const DesignSetup& setup, const Genome& genome, const TrustOptions& options,
               const Answer* verified = nullptr, const DesignResponse* own = nullptr);

/// The targets as they read with the datum `factor` times farther; free kernel only. A target against
/// displacement has no reading of its own where the load at its points is not known, and is left out.
std::vector<Target> with_datum(const std::vector<Target>& targets, const Model& model, double factor);

/// One source of error of a designed surface.
struct ErrorSource {
    std::string kind;   ///< model, numerical or target
    std::string source; ///< in words
    double size = 0;    ///< largest relative change of the curve at the target's points, or the mismatch left
};

/// By how much an answer's curve moves at the first target's points when one thing at a time is changed, Eq.
/// 11 anew where it applies: the body, the grid, the load steps, the accuracy the search was allowed; and
/// what is left of the target's mismatch.
std::vector<ErrorSource> error_budget(const DesignSetup& setup, const Answer& answer);

} // namespace rough
