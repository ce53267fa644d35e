#pragma once

#include <string>

namespace app::crew {

/// What every rank but 0 does: what rank 0 hands out, until that says that there is nothing more.
[[noreturn]] void serve(const std::string& introduction);

} // namespace app::crew
