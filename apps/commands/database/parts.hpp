#pragma once

#include "apps/cluster/cluster.hpp"
#include "apps/commands/commands.hpp"
#include "domain/database/build.hpp"

namespace app {

/// The parts of 'rugosa database': each takes the words behind its own name.
int database_build(const Words& words);
int database_info(const Words& words);
int database_merge(const Words& words);
int database_query(const Words& words);

/// Responses computed on so many threads of every rank.
rough::Computing computing_on_ranks(int threads);
/// What each rank does for it: from a genome's number to its response.
cluster::Work responses_under(const nlohmann::json& setting);

} // namespace app
