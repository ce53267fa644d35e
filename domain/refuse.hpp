#pragma once

#include "domain/errors.hpp"

#include <sstream>

namespace rough {

/// Throws InputError with its parts put together; numbers to nine digits.
template <typename... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
    std::ostringstream line;
    line.precision(9);
    (line << ... << parts);
    throw InputError(line.str());
}

} // namespace rough
