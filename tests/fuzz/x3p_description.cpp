#include "domain/scan/map.hpp"
#include "domain/text/zip.hpp"
#include "tests/fuzz/reader.hpp"

/// Only main.xml: in an archive, the altered file would fail the checksum. The other entries have the sizes
/// that the corpus names, 18 heights of 4 bytes and 18 bits.
FUZZ(x3p_description) {
    const std::string part(bytes);
    const std::string archive = rough::zipped(
        {{"main.xml", part}, {"bindata/data.bin", std::string(72, 1)}, {"bindata/valid.bin", std::string(3, 1)}});
    rough::read_x3p(rough::Zip(archive, "map"), "map");
}
