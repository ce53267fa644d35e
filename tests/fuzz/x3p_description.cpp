#include "domain/scan/height_map.hpp"
#include "tests/fuzz/reader.hpp"

/// Only main.xml: in an archive, the altered file would fail the checksum.
FUZZ(x3p_description) {
    const auto read = [&](const std::string&, std::size_t max_size, const auto& take) {
        return take(bytes.substr(0, max_size)), true;
    };
    rough::read_x3p_description(std::string(bytes), read, "map");
}
