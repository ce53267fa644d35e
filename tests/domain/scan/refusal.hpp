#pragma once

#include "domain/errors.hpp"
#include "tests/catch.hpp"

namespace rough::testing {

/// The one line with which a file is refused.
std::string refusal_of(auto reading) {
    try {
        return "read as " + reading().account;
    } catch (const InputError& error) {
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
        return error.what();
    }
}

} // namespace rough::testing
