#include "domain/scan/x3p.hpp"
#include "tests/fuzz/reader.hpp"

/// main.xml alone: altered, it would not pass its archive's check sum.
FUZZ(x3p_description) {
    const auto entry = [&](const std::string&, std::size_t most) {
        return std::optional<std::string>(std::string(bytes.substr(0, most)));
    };
    rough::read_x3p_description(std::string(bytes), entry, "map");
}
