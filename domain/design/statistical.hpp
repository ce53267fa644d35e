#pragma once

#include "domain/target/target.hpp"
#include "domain/theory/theory.hpp"

#include <atomic>

namespace rough {

/// The task of a design that returns statistical parameters instead of heights: H, long and short cut-off,
/// and rms slope. A theory predicts that surfaces with these parameters have the target's curve. The body is
/// periodic, so K = K_i.
struct StatisticalTask {
    Target target;                   ///< stiffness or contact area against pressure
    Theory theory = Theory::persson; ///< theory that predicts the curves
    bool is_area = true;             ///< true: isotropic surfaces; false: profiles
    double effective_modulus = 1;    ///< E*, MPa
    double length = 1;               ///< length L of the surfaces, mm
    Index nodes = 128;               ///< nodes per side; the shortest wavelength is 8 node spacings
};

/// The result of a search for parameters.
struct StatisticalAnswer {
    SelfAffine parameters;     ///< the parameters that were found
    Eigen::VectorXd predicted; ///< the target's quantity at its points, as the theory predicts it
    double similarity = 0;     ///< similarity (Eq. 12) of the predicted curve
    long evaluations = 0;      ///< number of predicted curves
};

/// Searches by a pipeline that is given as text. The ranges are H from 0.3 to 0.95 and the long cut-off from
/// L/8 to L/2. The short cut-off is from 8 node spacings to half the long cut-off. The slope is from 0.001 to
/// 1. The result does not depend on `threads`.
/// Throws InputError on a target that theories do not predict and ga::UsageError on an invalid pipeline.
StatisticalAnswer statistical_design(const StatisticalTask& task, const std::string& pipeline,
                                     std::uint64_t seed, int threads = 0,
                                     const std::atomic<bool>* stop = nullptr);

/// A surface with the parameters of an answer, and its exact curve.
struct RealisedAnswer {
    Profile surface;       ///< heights, mm
    Eigen::VectorXd exact; ///< the target's quantity at its points (tangents); NaN beyond full contact
    double similarity = 0; ///< similarity of the exact curve; NaN if a point is NaN
};
/// The surface that the seed gives, and its solved curve.
RealisedAnswer realised_answer(const StatisticalTask& task, const SelfAffine& parameters, std::uint64_t seed);

} // namespace rough
