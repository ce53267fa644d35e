#pragma once

#include "domain/response/response.hpp"

#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace app {

/// A CSV file row by row, header first. Words are quoted where they need to be; a number that is not there
/// leaves its cell empty.
class Csv {
  public:
    /// `digits`: significant digits of its numbers, 17 for all there are; what was measured has no more
    /// than 6.
    explicit Csv(const std::string& header, int digits = 17) {
        text_.precision(digits);
        text_ << header << "\n";
    }

    template <class First, class... Rest>
    void row(const First& first, const Rest&... rest) {
        put(first);
        ((text_ << ",", put(rest)), ...);
        text_ << "\n";
    }

    std::string text() const { return text_.str(); }

  private:
    void put(const std::string& word);
    void put(const std::optional<double>& number) {
        if (number)
            text_ << *number;
    }
    template <class Number>
    requires std::is_arithmetic_v<Number>
    void put(Number number) { text_ << number; }

    std::ostringstream text_;
};

/// Columns of equal length as CSV, 17 significant digits.
std::string csv(const std::vector<std::string>& header, const std::vector<Eigen::VectorXd>& columns);

/// A response as `rugosa contact` writes it, a row a load step.
std::string csv(const rough::Response& response);

} // namespace app
