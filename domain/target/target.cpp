#include "domain/target/target.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/unit.hpp"
#include "domain/text/words.hpp"

#include <array>
#include <cstdio>

namespace rough {
namespace {

using Separator = Dialect::Separator;

/// A quantity's columns and the curve of a response that a target of it is compared with.
struct QuantityRow {
    Columns columns;
    Curve (*curve)(const Response&);
};
/// In the order of Quantity.
constexpr std::array<QuantityRow, 5> quantities{
    {{{"pressure_MPa", "stiffness_MPa_per_mm"}, secant_stiffness},
     {{"pressure_MPa", "contact_fraction"}, area_against_pressure},
     {{"displacement_mm", "contact_fraction"},
      [](const Response& response) { return from_origin(response.displacement, response.contact_fraction); }},
     {{"displacement_mm", "pressure_MPa"},
      [](const Response& response) { return from_origin(response.displacement, response.pressure); }},
     {{"pressure_MPa", "interface_stiffness_MPa_per_mm"}, interface_secants}}};

const QuantityRow& row_of(Quantity quantity) { return quantities.at(static_cast<std::size_t>(quantity)); }

constexpr std::size_t max_bytes = 16'000'000, max_points = 1'000'000;
constexpr double nearly_rigid = 1e9; ///< a ratio K_i/K that only rounding next to full contact reaches
constexpr const char* pressure_units = "Pa, kPa, MPa, GPa, bar or psi";
constexpr const char* expected_columns =
    "give pressure_MPa with stiffness_MPa_per_mm, interface_stiffness_MPa_per_mm, contact_fraction, "
    "conductance_W_per_m2K or conductance_S_per_m2, or displacement_mm with contact_fraction or "
    "pressure_MPa, in these or other units (load_N, area_mm2, displacement_um); optionally lower and upper";

double number_in(std::string_view cell, Separator separator, const std::string& where) {
    auto value = number(cell, {separator, false});
    if (!value && separator != Separator::comma) value = number(cell, {separator, true});
    if (value && std::isfinite(value->value)) return value->value;
    throw InputError(where + ": \"" + std::string(cell) + "\" is not a finite number; correct it");
}

/// The contents of a target file.
struct TargetTable {
    std::map<std::string, std::string> recorded; ///< the lines "# key: value"
    std::vector<std::string> header;             ///< names of the columns, trimmed
    std::vector<std::vector<double>> rows;       ///< as wide as the header, finite

