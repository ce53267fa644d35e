#include "apps/report/csv.hpp"

#include "domain/text/words.hpp"

namespace app {

Csv::Csv(const std::string& header, int digits) : names_(rough::listed(header)) {
    text_.precision(digits);
    text_ << header << "\n";
}

void Csv::put(const std::string& word) {
    if (word.find_first_of(",\"\n") == std::string::npos) {
        text_ << word;
        return;
    }
    text_ << '"';
    for (const char c : word)
        text_ << (c == '"' ? "\"\"" : std::string(1, c));
    text_ << '"';
}

std::string csv(const std::vector<std::string>& header, const std::vector<Eigen::VectorXd>& columns) {
    std::ostringstream out;
    out.precision(17);
    for (std::size_t c = 0; c < header.size(); ++c)
        out << (c ? "," : "") << header[c];
    out << "\n";
    for (Eigen::Index row = 0; row < columns.front().size(); ++row) {
        for (std::size_t c = 0; c < columns.size(); ++c)
            out << (c ? "," : "") << columns[c][row];
        out << "\n";
    }
    return out.str();
}

std::string csv(const rough::Response& response) {
    return csv({"displacement_mm", "pressure_MPa", "contact_fraction", "tangent_stiffness_MPa_per_mm",
                "kkt_residual"},
               {response.displacement, response.pressure, response.contact_fraction,
                response.tangent_stiffness, response.kkt_residual});
}

} // namespace app
