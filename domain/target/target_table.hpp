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
    std::vector<std::vector<double>> rows;       ///< as wide as the header, finite

    /// The column's place in the header, or -1.
    int place_of(const std::string& name) const;
    /// The numbers of a column, times a factor.
    Eigen::VectorXd column(int place, double factor = 1) const;
    std::string header_text() const; ///< with commas between
};

/// Reads a target file: comments, a header and rows of numbers, with commas, semicolons or tabs between as
/// the header has them; decimal commas beside the latter two. Throws InputError naming file and line.
TargetTable read_target_table(const std::filesystem::path& file);

} // namespace rough
