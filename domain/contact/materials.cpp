#include "domain/contact/materials.hpp"

#include "domain/text/words.hpp"

#include <sstream>

namespace rough {

extern const char* const contact_materials_csv; // materials.csv (.cmake/data.cmake)

const std::vector<Material>& materials() {
    static const std::vector<Material> all = [] {
        std::vector<Material> all;
        std::istringstream rows(contact_materials_csv);
        std::string row;
        for (std::getline(rows, row); std::getline(rows, row);) {
            const auto cells = split(row, Dialect::Separator::semicolon);
            const std::vector<std::string> c(cells.begin(), cells.end());
            const auto number = [&](std::size_t i) { return number_from(c[i], "materials.csv"); };
            all.push_back({c[0], number(1), number(2), number(3), c[4], c[5], c[6]});
        }
        return all;
    }();
    return all;
}

} // namespace rough
