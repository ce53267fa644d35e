#pragma once

#include "apps/commands/commands.hpp"

namespace app {

/// The parts of 'rugosa database': each takes the words behind its own name.
int database_build(const Words& words);
int database_info(const Words& words);
int database_query(const Words& words);

} // namespace app
