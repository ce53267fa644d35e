#pragma once

#include <string>

namespace app {

/// A unit to show a quantity in: the number shown is the program's own times `factor`.
struct Unit {
    std::string name;
    double factor;
};

/// The unit in which the largest of some pressures (MPa) is a number of 1 to 1000, within Pa to GPa.
Unit pressure_unit(double largest);

/// The same for lengths (mm), within nm to m.
Unit length_unit(double largest);

/// A number in `digits` significant digits, as for reading: "0.954", "1.2 × 10⁻⁷", "–" if it is none.
std::string readable(double value, int digits = 3);

/// A share in percent: 0.954 as "95.4 %".
std::string percent(double share, int digits = 3);

/// As readable, without the noughts at its end: "0.95", "30".
std::string brief(double value, int digits = 2);

} // namespace app