    /// The index of a column in the header, from 0, or -1 if it does not exist.
    int place_of(const std::string& name) const {
        const auto found = std::ranges::find(header, name);
        return found == header.end() ? -1 : static_cast<int>(found - header.begin());
    }
};

/// Reads comments, a header and rows of numbers.
TargetTable read_target_table(const std::filesystem::path& file) {
    TargetTable table;
    Separator separator = Separator::comma;
    std::string bytes = read_whole(file, max_bytes);
    const Lines lines = text_lines(bytes, file.string());
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string line(trim(lines[i]));
        if (line.empty()) continue;
        const std::string where = file.string() + ":" + std::to_string(i + 1);
        if (line[0] == '#') {
            const auto colon = line.find(':');
            if (colon != std::string::npos)
                table.recorded[std::string(trim(line.substr(1, colon - 1)))] = trim(line.substr(colon + 1));
        } else if (table.header.empty()) {
            separator = line.find(';') != std::string::npos    ? Separator::semicolon
                        : line.find('\t') != std::string::npos ? Separator::tab
                                                               : Separator::comma;
            for (const auto cell : split(line, separator)) table.header.emplace_back(cell);
        } else {
            const auto cells = split(line, separator);
            if (cells.size() != table.header.size())
                refuse(where, ": \"", line, "\" has ", cells.size(), " cells; give ", table.header.size(),
                       " numbers with ",
                       separator == Separator::semicolon ? "semicolons"
                       : separator == Separator::tab     ? "tabs"
                                                         : "commas",
                       " between");
            if (table.rows.size() == max_points) refuse(where, ": more than ", max_points, " points; give fewer");
            table.rows.emplace_back();
            for (const auto cell : cells) table.rows.back().push_back(number_in(cell, separator, where));
        }
    }
    return table;
}

/// A column as the quantities name it, and the factor to its unit.
struct UsualColumn {
    std::string name;
    double factor = 1;
};

using Factor = std::optional<double>;

Factor factor_of(std::string_view unit, const std::map<std::string_view, double>& units) {
    const auto found = units.find(unit);
    return found == units.end() ? std::nullopt : Factor(found->second);
}
Factor in_mpa(std::string_view unit) {
    return factor_of(unit, {{"Pa", 1e-6},
                            {"kPa", 1e-3},
                            {"MPa", 1},
                            {"GPa", 1e3},
                            {"bar", 0.1},
                            {"psi", 6.894757293168361e-3}}); // pound-force per square inch
}
Factor in_newton(std::string_view unit) { return factor_of(unit, {{"uN", 1e-6}, {"mN", 1e-3}, {"N", 1}, {"kN", 1e3}}); }
Factor in_mm(std::string_view unit) {
    const auto known = length_unit(unit);
    return known ? Factor(known->in_mm) : std::nullopt;
}

constexpr const char *thermal = "conductance_W_per_m2K", *electrical = "conductance_S_per_m2";

/// The interface stiffness (MPa/mm) that conducts 1 W/(m^2 K) or 1 S/m^2: K_i = C E* (rho_1 + rho_2)/2
/// (Barber 2003). 1 MPa/mm is 1e9 Pa/m, and 1 MPa is 1e6 Pa.
double conductance_unit(const TargetScales& scales, bool is_thermal) {
    return 0.5e-3 * scales.effective_modulus * *(is_thermal ? scales.thermal_resistivity : scales.resistivity);
}

/// The usual column for a name; an unknown name stays as it is.
UsualColumn usual_column(const std::string& name, const TargetScales& scales, const std::string& file) {
    const auto refuse = [&](const std::string& fix) {
        throw InputError(file + ": column \"" + name + "\" cannot be read; " + fix);
    };
    const auto over_area = [&](Factor factor) -> Factor {
        if (factor && !scales.nominal_area)
            refuse("give a pressure or contact_fraction, as a profile has no area, or --nodes and --length as "
                   "pairs");
        return factor ? Factor(*factor / *scales.nominal_area) : std::nullopt;
    };
    if (name == "conductance")
        refuse("give it a unit: conductance_W_per_m2K (thermal) or conductance_S_per_m2 (electrical)");
    if (name == thermal || name == electrical) {
        const char* needed = name == thermal ? "conductivity" : "resistivity";
        if (!(name == thermal ? scales.thermal_resistivity : scales.resistivity))
            throw InputError(
                file + ": column \"" + name + "\" needs the " + needed + " of both bodies; give a " + needed, needed);
        return {"interface_stiffness_MPa_per_mm", conductance_unit(scales, name == thermal)};
    }
    if (name == "contact_percent") return {"contact_fraction", 0.01};
    const auto cut = name.rfind('_', name.find("_per_") == std::string::npos ? name.size() : name.find("_per_") - 1);
    if (cut == std::string::npos) return {name};
    const std::string what = name.substr(0, cut), unit = name.substr(cut + 1);
    const auto scaled = [&](const char* usual, Factor factor, const char* units) {
        if (!factor) refuse(std::string("give it in ") + units);
        return UsualColumn{usual, *factor};
    };
    if (what == "pressure") return scaled("pressure_MPa", in_mpa(unit), pressure_units);
    if (what == "load" || what == "normal")
        return scaled("pressure_MPa", over_area(in_newton(unit)), "uN, mN, N or kN");
    if (what == "displacement") return scaled("displacement_mm", in_mm(unit), "nm, um, mm or m");
    if (what == "friction" || what == "shear") {
        if (!scales.shear_strength)
            throw InputError(file + ": column \"" + name + "\" needs the shear strength; give a shear-strength",
                             "shear-strength");
        const Factor force = what == "shear" ? in_mpa(unit) : over_area(in_newton(unit));
        return scaled("contact_fraction", force ? Factor(*force / *scales.shear_strength) : force,
                      what == "shear" ? pressure_units : "uN, mN, N or kN");
    }
    if (what == "area") {
        const auto length = unit.ends_with('2') ? in_mm(unit.substr(0, unit.size() - 1)) : std::nullopt;
        return scaled("contact_fraction", over_area(length ? Factor(*length * *length) : length),
                      "nm2, um2, mm2 or m2");
    }
    if (what == "stiffness" || what == "interface_stiffness") {
        const auto per = unit.find("_per_");
        const std::string above = unit.substr(0, per);
        const auto length = per == std::string::npos ? std::nullopt : in_mm(unit.substr(per + 5));
        const auto force = in_mpa(above) ? in_mpa(above) : over_area(in_newton(above));
        return scaled(what == "stiffness" ? "stiffness_MPa_per_mm" : "interface_stiffness_MPa_per_mm",
                      force && length ? Factor(*force / *length) : std::nullopt,
                      "a pressure or load per length, e.g. MPa_per_mm");
    }
    return {name};
}

constexpr const char* recorded_keys[] = {"kernel",   "length_mm",      "width_mm", "effective_modulus_MPa",
                                         "datum_mm", "strip_width_mm", "layers"};

bool is_text(const std::string& key) { return key == "kernel" || key == "layers"; }

bool same(const std::string& key, const std::string& left, const std::string& right, const std::string& file) {
    if (is_text(key)) return left == right;
    const double a = number_from(left, file + ": " + key), b = number_from(right, key);
    return std::abs(a - b) <= 1e-9 * std::abs(b);
}

/// A number with 15 digits, which readers see as they wrote it.
std::string as_read(const std::string& key, const std::string& value) {
    if (is_text(key) || value.empty()) return value;
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.15g", number_from(value, key));
    return digits;
}

std::vector<RecordedDifference> differences(const Target& target, const Model& model, bool carried) {
    const auto of_model = recorded_model(model);
    std::vector<RecordedDifference> found;
    for (const char* key : recorded_keys) {
        const bool carries = target.quantity == Quantity::interface_stiffness &&
                             (key == std::string("datum_mm") || key == std::string("length_mm"));
        const auto there = target.recorded.find(key), here = of_model.find(key);
        if (carries != carried || there == target.recorded.end() || there->second.empty()) continue;
        const std::string value = here == of_model.end() ? "" : here->second;
        if (here == of_model.end() || !same(key, there->second, value, target.name))
            found.push_back({key, there->second, as_read(key, value)});
    }
    return found;
}

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
                     "' is unknown; use stiffness, area, area-displacement, load or interface_stiffness");
    return static_cast<Quantity>(found - names.begin());
}

