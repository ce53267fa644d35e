#include "domain/target/target.hpp"

#include "domain/errors.hpp"
#include "domain/plain_stream.hpp"
#include "domain/response/curve.hpp"
#include "domain/target/target_table.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rough {

namespace {

constexpr Quantity quantities[] = {Quantity::stiffness, Quantity::area_at_pressure,
                                   Quantity::area_at_displacement, Quantity::load_at_displacement,
                                   Quantity::interface_stiffness};
constexpr const char* expected_columns =
    "expected pressure_MPa with stiffness_MPa_per_mm, interface_stiffness_MPa_per_mm, contact_fraction or "
    "conductance, or displacement_mm with contact_fraction or pressure_MPa, in these or other units (load_N, "
    "area_mm2, displacement_um); optionally lower and upper";

} // namespace

const std::vector<std::string>& quantity_names() {
    static const std::vector<std::string> names{"stiffness", "area", "area-displacement", "load",
                                                "interface_stiffness"};
    return names;
}

const std::string& name_of(Quantity quantity) { return quantity_names()[static_cast<std::size_t>(quantity)]; }

Quantity quantity_named(const std::string& name) {
    const auto& names = quantity_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        refuse_value("quantity", "'", name,
                     "' given, expected stiffness, area, area-displacement, load or interface_stiffness");
    return static_cast<Quantity>(found - names.begin());
}

Columns columns_of(Quantity quantity) {
    switch (quantity) {
    case Quantity::stiffness:
        return {"pressure_MPa", "stiffness_MPa_per_mm"};
    case Quantity::area_at_pressure:
        return {"pressure_MPa", "contact_fraction"};
    case Quantity::area_at_displacement:
        return {"displacement_mm", "contact_fraction"};
    case Quantity::load_at_displacement:
        return {"displacement_mm", "pressure_MPa"};
    case Quantity::interface_stiffness:
        return {"pressure_MPa", "interface_stiffness_MPa_per_mm"};
    }
    throw InputError("quantity: unknown");
}

void validate(const Target& target) {
    const Columns columns = columns_of(target.quantity);
    const auto fail = [&](Index k, const std::string& column, double value, const std::string& expected) {
        refuse(target.name, ": point ", k + 1, ": ", column, " is ", value, ", expected ", expected);
    };
    const bool of_area = is_contact_fraction(target.quantity);
    if (target.points() == 0)
        throw InputError(target.name + ": no points given, expected at least one");
    double last = 0;
    for (Index k = 0; k < target.points(); ++k) {
        if (!std::isfinite(target.x[k]) || target.x[k] <= last)
            fail(k, columns.x, target.x[k], "finite numbers greater than 0, increasing");
        if (!std::isfinite(target.y[k]) || target.y[k] <= 0 || (of_area && target.y[k] > 1))
            fail(k, columns.y, target.y[k],
                 of_area ? "a number greater than 0, at most 1" : "a finite number greater than 0");
        if (target.has_band() && !(target.lower[k] <= target.y[k]))
            fail(k, "lower", target.lower[k], std::string("a number no greater than ") + columns.y);
        if (target.has_band() && !(target.upper[k] >= target.y[k]))
            fail(k, "upper", target.upper[k], std::string("a number no less than ") + columns.y);
        last = target.x[k];
    }
}

Target read_target(const std::filesystem::path& file, const TargetScales& scales) {
    const TargetTable given = read_target_table(file), cells = in_usual_units(given, scales, file.string());
    Target target;
    target.name = file.string();
    target.recorded = cells.recorded;
    int x = -1, y = -1;
    for (const Quantity quantity : quantities) {
        const Columns columns = columns_of(quantity);
        if (cells.place_of(columns.x) >= 0 && cells.place_of(columns.y) >= 0) {
            if (y >= 0)
                throw InputError(file.string() + ":1: more than one curve given, expected one a file");
            target.quantity = quantity, x = cells.place_of(columns.x), y = cells.place_of(columns.y);
        }
    }
    const int lower = cells.place_of("lower"), upper = cells.place_of("upper");
    const std::size_t known = (x >= 0) + (y >= 0) + (lower >= 0) + (upper >= 0);
    if (x < 0 || y < 0 || known != cells.header.size() || (lower >= 0) != (upper >= 0)) {
        throw InputError(file.string() + ": columns \"" + given.header_text() + "\" given, " +
                         expected_columns);
    }
    const auto factor = [&](int place) { return cells.factors[static_cast<std::size_t>(place)]; };
    target.x = cells.column(x, factor(x));
    target.y = cells.column(y, factor(y));
    if (lower >= 0) {
        target.lower = cells.column(lower, factor(y));
        target.upper = cells.column(upper, factor(y));
    }
    validate(target);
    return target;
}

std::string to_csv(const Target& target) {
    PlainStream out;
    out.precision(17);
    for (const auto& [key, value] : target.recorded)
        out << "# " << key << ": " << value << "\n";
    const Columns columns = columns_of(target.quantity);
    out << columns.x << "," << columns.y << (target.has_band() ? ",lower,upper" : "") << "\n";
    for (Index k = 0; k < target.points(); ++k) {
        out << target.x[k] << "," << target.y[k];
        if (target.has_band())
            out << "," << target.lower[k] << "," << target.upper[k];
        out << "\n";
    }
    return out.str();
}

Curve curve_of(Quantity quantity, const Response& response) {
    switch (quantity) {
    case Quantity::stiffness:
        return secant_stiffness(response);
    case Quantity::area_at_pressure:
        return area_against_pressure(response);
    case Quantity::area_at_displacement:
        return area_against_displacement(response);
    case Quantity::load_at_displacement:
        return load_against_displacement(response);
    case Quantity::interface_stiffness:
        return interface_secants(response);
    }
    throw InputError("quantity: unknown");
}

} // namespace rough
