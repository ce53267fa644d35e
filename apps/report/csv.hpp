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

} // namespace app
