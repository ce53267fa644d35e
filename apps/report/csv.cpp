#include "apps/report/csv.hpp"

#include "domain/plain_stream.hpp"
#include "domain/response/interface.hpp"
#include "domain/text/words.hpp"

#include <charconv>
#include <cmath>
#include <string_view>

namespace app {

namespace {

/// Whether a spreadsheet would run a cell: text that begins like a formula and is no number.
bool runs(const std::string& word) {
    double value = 0;
    const char* const end = word.data() + word.size();
    const auto parsed = std::from_chars(word.data() + word.starts_with('+'), end, value);
    return !word.empty() && std::string_view("=+-@\t\r").find(word.front()) != std::string_view::npos &&
           !(parsed.ec == std::errc() && parsed.ptr == end);
}

void put_number(std::ostream& out, double number) {
    if (!std::isnan(number))
        out << number;
}

} // namespace

Csv::Csv(const std::string& header, int digits) : names_(rough::listed(header)) {
    text_.imbue(std::locale::classic());
    text_.precision(digits);
    text_ << header << "\n";
}

void Csv::put(const std::string& given) {
    const std::string word = (runs(given) ? "'" : "") + given;
    if (word == given && word.find_first_of(",\"\r\n") == std::string::npos) {
        text_ << word;
        return;
    }
    text_ << '"';
    for (const char c : word)
        text_ << (c == '"' ? "\"\"" : std::string(1, c));
    text_ << '"';
}

void Csv::add(const nlohmann::json& row) {
    nlohmann::json named = nlohmann::json::object();
    for (std::size_t c = 0; c < names_.size(); ++c) {
        const nlohmann::json value = row.value(names_[c], nlohmann::json());
        text_ << (c ? "," : "");
        if (value.is_string())
            put(value.get<std::string>());
        else if (value.is_boolean())
            text_ << value.get<bool>();
        else if (value.is_number_integer())
            text_ << value.dump();
        else if (value.is_number())
            put_number(text_, value.get<double>());
        named[names_[c]] = value;
    }
    text_ << "\n";
    rows_.push_back(std::move(named));
}

std::vector<std::vector<std::string>> csv_rows(const std::string& text) {
    std::vector<std::vector<std::string>> rows;
    bool quoted = false, begins = true;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (begins)
            rows.push_back({""});
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
    rough::PlainStream out;
    out.precision(17);
    for (std::size_t c = 0; c < header.size(); ++c)
        out << (c ? "," : "") << header[c];
    out << "\n";
    for (Eigen::Index row = 0; row < columns.front().size(); ++row) {
        for (std::size_t c = 0; c < columns.size(); ++c)
            put_number(out << (c ? "," : ""), columns[c][row]);
        out << "\n";
    }
    return out.str();
}

std::string csv(const rough::Response& response, const std::vector<std::string>& further,
                const std::vector<Eigen::VectorXd>& columns) {
    std::vector<std::string> header{"displacement_mm",  "pressure_MPa",
                                    "contact_fraction", "tangent_stiffness_MPa_per_mm",
                                    "kkt_residual",     "interface_stiffness_MPa_per_mm"};
    std::vector<Eigen::VectorXd> all{response.displacement,     response.pressure,
                                     response.contact_fraction, response.tangent_stiffness,
                                     response.kkt_residual,     interface_stiffness(response)};
    header.insert(header.end(), further.begin(), further.end());
    all.insert(all.end(), columns.begin(), columns.end());
    return csv(header, all);
}

} // namespace app
