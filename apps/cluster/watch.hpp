#pragma once

#include <thread>

namespace app::crew {

/// Ends the run with a line on stderr where MPI on this rank takes longer than half of --patience, while the
/// thread lasts: so before others miss this rank.
std::jthread watch();

} // namespace app::crew
