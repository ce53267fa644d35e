#pragma once

#include "domain/profile/profile.hpp"

#include <string>
#include <vector>

/// Tables that figures draw: no more rows than a picture can show.
namespace app {

/// The rows that a picture of some lines over common x shows. Up to 4,000 rows are all shown. Of more, x is
/// cut into even intervals (even in log x with `logarithmic`), and each line's lowest and highest point in
/// each interval are shown.
std::vector<rough::Index> rows_to_draw(const Eigen::VectorXd& x, const std::vector<Eigen::VectorXd>& lines,
                                       bool logarithmic = false);

/// The rows of rows_to_draw() as CSV: x, then the lines. Columns have equal lengths.
std::string drawn_csv(const std::vector<std::string>& header, const std::vector<Eigen::VectorXd>& columns,
                      bool logarithmic = false);

/// The rows of drawn_csv() without a header, each after a word and a comma.
std::string drawn_rows(const std::string& word, const std::vector<Eigen::VectorXd>& columns);

/// Positions of a profile's nodes along it, mm.
Eigen::VectorXd positions(const rough::Profile& profile);

/// Heights (mm) of a profile about their mean along it: `x_mm,height_mm`.
std::string heights_csv(const rough::Profile& profile);

/// Values at the nodes of a map as CSV, 6 digits: `x_mm`, `y_mm` and one column each. A larger map than
/// 256 x 256 is averaged over blocks of nodes. A block's value is the mean of its finite values, or an empty
/// cell if it has only others.
std::string map_csv(const rough::Profile& map, const std::vector<std::string>& names,
                    const std::vector<Eigen::VectorXd>& values);

/// Heights below the highest one, mm.
Eigen::VectorXd below_highest(const rough::Profile& surface);

/// The material ratio curve: `material_ratio` (share of the nodes, 0 to 1) and `height_mm`, which that share
/// exceeds, in at most 1001 rows.
std::string bearing_csv(const Eigen::VectorXd& heights);

} // namespace app
