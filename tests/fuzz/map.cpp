#include "domain/scan/scan.hpp"
#include "tests/fuzz/reader.hpp"

FUZZ(map) { // a matrix of numbers needs a spacing, which other formats give themselves
    const bool is_matrix = !bytes.empty() && bytes[0] >= '0' && bytes[0] <= '9';
    rough::read_map(fuzz::as_file(bytes), {.spacing = is_matrix ? 0.001 : 0, .fill = true});
}
