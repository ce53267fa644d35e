#include "domain/scan/scan.hpp"

#include "tests/fuzz/reader.hpp"

FUZZ(map) { rough::read_map(fuzz::as_file(bytes), {.spacing = 0.001, .fill = true}); }
