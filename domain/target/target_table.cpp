#include "domain/target/target_table.hpp"

#include "domain/errors.hpp"
#include "domain/scan/unit.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/lines.hpp"
#include "domain/text/words.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace rough {

namespace {

constexpr std::size_t max_bytes = 16'000'000;

using Separator = Dialect::Separator;

Separator separator_of(const std::string& header) {
    return header.find(';') != std::string::npos    ? Separator::semicolon
           : header.find('\t') != std::string::npos ? Separator::tab
                                                    : Separator::comma;
}

double number_in(std::string_view cell, Separator separator, const std::string& where) {
    auto value = number(cell, {separator, false});
    if (!value && separator != Separator::comma)
        value = number(cell, {separator, true});
    if (value && std::isfinite(value->value))
        return value->value;
    throw InputError(where + ": \"" + std::string(cell) + "\" given, expected a finite number");
}

/// A column as the quantities have it, and the factor to it.
struct UsualColumn {
    std::string name;
    double factor = 1;
};

/// The factor to MPa of a pressure, or to N of a load.
std::optional<double> factor_of(std::string_view unit, const std::map<std::string_view, double>& units) {
    const auto found = units.find(unit);
    return found == units.end() ? std::nullopt : std::optional(found->second);
}
std::optional<double> in_mpa(std::string_view unit) {
    return factor_of(unit, {{"Pa", 1e-6}, {"kPa", 1e-3}, {"MPa", 1}, {"GPa", 1e3}});
}
std::optional<double> in_newton(std::string_view unit) {
    return factor_of(unit, {{"uN", 1e-6}, {"mN", 1e-3}, {"N", 1}, {"kN", 1e3}});
}
std::optional<double> in_mm(std::string_view unit) {
    const auto known = length_unit(unit);
    return known ? std::optional(known->in_mm) : std::nullopt;
}

/// The usual column that a name stands for; a name that is none of these as it is.
UsualColumn usual_column(const std::string& name, const TargetScales& scales, const std::string& file) {
    const auto refuse = [&](const std::string& expected) {
        throw InputError(file + ": column \"" + name + "\" given, expected " + expected);
    };
    const auto over_area = [&](std::optional<double> factor) -> std::optional<double> {
        if (factor && !(scales.nominal_area > 0))
            refuse("a pressure or contact_fraction, as a profile has no area: give --nodes and --length as "
                   "pairs");
        return factor ? std::optional(*factor / scales.nominal_area) : std::nullopt;
    };
    if (name == "conductance") {
        if (!(scales.conductance_to_stiffness > 0))
            throw InputError(
                file + ": a conductance given, expected a resistivity with it: C = 2 K_i/(E* resistivity)",
                "resistivity");
        return {"interface_stiffness_MPa_per_mm", scales.conductance_to_stiffness};
    }
    const auto cut =
        name.rfind('_', name.find("_per_") == std::string::npos ? name.size() : name.find("_per_") - 1);
    if (cut == std::string::npos)
        return {name};
    const std::string what = name.substr(0, cut), unit = name.substr(cut + 1);
    const auto scaled = [&](const char* usual, std::optional<double> factor, const char* units) {
        if (!factor)
            refuse(std::string("a unit of ") + units);
        return UsualColumn{usual, *factor};
    };
    if (what == "pressure")
        return scaled("pressure_MPa", in_mpa(unit), "Pa, kPa, MPa or GPa");
    if (what == "load")
        return scaled("pressure_MPa", over_area(in_newton(unit)), "uN, mN, N or kN");
    if (what == "displacement")
        return scaled("displacement_mm", in_mm(unit), "nm, um, mm or m");
    if (what == "area") {
        const auto length = unit.ends_with('2') ? in_mm(unit.substr(0, unit.size() - 1)) : std::nullopt;
        return scaled("contact_fraction", over_area(length ? std::optional(*length * *length) : length),
                      "nm2, um2, mm2 or m2");
    }
    if (what == "stiffness" || what == "interface_stiffness") {
        const auto per = unit.find("_per_");
        const std::string above = unit.substr(0, per);
        const auto length = per == std::string::npos ? std::nullopt : in_mm(unit.substr(per + 5));
        const auto force = in_mpa(above) ? in_mpa(above) : over_area(in_newton(above));
        return scaled(what == "stiffness" ? "stiffness_MPa_per_mm" : "interface_stiffness_MPa_per_mm",
                      force && length ? std::optional(*force / *length) : std::nullopt,
                      "a pressure or load per length, e.g. MPa_per_mm");
    }
    return {name};
}

} // namespace

TargetTable in_usual_units(TargetTable table, const TargetScales& scales, const std::string& file) {
    table.factors.clear();
    for (std::string& name : table.header) {
        const UsualColumn usual = usual_column(name, scales, file);
        name = usual.name;
        table.factors.push_back(usual.factor);
    }
    return table;
}

int TargetTable::place_of(const std::string& name) const {
    const auto found = std::find(header.begin(), header.end(), name);
    return found == header.end() ? -1 : static_cast<int>(found - header.begin());
}

Eigen::VectorXd TargetTable::column(int place, double factor) const {
    Eigen::VectorXd values(static_cast<Index>(rows.size()));
    for (std::size_t k = 0; k < rows.size(); ++k)
        values[static_cast<Index>(k)] = factor * rows[k][static_cast<std::size_t>(place)];
    return values;
}

std::string TargetTable::header_text() const {
    std::string text;
    for (const auto& name : header)
        text += (text.empty() ? "" : ",") + name;
    return text;
}

TargetTable read_target_table(const std::filesystem::path& file) {
    TargetTable table;
    Separator separator = Separator::comma;
    int number = 0;
    std::string bytes = read_whole(file, max_bytes);
    for (const std::string_view whole : text_lines(bytes, file.string())) {
        ++number;
        const std::string line(trim(whole));
        if (line.empty())
            continue;
        const std::string where = file.string() + ":" + std::to_string(number);
        if (line[0] == '#') {
            const auto colon = line.find(':');
            if (colon != std::string::npos)
                table.recorded[std::string(trim(line.substr(1, colon - 1)))] = trim(line.substr(colon + 1));
        } else if (table.header.empty()) {
            separator = separator_of(line);
            table.header_line = number;
            for (const auto cell : split(line, separator))
                table.header.emplace_back(cell);
            table.factors.assign(table.header.size(), 1);
        } else {
            const auto cells = split(line, separator);
            if (cells.size() != table.header.size())
                throw InputError(where + ": \"" + line + "\" given, expected " +
                                 std::to_string(table.header.size()) + " numbers with " +
                                 (separator == Separator::semicolon ? "semicolons"
                                  : separator == Separator::tab     ? "tabs"
                                                                    : "commas") +
                                 " between");
            table.rows.emplace_back();
            for (const auto cell : cells)
                table.rows.back().push_back(number_in(cell, separator, where));
        }
    }
    return table;
}

} // namespace rough
