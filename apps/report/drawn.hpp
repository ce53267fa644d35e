#pragma once

#include "domain/profile/profile.hpp"

#include <string>
#include <vector>

/// Tables that figures draw: no more rows than a picture can show.
namespace app {

/// The rows of lines through the same x that a picture shows: all of up to 4,000; of more, the lowest and the
/// highest point of each line on each of its places along x. With `logarithmic` the places are even in log x.
std::vector<rough::Index> rows_to_draw(const Eigen::VectorXd& x, const std::vector<Eigen::VectorXd>& lines,
                                       bool logarithmic = false);

/// Those rows as CSV: x, then the lines. Columns have equal lengths.
std::string drawn_csv(const std::vector<std::string>& header, const std::vector<Eigen::VectorXd>& columns,
                      bool logarithmic = false);

/// The same without a header, each row behind a word.
std::string drawn_rows(const std::string& word, const std::vector<Eigen::VectorXd>& columns);

/// Positions of a profile's nodes along it, mm.
Eigen::VectorXd positions(const rough::Profile& profile);

/// Heights (mm) of a profile about their mean along it: `x_mm,height_mm`.
std::string heights_csv(const rough::Profile& profile);

/// Values at the nodes of a map as CSV, 6 digits: `x_mm`, `y_mm` and one column each. At most 256 places
/// along an axis: the mean of the finite values among the nodes that a place stands for; empty if there are
/// none.
std::string map_csv(const rough::Profile& map, const std::vector<std::string>& names,
                    const std::vector<Eigen::VectorXd>& values);

/// Heights below the highest one, mm.
Eigen::VectorXd below_highest(const rough::Profile& surface);

/// The material ratio curve: `material_ratio` (share of the nodes, 0 to 1) and `height_mm`, which that share
/// exceeds, in at most 1001 rows.
std::string bearing_csv(const Eigen::VectorXd& heights);

} // namespace app
