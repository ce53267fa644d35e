#include "domain/scan/map.hpp"

#include "domain/errors.hpp"
#include "domain/text/bytes.hpp"

namespace rough {

std::string vtk(const Profile& map) {
    const auto [columns, rows] = map.shape();
    const std::string count = std::to_string(map.nodes());
    std::string bytes = line_of("# vtk DataFile Version 3.0\nrugosa: a rough surface, mm\nBINARY\n"
                                "DATASET STRUCTURED_GRID\nDIMENSIONS ",
                                columns, " ", rows, " 1\nPOINTS ", count, " double\n");
    const auto append = [&](double value) { // the highest byte first
        std::string word;
        append_little_endian(word, value);
        bytes.append(word.rbegin(), word.rend());
    };
    for (Index k = 0; k < map.nodes(); ++k) {
        append(map.spacing * static_cast<double>(k % columns));
        append(map.row_spacing * static_cast<double>(k / columns));
        append(map.heights[k]);
    }
    bytes += "\nPOINT_DATA " + count + "\nSCALARS height_mm double 1\nLOOKUP_TABLE default\n";
    for (const double height : map.heights)
        append(height);
    return bytes + "\n";
}

} // namespace rough
