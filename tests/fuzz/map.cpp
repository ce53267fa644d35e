#include "domain/scan/map.hpp"

#include "tests/fuzz/reader.hpp"

FUZZ(map) { rough::binary_map(std::string(bytes), "map"); }
