#pragma once

#include "domain/response/response.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace app {

/// A table row by row, as CSV, header first, and as JSON. Words are quoted where they need to be, and one
/// that a spreadsheet would run begins with an apostrophe; a number that is not there, or not known (NaN),
/// leaves its cell empty.
class Csv {
  public:
    /// `digits`: significant digits of its numbers, 17 for all there are; what was measured has no more
    /// than 6.
    explicit Csv(const std::string& header, int digits = 17);

    /// A row of as many values as the header has names.
    template <class... Values>
    void row(const Values&... values) {
        nlohmann::json row = nlohmann::json::object();
        auto name = names_.begin();
        ((row[*name++] = in_json(values)), ...);
        add(row);
    }

    /// A row by the names of the header; a value that is null, or not there, leaves its cell empty.
    void add(const nlohmann::json& row);

    std::string text() const { return text_.str(); }
    /// The rows, each an object of the header's names.
    const nlohmann::json& rows() const { return rows_; }

  private:
    void put(const std::string& word);

    static nlohmann::json in_json(const std::optional<double>& number) {
        return number ? nlohmann::json(*number) : nlohmann::json();
    }
    template <class Value>
    static nlohmann::json in_json(const Value& value) {
        return value;
    }

    std::ostringstream text_;
    std::vector<std::string> names_;
    nlohmann::json rows_ = nlohmann::json::array();
};

/// The cells of a CSV text as `Csv` writes them, row by row.
std::vector<std::vector<std::string>> csv_rows(const std::string& text);

/// Columns of equal length as CSV, 17 significant digits; NaN is an empty cell.
std::string csv(const std::vector<std::string>& header, const std::vector<Eigen::VectorXd>& columns);

/// A response as `rugosa contact` writes it, a row a load step, with further columns behind.
std::string csv(const rough::Response& response, const std::vector<std::string>& further = {},
                const std::vector<Eigen::VectorXd>& columns = {});

/// Tables that figures draw have no more rows than a picture can show.
///
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
