#include "domain/target/target.hpp"

#include "tests/fuzz/reader.hpp"

FUZZ(target) {
    rough::read_target(fuzz::as_file(bytes), {.nominal_area = 1, .resistivity = 1, .thermal_resistivity = 1});
}
