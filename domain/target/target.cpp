#include "domain/target/target.hpp"

#include "domain/errors.hpp"
#include "domain/target/target_table.hpp"

#include <cmath>

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
    const TargetTable table = read_target_table(file);
    // What a file records of its model is held against none here, so such a file is refused.
    if (table.header_text() != header || !table.recorded.empty())
        throw InputError(
            file.string() + ":" + std::to_string(table.header_line) + ": \"" +
            (table.recorded.empty() ? table.header_text() : "# " + table.recorded.begin()->first + ": ...") +
            "\" given, expected the header " + header);
    Target target{file.string(), table.column(0), table.column(1)};
    validate(target);
    return target;
}

} // namespace rough
