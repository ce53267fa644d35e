#include "apps/report/csv.hpp"

#include "domain/errors.hpp"
#include "domain/response/curve.hpp"
#include "domain/text/json.hpp"
#include "domain/text/words.hpp"

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/replace.hpp>

#include <charconv>
#include <cmath>

namespace app {

using rough::Index;

namespace {

/// Whether a spreadsheet would take a cell for a formula: it begins like one, and is not a number.
bool runs(const std::string& word) {
    double value = 0;
    const char* const end = word.data() + word.size();
    const auto parsed = std::from_chars(word.data() + word.starts_with('+'), end, value);
    return !word.empty() && std::string_view("=+-@\t\r").find(word.front()) != std::string_view::npos &&
           !(parsed.ec == std::errc() && parsed.ptr == end);
}

/// A word as a cell, quoted if necessary.
std::string cell_of(const std::string& given) {
    const std::string word = (runs(given) ? "'" : "") + given;
    if (word == given && word.find_first_of(",\"\r\n") == std::string::npos) return word;
    return '"' + boost::replace_all_copy(word, "\"", "\"\"") + '"';
}

void put_number(std::ostream& out, double number) {
    if (!std::isnan(number)) out << number;
}

/// The rows of columns of equal length as CSV, each behind `begin`.
std::string rows_text(const std::vector<Eigen::VectorXd>& columns, const std::string& begin = "") {
    rough::PlainStream out;
    out.precision(17);
    for (Eigen::Index row = 0; row < columns.front().size(); ++row) {
        out << begin;
        for (std::size_t c = 0; c < columns.size(); ++c) put_number(out << (c ? "," : ""), columns[c][row]);
        out << "\n";
    }
    return out.str();
}

/// The columns of drawn_csv() in the rows that a picture can show.
std::vector<Eigen::VectorXd> shown(std::vector<Eigen::VectorXd> columns, bool logarithmic) {
    constexpr Index max_rows = 4000;
    const Eigen::VectorXd x = columns[0];
    if (x.size() <= max_rows) return columns;
    std::vector<Index> rows;
    const double intervals = 0.5 * max_rows / static_cast<double>(columns.size() - 1);
    const auto along = [&](Index i) { return logarithmic ? std::log(x[i]) : x[i]; };
    const double from = along(0), length = along(x.size() - 1) - from;
    const auto interval = [&](Index i) { return std::floor((along(i) - from) / length * (intervals - 1)); };
    for (Index begin = 0, end = 0; begin < x.size(); begin = end) {
        for (end = begin + 1; end < x.size() && interval(end) == interval(begin);) ++end;
        std::vector<Index> extremes;
        for (std::size_t line = 1; line < columns.size(); ++line)
            for (const double sign : {1, -1}) {
                Index at = 0;
                (sign * columns[line].segment(begin, end - begin)).minCoeff(&at);
                extremes.push_back(begin + at);
            }
        std::ranges::sort(extremes);
        rows.insert(rows.end(), extremes.begin(), std::unique(extremes.begin(), extremes.end()));
    }
    for (Eigen::VectorXd& column : columns) column = column(rows).eval();
    return columns;
}

} // namespace

Csv::Csv(const std::string& header, int digits) : names_(rough::listed(header)), digits_(digits) {}

void Csv::add(const nlohmann::json& row) {
    nlohmann::json& named = rows_.emplace_back(nlohmann::json::object());
    for (const std::string& name : names_) named[name] = row.value(name, nlohmann::json());
}

std::string Csv::text() const {
    rough::PlainStream out;
    out.precision(digits_);
    out << boost::join(names_, ",") << "\n";
    for (const nlohmann::json& row : rows_) {
        for (std::size_t c = 0; c < names_.size(); ++c) {
            const nlohmann::json& value = row[names_[c]];
            out << (c ? "," : "");
            if (value.is_string())
                out << cell_of(value.get<std::string>());
            else if (value.is_boolean())
                out << value.get<bool>();
            else if (value.is_number_integer())
                out << rough::json_text(value, true);
            else if (value.is_number())
                put_number(out, value.get<double>());
        }
        out << "\n";
    }
    return out.str();
}

std::vector<std::vector<std::string>> csv_rows(const std::string& text) {
    std::vector<std::vector<std::string>> rows;
    bool quoted = false, begins = true;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (begins) rows.push_back({""});
        begins = !quoted && c == '\n';
        if (c == '"' && quoted && i + 1 < text.size() && text[i + 1] == '"')
            rows.back().back() += text[++i];
        else if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            rows.back().emplace_back();
        else if (!begins)
            rows.back().back() += c;
    }
    return rows;
}