Columns columns_of(Quantity quantity) { return row_of(quantity).columns; }

WrittenColumns columns_of(const Target& target) {
    const Columns usual = columns_of(target.quantity);
    return target.written.value_or(WrittenColumns{usual.x, usual.y});
}

WrittenColumns conductance_columns(const TargetScales& scales) {
    const bool is_thermal = scales.thermal_resistivity.has_value();
    if (is_thermal == scales.resistivity.has_value())
        throw InputError("conductance: give either a conductivity (thermal) or a resistivity (electrical) of "
                         "both bodies",
                         "conductivity");
    return {"pressure_MPa", is_thermal ? thermal : electrical, 1, conductance_unit(scales, is_thermal)};
}

void validate(const Target& target) {
    const Columns columns = columns_of(target.quantity);
    const auto fail = [&](Index k, const std::string& column, double value, const std::string& permitted) {
        refuse(target.name, ": point ", k + 1, ": ", column, " is ", value, "; give ", permitted);
    };
    const bool of_area = is_contact_fraction(target.quantity);
    if (target.points() == 0) throw InputError(target.name + ": has no points; give at least one");
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
    TargetTable table = read_target_table(file);
    std::string given;
    const std::vector<std::string> header = table.header;
    std::vector<double> factors;
    for (std::string& name : table.header) {
        given += (given.empty() ? "" : ",") + name;
        auto usual = usual_column(name, scales, file.string());
        name = std::move(usual.name);
        factors.push_back(usual.factor);
    }
    Target target;
    target.name = file.string();
    target.recorded = table.recorded;
    int x = -1, y = -1;
    for (std::size_t q = 0; q < quantities.size(); ++q) {
        const Columns& columns = quantities[q].columns;
        if (table.place_of(columns.x) < 0 || table.place_of(columns.y) < 0) continue;
        if (y >= 0) throw InputError(file.string() + ":1: has more than one curve; give one per file");
        target.quantity = static_cast<Quantity>(q), x = table.place_of(columns.x), y = table.place_of(columns.y);
    }
    const int lower = table.place_of("lower"), upper = table.place_of("upper");
    const std::size_t known = (x >= 0) + (y >= 0) + (lower >= 0) + (upper >= 0);
    if (x < 0 || y < 0 || known != table.header.size() || (lower >= 0) != (upper >= 0))
        throw InputError(file.string() + ": columns \"" + given + "\" are not a target; " + expected_columns);
    const auto column = [&](int place, double factor) {
        const auto values =
            rough::column(table.rows, [&](const auto& row) { return factor * row[static_cast<std::size_t>(place)]; });
        return Eigen::VectorXd::Map(values.data(), static_cast<Index>(values.size())).eval();
    };
    const auto at_x = static_cast<std::size_t>(x), at_y = static_cast<std::size_t>(y);
    const double factor = factors[at_y];
    target.x = column(x, factors[at_x]);
    target.y = column(y, factor);
    if (header != table.header) target.written = {header[at_x], header[at_y], factors[at_x], factor};
    if (lower >= 0) {
        target.lower = column(lower, factor);
        target.upper = column(upper, factor);
    }
    validate(target);
    return target;
}

