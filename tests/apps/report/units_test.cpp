#include "apps/prompt/units.hpp"
#include "tests/catch.hpp"

#include <cmath>

using namespace app;

TEST_CASE("a quantity is shown in a suitable unit") {
    CHECK(pressure_unit(1.6e-4).name == "Pa");
    CHECK(pressure_unit(0.04).name == "kPa");
    CHECK(pressure_unit(2).name == "MPa");
    CHECK(pressure_unit(5e4).name == "GPa");
    CHECK(length_unit(1.2e-4).name == "nm");
    CHECK(length_unit(0.00099999).name == "µm"); // 1.00, not 1000 nm
    CHECK(length_unit(0.02).name == "µm");
    CHECK(length_unit(0.85 * 2e3).name == "m");
    CHECK(0.02 * length_unit(0.02).factor == Approx(20));
}

TEST_CASE("a number is shown with its significant digits") {
    CHECK(readable(0.95431) == "0.954");
    CHECK(readable(66.6667, 4) == "66.67");
    CHECK(readable(-12.34, 2) == "−12");
    CHECK(readable(0) == "0");
    CHECK(readable(1.26e-9, 2) == "1.3 × 10⁻⁹");
    CHECK(brief(30.04, 3) == "30");
    CHECK(brief(0.1) == "0.1");
    CHECK(brief(1200) == "1200");
    CHECK(brief(1.02e-9) == "1 × 10⁻⁹");
    CHECK(percent(0.0321, 2) == "3.2 %");
    CHECK(readable(std::nan("")) == "–");
    CHECK(readable(9.996) == "10.0");
    CHECK(readable(999999.9) == "1.00 × 10⁶");
}
