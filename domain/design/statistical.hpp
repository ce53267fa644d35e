#pragma once

#include "domain/target/target.hpp"
#include "domain/theory/random_surface.hpp"
#include "domain/theory/theory.hpp"

#include <atomic>
#include <cstdint>

namespace rough {

/// A design without heights: which statistical parameters (H, long and short cut-off, rms slope) of a surface
/// have a curve, as a theory foretells it. The body is periodic, so that K = K_i.
struct StatisticalTask {
    Target target;                   ///< a stiffness or an area, against pressure
    Theory theory = Theory::persson; ///< that foretells curves
    bool is_area = true;             ///< surfaces of every direction; false: profiles
    double effective_modulus = 1;    ///< E*, MPa
    double length = 1;               ///< L of the surfaces, mm
    Index nodes = 128;               ///< of them, a side; no wave is shorter than 8 nodes
};

/// What a search found.
struct StatisticalAnswer {
    SelfAffine parameters;    ///< the surface's
    Eigen::VectorXd foretold; ///< the target's quantity at its points, by the theory
    double similarity = 0;    ///< of that curve, Eq. 12
    long evaluations = 0;     ///< curves foretold
};

/// Searches by a pipeline in text over H from 0.3 to 0.95, long cut-offs from L/8 to L/2, short ones between
/// 8 nodes and half of the long one, slopes from 0.001 to 1. Throws InputError on a target that no theory
/// foretells, ga::UsageError on a pipeline that does not fit. `threads` decides no result.
StatisticalAnswer statistical_design(const StatisticalTask& task, const std::string& pipeline,
                                     std::uint64_t seed, int threads = 0,
                                     const std::atomic<bool>* stop = nullptr);

/// One surface of an answer, and its exact curve.
struct RealisedAnswer {
    Profile surface;       ///< mm
    Eigen::VectorXd exact; ///< the target's quantity at its points (tangents); no number beyond full contact
    double similarity = 0; ///< no number where a point has none
};
/// The surface of that seed, solved.
RealisedAnswer realised_answer(const StatisticalTask& task, const SelfAffine& parameters, std::uint64_t seed);

} // namespace rough