std::string to_csv(const Target& target) {
    PlainStream out;
    out.precision(17);
    for (const auto& [key, value] : target.recorded) out << "# " << key << ": " << value << "\n";
    const WrittenColumns columns = columns_of(target);
    out << columns.x << "," << columns.y << (target.has_band() ? ",lower,upper" : "") << "\n";
    for (Index k = 0; k < target.points(); ++k) {
        out << target.x[k] / columns.x_unit << "," << target.y[k] / columns.y_unit;
        if (target.has_band())
            out << "," << target.lower[k] / columns.y_unit << "," << target.upper[k] / columns.y_unit;
        out << "\n";
    }
    return out.str();
}

Curve curve_of(Quantity quantity, const Response& response) { return row_of(quantity).curve(response); }

Eigen::VectorXd misfit(const Target& target, const Eigen::VectorXd& values) {
    return Eigen::VectorXd::NullaryExpr(target.points(), [&](Index k) { return misfit(target, k, values[k]); });
}

Eigen::VectorXd misfit(const Target& target, const Curve& curve) {
    return misfit(target, target.x.unaryExpr([&](double x) { return curve.at(x); }).eval());
}

Eigen::MatrixXd misfit_jacobian(const Target& target, const Curve& curve, const CurveJacobian& jacobian,
                                const Eigen::VectorXd& misfits) {
    Eigen::MatrixXd result(target.points(), jacobian.x.cols());
    for (Index k = 0; k < target.points(); ++k) {
        if (target.has_band() && misfits[k] == 0) {
            result.row(k).setZero();
            continue;
        }
        const auto [left, weight] = segment_at(curve, target.x[k]);
        const double slope = (curve.y[left + 1] - curve.y[left]) / (curve.x[left + 1] - curve.x[left]);
        // y(x) = y_l + slope (x - x_l): moving the points' abscissas moves the line under x.
        result.row(k) = ((1 - weight) * (jacobian.y.row(left) - slope * jacobian.x.row(left)) +
                         weight * (jacobian.y.row(left + 1) - slope * jacobian.x.row(left + 1))) /
                        target.y[k];
    }
    return target.weight * result;
}

double similarity(const Target& target, const Curve& curve) { return similarity(misfit(target, curve)); }

double similarity(const Curve& reference, const Curve& curve) {
    const Target whole{Quantity::stiffness, "reference", reference.x, reference.y};
    return similarity(whole, stretched(curve, reference.to / curve.to)); // Eq. 11
}

