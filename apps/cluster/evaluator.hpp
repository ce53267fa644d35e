#pragma once

#include "apps/cluster/cluster.hpp"
#include "domain/database/build.hpp"
#include "domain/problem/problem.hpp"
#include "ga/run/evaluator.hpp"

namespace app {

/// Evaluates designs on this many threads (0: all) of every rank. The bits do not depend on the ranks.
std::unique_ptr<ga::Evaluator<rough::DesignProblem>> design_evaluator(int threads);

/// The work of each rank for the set-ups of a search and of one of its blocks: outcomes of genomes, and derivatives.
cluster::Work designs_under(const nlohmann::json& setups);

/// Computes the responses of a database on this many threads of every rank.
rough::Computing computing_on_ranks(int threads);
/// The work of each rank: from a genome's number to its response.
cluster::Work responses_under(const nlohmann::json& setting);

} // namespace app
