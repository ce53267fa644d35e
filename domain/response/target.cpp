#include "domain/response/target.hpp"

#include "domain/contact/refuse.hpp"
#include "domain/text.hpp"

#include <cmath>
#include <fstream>
#include <vector>

namespace rough {

namespace {

constexpr const char* header = "pressure_MPa,stiffness_MPa_per_mm";

} // namespace

void validate(const Target& target) {
    const auto fail = [&](Eigen::Index k, const std::string& what, double value) {
        refuse(target.name, ": point ", k + 1, ": ", what, " is ", value, ", expected ",
               what == "stiffness" ? "a finite number greater than 0 (MPa/mm)"
                                   : "finite numbers greater than 0 (MPa), increasing");
    };
    if (target.points() == 0)
        throw InputError(target.name + ": no points given, expected at least one");
    double last = 0;
    for (Eigen::Index k = 0; k < target.points(); ++k) {
        if (!std::isfinite(target.pressure[k]) || target.pressure[k] <= last)
            fail(k, "pressure", target.pressure[k]);
        if (!std::isfinite(target.stiffness[k]) || target.stiffness[k] <= 0)
            fail(k, "stiffness", target.stiffness[k]);
        last = target.pressure[k];
    }
}

Target read_target(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in || std::filesystem::is_directory(file))
        throw InputError(file.string() + ": cannot be read, expected a target (CSV with " + header + ")");
    std::string line;
    std::getline(in, line);
    line = trim(line);
    if (line != header)
        throw InputError(file.string() + ":1: \"" + line + "\" given, expected the header " + header);
    std::vector<double> pressure, stiffness;
    for (int number = 2; std::getline(in, line); ++number) {
        line = trim(line);
        if (line.empty())
            continue;
        const std::string where = file.string() + ":" + std::to_string(number);
        const auto cells = listed(line);
        if (cells.size() != 2)
            throw InputError(where + ": \"" + line + "\" given, expected two numbers with a comma between");
        pressure.push_back(number_from(cells[0], where));
        stiffness.push_back(number_from(cells[1], where));
    }
    Target target{file.string(),
                  Eigen::Map<Eigen::VectorXd>(pressure.data(), static_cast<Eigen::Index>(pressure.size())),
                  Eigen::Map<Eigen::VectorXd>(stiffness.data(), static_cast<Eigen::Index>(stiffness.size()))};
    validate(target);
    return target;
}

} // namespace rough