std::map<std::string, std::string> recorded_model(const Model& model) {
    const NamedValues all = named_values(model);
    std::map<std::string, std::string> recorded(all.begin(), all.end());
    for (const char* of_the_solution : {"nodes", "rows", "steps", "reach"}) recorded.erase(of_the_solution);
    return recorded;
}

std::vector<RecordedDifference> recorded_differences(const Target& target, const Model& model) {
    return differences(target, model, false);
}

std::vector<RecordedDifference> carried_over(const Target& target, const Model& model) {
    return differences(target, model, true);
}

std::string in_words(const std::vector<RecordedDifference>& differences) {
    std::string words;
    for (const auto& [key, recorded, here] : differences)
        words += (words.empty() ? "" : ", ") + key + " " + recorded + (here.empty() ? "" : " (here " + here + ")");
    return words;
}

void expect_recorded(const Target& target, const Model& model) {
    if (const auto differences = recorded_differences(target, model); !differences.empty())
        refuse(target.name, ": recorded with ", in_words(differences), ", on which the target depends; use the same");
}

Eigen::VectorXd PointPlacement::up_to(double end) const {
    if (count == 1) return Eigen::VectorXd::Constant(1, end);
    const double begin = first.value_or(end / static_cast<double>(count));
    if (!(begin > 0 && begin < end))
        throw InputError("the first point, " + field_text(begin) + ", is not between 0 and the last, " +
                             field_text(end) + "; give a smaller one",
                         "from");
    if (!logarithmic) return Eigen::VectorXd::LinSpaced(count, begin, end);
    Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(count, std::log(begin), std::log(end)).array().exp();
    x[0] = begin, x[count - 1] = end;
    return x;
}

Target target_at(Quantity quantity, const std::string& name, const Eigen::VectorXd& x,
                 const std::function<double(double)>& y) {
    return {quantity, name, x, x.unaryExpr([&](double at) { return y(at); })};
}

std::vector<Target> targets_like(const Profile& profile, const Model& model, const std::string& name,
                                 const std::vector<Quantity>& quantities, const PointPlacement& points,
                                 Resolution resolution) {
    const Response response = respond(profile, model);
    const std::vector<Response> finer = finer_responses(profile, model, response, resolution);
    std::vector<Target> targets;
    for (const Quantity quantity : quantities) {
        const Curve curve = curve_of(quantity, response);
        // A solver finds a load within its tolerance of the requested one.
        const bool reaches = points.last && *points.last <= curve.to * (1 + 1e-9);
        Target target = target_at(quantity, name, points.up_to(reaches ? *points.last : curve.to),
                                  [&](double x) { return curve.at(x); });
        // The line through the first two secants may be below 0 before the first; points there are omitted.
        Index omitted = 0;
        while (omitted + 1 < points.count && target.y[omitted] <= 0 && target.x[omitted] < curve.x[0]) ++omitted;
        target.x = target.x.tail(points.count - omitted).eval();
        target.y = target.y.tail(points.count - omitted).eval();
        target.recorded = recorded_model(model);
        if (quantity == Quantity::interface_stiffness &&
            target.y.maxCoeff() > nearly_rigid * response.tangent_stiffness.maxCoeff())
            throw InputError(name + ": is in full contact up to " + field_text(target.last()) +
                                 " MPa, which makes the interface stiffness infinite; give a last pressure "
                                 "below full contact",
                             "to");
        if (!finer.empty()) target.lower = target.upper = target.y;
        for (const Response& other : finer) {
            const Curve of = curve_of(quantity, other);
            const Eigen::VectorXd y = target.x.unaryExpr([&](double x) { return of.at(std::min(x, of.to)); });
            target.lower = target.lower.cwiseMin(y);
            target.upper = target.upper.cwiseMax(y);
        }
        targets.push_back(std::move(target));
    }
    return targets;
}

Target target_like(const Profile& profile, const Model& model, const std::string& name, Quantity quantity,
                   const PointPlacement& points, Resolution resolution) {
    return targets_like(profile, model, name, {quantity}, points, resolution).front();
}

} // namespace rough
