#include "apps/table.hpp"

#include <sstream>

namespace app {

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

} // namespace app
