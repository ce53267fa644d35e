#pragma once

#include "domain/target/target.hpp"
#include "domain/theory/theory.hpp"

#include <atomic>

namespace rough {

/// A design that gives no heights. It gives the statistical parameters (H, long and short cut-off, rms slope)
/// of a surface for which a theory predicts the target. The body is periodic, so K = K_i.
struct StatisticalTask {
    Target target;                   ///< stiffness or contact area against pressure
    Theory theory = Theory::persson; ///< predicts the curves
    bool is_area = true;             ///< isotropic surfaces; false: profiles
    double effective_modulus = 1;    ///< E*, MPa
    double length = 1;               ///< L of the surfaces, mm
    Index nodes = 128;               ///< nodes per side; the shortest wavelength is 8 node spacings
};

/// The result of a search for parameters.
struct StatisticalAnswer {
    SelfAffine parameters;     ///< found
    Eigen::VectorXd predicted; ///< the target's quantity at its points, by the theory
    double similarity = 0;     ///< Eq. 12, for this curve
    long evaluations = 0;      ///< predicted curves
};

/// Searches by a pipeline given as text. Ranges: H 0.3 to 0.95, long cut-off L/8 to L/2, short cut-off 8
/// nodes to half the long one, slope 0.001 to 1. The result does not depend on `threads`.
/// Throws InputError on a target that theories do not predict and ga::UsageError on an invalid pipeline.
StatisticalAnswer statistical_design(const StatisticalTask& task, const std::string& pipeline,
                                     std::uint64_t seed, int threads = 0,
                                     const std::atomic<bool>* stop = nullptr);

/// One surface of an answer, and its exact curve.
struct RealisedAnswer {
    Profile surface;       ///< mm
    Eigen::VectorXd exact; ///< the target's quantity at its points (tangents); NaN beyond full contact
    double similarity = 0; ///< NaN if a point is NaN
};
/// The surface of that seed and its solved curve.
RealisedAnswer realised_answer(const StatisticalTask& task, const SelfAffine& parameters, std::uint64_t seed);

} // namespace rough
