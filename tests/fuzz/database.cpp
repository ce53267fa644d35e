#include "tests/domain/database/small_setup.hpp"
#include "tests/fuzz/reader.hpp"

FUZZ(database) { rough::testing::read_all(fuzz::as_file(bytes)); }
