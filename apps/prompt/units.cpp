#include "apps/prompt/units.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace app {
namespace {

/// The smallest unit with fewer than four digits before the point, also after rounding to three digits.
Unit fitting(double largest, const std::vector<Unit>& units) {
    for (const Unit& unit : units)
        if (std::abs(largest) * unit.factor < 999.5) return unit;
    return units.back();
}

/// A whole number in Unicode superscripts, for pages and terminals.
std::string superscript(int number) {
    static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = number < 0 ? "⁻" : "";
    for (const char digit : std::to_string(std::abs(number))) text += digits[digit - '0'];
    return text;
}

} // namespace

Unit pressure_unit(double largest) { return fitting(largest, {{"Pa", 1e6}, {"kPa", 1e3}, {"MPa", 1}, {"GPa", 1e-3}}); }

Unit length_unit(double largest) { return fitting(largest, {{"nm", 1e6}, {"µm", 1e3}, {"mm", 1}, {"m", 1e-3}}); }

std::string readable(double value, int digits) {
    if (!std::isfinite(value)) return "–";
    if (value == 0) return "0";
    char text[64];
    std::snprintf(text, sizeof text, "%.*e", digits - 1, std::abs(value)); // rounding may add a digit
    const std::string mantissa(text, std::strcspn(text, "e"));
    const int order = std::atoi(text + mantissa.size() + 1);
    const std::string sign = value < 0 ? "−" : "";
    if (order >= -4 && order < 6) {
        std::snprintf(text, sizeof text, "%.*f", std::max(0, digits - 1 - order), std::abs(value));
        return sign + text;
    }
    return sign + mantissa + " × 10" + superscript(order);
}

std::string percent(double share, int digits) { return readable(100 * share, digits) + " %"; }

std::string brief(double value, int digits) {
    const std::string text = readable(value, digits);
    const std::size_t end = std::min(text.find(' '), text.size()); // end of the number before a power of ten
    if (text.find('.') >= end) return text;
    const std::size_t last = text.find_last_not_of('0', end - 1);
    return text.substr(0, text[last] == '.' ? last : last + 1) + text.substr(end);
}

} // namespace app
