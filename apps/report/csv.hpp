#pragma once

#include "domain/accuracy/resolution.hpp"
#include "ga/base/json.hpp"

namespace app {

/// A table that is built row by row, as CSV with a header and as JSON. Words are quoted if necessary. An
/// apostrophe is put before a word that a spreadsheet would run. NaN is an empty cell.
class Csv {
  public:
    /// `digits`: significant digits of its numbers, 17 for exact ones, 6 for measured ones.
    explicit Csv(const std::string& header, int digits = 17);

    /// Adds a row of one value per name of the header.
    template <class... Values>
    void row(const Values&... values) {
        nlohmann::json row = nlohmann::json::object();
        auto name = names_.begin();
        ((row[*name++] = values), ...);
        add(row);
    }

    /// Adds a row for each point of a curve: the keys, x and y.
    template <class... Keys>
    void points(const Eigen::VectorXd& x, const Eigen::VectorXd& y, const Keys&... keys) {
        for (Eigen::Index i = 0; i < x.size(); ++i) row(keys..., x[i], y[i]);
    }

    /// Adds a row from an object of the header's names; a null or missing value is an empty cell.
    void add(const nlohmann::json& row);

    std::string text() const;
    /// The rows, one object of the header's names each.
    const nlohmann::json& rows() const { return rows_; }

  private:
    std::vector<std::string> names_;
    int digits_;
    nlohmann::json rows_ = nlohmann::json::array();
};

/// The cells of each row of a CSV text that `Csv` wrote.
std::vector<std::vector<std::string>> csv_rows(const std::string& text);

/// Columns of equal length as CSV with 17 significant digits. NaN is an empty cell.
std::string csv(const std::vector<std::string>& header, const std::vector<Eigen::VectorXd>& columns);

/// A response as `rugosa contact` writes it, one row per load step. With a band, which a scan or map has, its
/// columns follow, with empty cells if it was not computed.
std::string csv(const rough::Response& response, const rough::ResolutionBand* band = nullptr);

/// Columns of equal length, x and lines over it, as CSV. It has the rows that a picture can show: all, if
/// there are at most 4,000. Otherwise x is divided into equal intervals, in log x with `logarithmic`. The
/// lowest and the highest point of each line in each interval are taken.
std::string drawn_csv(const std::vector<std::string>& header, const std::vector<Eigen::VectorXd>& columns,
                      bool logarithmic = false);

/// The rows of drawn_csv() without the header. Each begins with a word and a comma.
std::string drawn_rows(const std::string& word, const std::vector<Eigen::VectorXd>& columns);

/// Positions of the nodes along a profile, mm.
Eigen::VectorXd positions(const rough::Profile& profile);

/// Heights of a profile from their mean, mm: `x_mm,height_mm`.
std::string heights_csv(const rough::Profile& profile);

/// Values at the nodes of a map as CSV with 6 digits: `x_mm`, `y_mm` and one column each. A map of more than
/// 256 x 256 nodes is averaged over blocks. The value of a block is the mean of its finite values, or an
/// empty cell if it has none.
std::string map_csv(const rough::Profile& map, const std::vector<std::string>& names,
                    const std::vector<Eigen::VectorXd>& values);

/// Heights below the highest one, mm.
Eigen::VectorXd below_highest(const rough::Profile& surface);

/// The material ratio curve in at most 1001 rows: `material_ratio` (0 to 1) is the share of the nodes that
/// are higher than `height_mm`.
std::string bearing_csv(const Eigen::VectorXd& heights);

} // namespace app
