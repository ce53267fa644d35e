#include "domain/target/goal.hpp"
#include "tests/fuzz/reader.hpp"

FUZZ(target) { rough::read_goal(fuzz::as_file(bytes), 1); }
