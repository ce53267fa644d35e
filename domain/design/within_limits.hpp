#pragma once

#include "domain/problem/problem.hpp"
#include "ga/run.hpp"

#include <optional>

namespace rough {

/// The best genome within the limits that is to be had from genomes outside them: each as it is, and without
/// so many of its shortest waves that it exceeds the limits least, refined by Levenberg-Marquardt. Nothing
/// where all stay outside. `run` has seed, threads and budget; what is spent is added to `spent`.
std::optional<Genome> brought_within(const DesignProblem& problem, const std::vector<Genome>& genomes,
                                     const ga::RunOptions& run, ga::Counters& spent);

} // namespace rough
