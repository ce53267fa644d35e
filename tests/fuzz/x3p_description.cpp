#include "domain/scan/height_map.hpp"
#include "domain/text/zip.hpp"
#include "tests/fuzz/reader.hpp"

/// main.xml in an archive without its check sum, which altered bytes would not pass.
FUZZ(x3p_description) {
    const std::string part(bytes);
    rough::read_x3p(
        rough::zipped({{"main.xml", part}, {"bindata/data.bin", part}, {"bindata/valid.bin", part}}), "map");
}
