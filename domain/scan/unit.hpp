#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rough {

/// A unit of length.
struct LengthUnit {
    std::string name; ///< as the account prints it
    double in_mm = 1; ///< > 0
};

/// The length unit that a word names ("µm", "um", "micron", "Å", "inch", "MM", …), upper or lower case.
std::optional<LengthUnit> length_unit(std::string_view word);

/// As length_unit; a word that is none throws InputError naming `where` and the known units.
LengthUnit length_unit_named(std::string_view word, const std::string& where);

/// Every length unit in a column header, in order: "x [mm]", "Height (nm)", "z/µm", "x_um", "Raw Micrometer",
/// "µm µm". The words m, in and A count in brackets, after a slash or alone, as they mean other things
/// elsewhere. A bracketed unit of another kind ("[V]", "[s]", "[px]") throws InputError naming `where`.
std::vector<LengthUnit> length_units_in(std::string_view header, const std::string& where);

/// What stands in brackets behind a column's name as a unit does ("ft" of "x [ft]", "z (yd)"), where no
/// length unit is named; "" where nothing does.
std::string unknown_unit_in(std::string_view name);

} // namespace rough
