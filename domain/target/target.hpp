#pragma once

#include "domain/response/curve.hpp"
#include "domain/target/target_table.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rough {

/// What a target curve is of, and against what.
enum class Quantity {
    stiffness,            ///< K (MPa/mm) against mean pressure (MPa)
    area_at_pressure,     ///< contact fraction against mean pressure (MPa)
    area_at_displacement, ///< contact fraction against displacement from the highest point (mm)
    load_at_displacement, ///< mean pressure (MPa) against displacement (mm)
    interface_stiffness,  ///< K_i (MPa/mm; response/curve.hpp) against mean pressure (MPa)
};

/// In the order of Quantity: stiffness, area, area-displacement, load, interface_stiffness.
const std::vector<std::string>& quantity_names();
/// The name of a quantity.
const std::string& name_of(Quantity quantity);
/// The quantity of that name. Throws InputError on another word.
Quantity quantity_named(const std::string& name);

/// Whether it is of contact fractions.
inline bool is_contact_fraction(Quantity quantity) {
    return quantity == Quantity::area_at_pressure || quantity == Quantity::area_at_displacement;
}
/// Whether it is against a mean pressure (MPa), not a displacement (mm).
inline bool against_pressure(Quantity quantity) {
    return quantity != Quantity::area_at_displacement && quantity != Quantity::load_at_displacement;
}

/// One curve that is asked for, with how much it counts and, where given, the band that satisfies it.
struct Target {
    Quantity quantity = Quantity::stiffness; ///< what the curve is of
    std::string name;                        ///< where it came from
    Eigen::VectorXd x;                       ///< points in the quantity's units, > 0 and increasing
    Eigen::VectorXd y;                       ///< the same many, > 0
    Eigen::VectorXd lower;                   ///< band about y, or empty
    Eigen::VectorXd upper;                   ///< band about y, or empty
    double weight = 1;                       ///< (0, 1]: a misfit counts so much
    std::map<std::string, std::string>
        recorded; ///< "kernel", "datum_mm", ...: what the file says of its model

    Index points() const { return x.size(); }       ///< how many
    double last() const { return x[points() - 1]; } ///< the largest x
    /// Whether x is a mean pressure (MPa), not a displacement (mm).
    bool against_pressure() const { return rough::against_pressure(quantity); }
    bool has_band() const { return lower.size() > 0; } ///< whether a band is given
};

/// The columns of a quantity's file, e.g. "pressure_MPa" and "stiffness_MPa_per_mm".
struct Columns {
    const char* x; ///< what it is given against
    const char* y; ///< what is asked for
};
/// As target files head them.
Columns columns_of(Quantity quantity);

/// Throws InputError that names the row (1-based) and value: no points; x not increasing from above 0; y not
/// above 0 (contact fractions: nor above 1); a band that does not hold y.
void validate(const Target& target);

/// Reads a target: CSV, header first, any columns order, in the units that the columns' names say
/// (in_usual_units); `#` lines before the header record the model as "# key: value". Throws InputError with
/// file and line.
Target read_target(const std::filesystem::path& file, const TargetScales& scales = {});

/// The target as a file: the recorded lines, the header, a row a point with 17 digits.
std::string to_csv(const Target& target);

/// The curve of a response that a target of that quantity is compared with.
Curve curve_of(Quantity quantity, const Response& response);

} // namespace rough
