#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rough {

/// A unit of length.
struct LengthUnit {
    std::string name; ///< its name in messages
    double in_mm = 1; ///< > 0
};

/// The length units in words, for messages and help pages.
constexpr std::string_view known_lengths = "m, cm, mm, um, µm, nm, pm, A, Å, in, mil, uin";

/// The length unit that a word names ("µm", "um", "micron", "Å", "inch", "MM", …), in upper or lower case.
std::optional<LengthUnit> length_unit(std::string_view word);

/// The length unit that a word names. Throws InputError with `where` and the known units on another word.
LengthUnit length_unit_named(std::string_view word, const std::string& where);

/// Every length unit in a column header, in order: "x [mm]", "Height (nm)", "z/µm", "x_um", "Raw Micrometer", "µm µm".
/// The words m, in and A have other meanings elsewhere, so they count only in brackets, after a slash, or as the whole
/// header. Throws InputError with `where` on a bracketed unit of another quantity ("[V]", "[s]", "[px]").
std::vector<LengthUnit> length_units_in(std::string_view header, const std::string& where);

/// A word in brackets after a column's name that is not a known unit ("ft" of "x [ft]", "z (yd)"); else "".
std::string unknown_unit_in(std::string_view name);

} // namespace rough
