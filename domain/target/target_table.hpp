#pragma once

#include "domain/profile/profile.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rough {

/// What stands in a target file.
struct TargetTable {
    std::map<std::string, std::string> recorded; ///< by its "# key: value" lines
    int header_line = 1;                         ///< from 1, as an editor counts
    std::vector<std::string> header;             ///< names of the columns, trimmed
    std::vector<double> factors;                 ///< of each column, to its usual unit; 1 as it is read
    std::vector<std::vector<double>> rows;       ///< as wide as the header, finite

    /// The column's place in the header, or -1.
    int place_of(const std::string& name) const;
    /// The numbers of a column, times a factor.
    Eigen::VectorXd column(int place, double factor = 1) const;
    std::string header_text() const; ///< with commas between
};

/// What turns the columns of a target file into a quantity.
struct TargetScales {
    double nominal_area = 0; ///< mm^2, for loads (N) and areas (mm^2); 0 refuses them, as of a line
    double conductance_to_stiffness = 0; ///< E* resistivities/2 (Barber 2003); 0 refuses a conductance
};

/// The table with its columns renamed to the quantities' own, and the factors to their units: pressure_MPa,
/// displacement_mm, contact_fraction, stiffness_MPa_per_mm, interface_stiffness_MPa_per_mm, lower, upper. A
/// pressure may be in Pa, kPa, MPa or GPa, or a load in uN, mN, N or kN over the nominal area; a displacement
/// in any unit of length, e.g. displacement_um; an area in its square, e.g. area_mm2; a stiffness in a
/// pressure or a load per length, e.g. stiffness_N_per_um. A conductance C is the interface stiffness C E*
/// resistivities/2. Throws InputError that names the column.
TargetTable in_usual_units(TargetTable table, const TargetScales& scales, const std::string& file);

/// Reads a target file: comments, a header and rows of numbers, with commas, semicolons or tabs between as
/// the header has them; decimal commas beside the latter two. Throws InputError naming file and line.
TargetTable read_target_table(const std::filesystem::path& file);

} // namespace rough
