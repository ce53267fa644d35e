#pragma once

#include <string>

namespace app {

/// A unit for display: the shown number is the program's value (mm, MPa) times `factor`.
struct Unit {
    std::string name;
    double factor;
};

/// The unit, Pa to GPa, in which the largest of some pressures (MPa) is a number from 1 to 1000.
Unit pressure_unit(double largest);

/// The unit, nm to m, in which the largest of some lengths (mm) is a number from 1 to 1000.
Unit length_unit(double largest);

/// A number with `digits` significant digits: "0.954", "1.2 × 10⁻⁷", "–" for NaN.
std::string readable(double value, int digits = 3);

/// A share in percent: 0.954 as "95.4 %".
std::string percent(double share, int digits = 3);

/// Like readable(), without zeros at its end: "0.95", "30".
std::string brief(double value, int digits = 2);

} // namespace app