std::string csv(const std::vector<std::string>& header, const std::vector<Eigen::VectorXd>& columns) {
    return boost::join(header, ",") + "\n" + rows_text(columns);
}

std::string csv(const rough::Response& response, const rough::ResolutionBand* band) {
    std::vector<std::string> header{"displacement_mm",  "pressure_MPa",
                                    "contact_fraction", "tangent_stiffness_MPa_per_mm",
                                    "kkt_residual",     "interface_stiffness_MPa_per_mm"};
    std::vector<Eigen::VectorXd> all{response.displacement,      response.pressure,     response.contact_fraction,
                                     response.tangent_stiffness, response.kkt_residual, interface_stiffness(response)};
    if (band) {
        header.insert(header.end(), {"contact_fraction_low", "contact_fraction_high",
                                     "tangent_stiffness_low_MPa_per_mm", "tangent_stiffness_high_MPa_per_mm"});
        all.insert(all.end(), {band->contact_fraction_low, band->contact_fraction_high, band->tangent_stiffness_low,
                               band->tangent_stiffness_high});
        for (auto& column : all) column.conservativeResizeLike(Eigen::VectorXd::Constant(response.steps(), NAN));
    }
    return csv(header, all);
}

std::string drawn_csv(const std::vector<std::string>& header, const std::vector<Eigen::VectorXd>& columns,
                      bool logarithmic) {
    return csv(header, shown(columns, logarithmic));
}

std::string drawn_rows(const std::string& word, const std::vector<Eigen::VectorXd>& columns) {
    return rows_text(shown(columns, false), word + ",");
}

Eigen::VectorXd positions(const rough::Profile& profile) {
    return profile.spacing * Eigen::VectorXd::LinSpaced(profile.nodes(), 0, static_cast<double>(profile.nodes() - 1));
}

std::string heights_csv(const rough::Profile& profile) {
    return drawn_csv({"x_mm", "height_mm"}, {positions(profile), profile.heights.array() - profile.heights.mean()});
}

std::string map_csv(const rough::Profile& map, const std::vector<std::string>& names,
                    const std::vector<Eigen::VectorXd>& values) {
    constexpr Index max_blocks = 256;
    const auto [columns, rows] = map.shape();
    const Index every = (std::max(columns, rows) + max_blocks - 1) / max_blocks;
    rough::PlainStream out;
    out.precision(6);
    out << "x_mm,y_mm," << boost::join(names, ",");
    const auto middle = [](Index begin, Index count) {
        return static_cast<double>(begin) + 0.5 * static_cast<double>(count - 1);
    };
    for (Index j = 0; j < rows; j += every)
        for (Index i = 0; i < columns; i += every) {
            // Blocks are evenly spaced, also the last ones, which may have fewer nodes.
            out << "\n" << map.spacing * middle(i, every) << "," << map.row_spacing * middle(j, every);
            for (const Eigen::VectorXd& value : values) {
                const auto nodes = value.reshaped(columns, rows)
                                       .block(i, j, std::min(every, columns - i), std::min(every, rows - j))
                                       .array();
                const auto finite = nodes.isFinite();
                out << ",";
                if (finite.any())
                    out << finite.select(nodes, 0).sum() / static_cast<double>(finite.count());
                else
                    out << "\"\""; // gnuplot 5.4 may stop at an empty last field
            }
        }
    out << "\n";
    return out.str();
}

Eigen::VectorXd below_highest(const rough::Profile& surface) {
    return surface.heights.array() - surface.heights.maxCoeff();
}

std::string bearing_csv(const Eigen::VectorXd& heights) {
    constexpr Index max_rows = 1001;
    Eigen::VectorXd z = heights;
    std::sort(z.begin(), z.end(), std::greater<>());
    const Index count = std::min(max_rows, z.size());
    Eigen::VectorXd share(count), level(count);
    for (Index i = 0; i < count; ++i) {
        const Index at = count > 1 ? i * (z.size() - 1) / (count - 1) : 0;
        share[i] = (static_cast<double>(at) + 0.5) / static_cast<double>(z.size());
        level[i] = z[at];
    }
    return csv({"material_ratio", "height_mm"}, {share, level});
}

} // namespace app
