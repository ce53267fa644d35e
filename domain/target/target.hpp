#pragma once

#include "domain/accuracy/resolution.hpp"
#include "domain/response/curve.hpp"

#include <filesystem>
#include <map>

namespace rough {

/// The quantities y and x of a target curve.
enum class Quantity {
    stiffness,            ///< secant stiffness between load steps (MPa/mm) against mean pressure (MPa)
    area_at_pressure,     ///< contact fraction against mean pressure (MPa)
    area_at_displacement, ///< contact fraction against displacement (mm)
    load_at_displacement, ///< mean pressure (MPa) against displacement (mm)
    interface_stiffness,  ///< interface stiffness K_i (MPa/mm; curve.hpp) against mean pressure (MPa)
};

/// The names in the order of Quantity: stiffness, area, area-displacement, load, interface_stiffness.
const std::vector<std::string>& quantity_names();
const std::string& name_of(Quantity quantity); ///< the name of a quantity
/// The quantity of that name. Throws InputError on another word.
Quantity quantity_named(const std::string& name);

/// Whether y is a contact fraction.
inline bool is_contact_fraction(Quantity quantity) {
    return quantity == Quantity::area_at_pressure || quantity == Quantity::area_at_displacement;
}
/// Whether x is a mean pressure (MPa), not a displacement (mm).
inline bool against_pressure(Quantity quantity) {
    return quantity != Quantity::area_at_displacement && quantity != Quantity::load_at_displacement;
}

/// The columns of a target's file, and the size of their units in the units of its quantity.
struct WrittenColumns {
    std::string x;     ///< for example "pressure_psi"
    std::string y;     ///< for example "conductance_W_per_m2K"
    double x_unit = 1; ///< one unit of x, MPa or mm
    double y_unit = 1; ///< one unit of y, in the unit of the quantity
};

/// A curve that a design must match, with its weight. A band contains the values that count as a match.
struct Target {
    Quantity quantity = Quantity::stiffness;          ///< y and x of the curve
    std::string name = {};                            ///< path of the file, or another origin
    Eigen::VectorXd x = {};                           ///< x of the points in the quantity's units, > 0, increasing
    Eigen::VectorXd y = {};                           ///< y of the points, > 0
    Eigen::VectorXd lower = {};                       ///< lower end of the band at each x, or empty
    Eigen::VectorXd upper = {};                       ///< upper end of the band at each x, or empty
    double weight = 1;                                ///< factor on each misfit, in (0, 1]
    std::map<std::string, std::string> recorded = {}; ///< model that the file states: "kernel", ...
    std::optional<WrittenColumns> written = {};       ///< as the file has them; none: those of the quantity

    Index points() const { return x.size(); }       ///< number of points
    double last() const { return x[points() - 1]; } ///< the largest x
    /// Whether x is a mean pressure (MPa), not a displacement (mm).
    bool against_pressure() const { return rough::against_pressure(quantity); }
    bool has_band() const { return lower.size() > 0; } ///< whether a band is given
};

/// The columns of a target file, e.g. "pressure_MPa" and "stiffness_MPa_per_mm".
struct Columns {
    const char* x; ///< name of the column of x
    const char* y; ///< name of the column of y
};
Columns columns_of(Quantity quantity);           ///< the names of a quantity's columns in a target file
WrittenColumns columns_of(const Target& target); ///< the columns of a target's file

/// Throws InputError if points are missing, x is not positive and increasing, y is out of range, or a band
/// excludes y. The message names the point (from 1) and the value.
void validate(const Target& target);

/// Factors that convert the columns of a target file into a quantity.
struct TargetScales {
    std::optional<double> nominal_area = {}; ///< mm^2; without it, columns of loads or areas are refused
    double effective_modulus = 1;            ///< E* of the bodies that conduct, MPa
    std::optional<double> resistivity = {};  ///< rho_1 + rho_2 of both bodies: electrical resistivities, ohm m
    /// 1/k_1 + 1/k_2 of both bodies, with the thermal conductivities k (W/(m K)), m K/W
    std::optional<double> thermal_resistivity = {};
    /// Shear strength sigma, MPa: the friction is sigma times the contact area.
    std::optional<double> shear_strength = {};
};

/// The columns of a conductance: thermal (conductance_W_per_m2K) if the scales have a thermal resistivity, electrical
/// (conductance_S_per_m2) if they have a resistivity. A conductance per nominal area is C = 2 K_i/(E* (rho_1 + rho_2)),
/// with the interface stiffness K_i (Barber 2003). Throws InputError if the scales have neither or both.
WrittenColumns conductance_columns(const TargetScales& scales);

/// Reads a target file: CSV, header first, columns in any order. The header determines the separator: comma, semicolon
/// or tab. Semicolons and tabs allow decimal commas. It has one x column (pressure_MPa or displacement_mm), one y
/// column (contact_fraction, stiffness_MPa_per_mm, interface_stiffness_MPa_per_mm, a conductance; with displacement_mm
/// also pressure_MPa) and optionally lower and upper. A column name may state another unit. A pressure may be in Pa,
/// kPa, MPa, GPa, bar or psi. A load in uN, mN, N or kN is divided by the nominal area. A displacement may be in any
/// unit of length, e.g. displacement_um. A contact area may be in percent (contact_percent), or in the square of a
/// length, e.g. area_mm2. With a shear strength sigma, friction_N or shear_MPa (friction over the nominal area) is
/// divided by sigma and gives the contact area. normal_N is a load. A stiffness is a pressure or a load per length,
/// e.g. stiffness_N_per_um. A conductance is that of conductance_columns(). Lines "# key: value" record the model.
/// Throws InputError that names file and line or column.
Target read_target(const std::filesystem::path& file, const TargetScales& scales = {});

/// The text of a target's file, in the units of columns_of(target), with 17 digits.
std::string to_csv(const Target& target);

/// The curve of `response` that is compared with a target of this quantity.
Curve curve_of(Quantity quantity, const Response& response);

/// The misfit of a value y at the target's point k, times the weight. The misfit is y/y_k - 1. If the target
/// has a band, it is the distance to the band, divided by y_k.
inline double misfit(const Target& target, Index k, double y) {
    const double wanted = target.has_band() ? std::clamp(y, target.lower[k], target.upper[k]) / target.y[k] : 1;
    return target.weight * (y / target.y[k] - wanted);
}
/// The misfits of the values of a curve at the target's points.
Eigen::VectorXd misfit(const Target& target, const Eigen::VectorXd& values);
/// The misfits of a curve. Throws InputError if a point of the target is outside the curve's range.
Eigen::VectorXd misfit(const Target& target, const Curve& curve);

/// The derivatives d misfit/dgene, points x genes; zero within the band. `misfits` are those of the curve.
Eigen::MatrixXd misfit_jacobian(const Target& target, const Curve& curve, const CurveJacobian& jacobian,
                                const Eigen::VectorXd& misfits);

/// Similarity (Eq. 12) for these misfits: 1 - the largest |misfit|. Without band and weight it is
/// s = 1 - max_k |y_k - y(x_k)|/|y_k|. Equal curves have similarity 1. It may be negative.
inline double similarity(const Eigen::VectorXd& misfits) { return 1 - misfits.cwiseAbs().maxCoeff(); }
double similarity(const Target& target, const Curve& curve); ///< similarity of a curve to the target

/// Similarity of `curve` to `reference`, after x of `curve` is scaled so that both end at one x (Eq. 11).
double similarity(const Curve& reference, const Curve& curve);

/// The model's values on which a target's curve depends. Keys are names with units.
std::map<std::string, std::string> recorded_model(const Model& model);

/// A value in a target's file that differs from the model's.
struct RecordedDifference {
    std::string key;      ///< "kernel", "datum_mm", ...
    std::string recorded; ///< value in the target's file
    std::string here;     ///< value of the model; "" if it has none
};

/// The differences between target and model on which the target's curve depends. The order is kernel, length,
/// width, modulus, datum, strip width, layers. Numbers may differ by 1e-9 (relative). Throws InputError if a
/// recorded number cannot be read.
std::vector<RecordedDifference> recorded_differences(const Target& target, const Model& model);

/// The differences that hardly affect the target's curve: datum and length, only for an interface stiffness.
std::vector<RecordedDifference> carried_over(const Target& target, const Model& model);

/// The differences in words: "kernel strip (here free), length_mm 0.004 (here 0.84942)".
std::string in_words(const std::vector<RecordedDifference>& differences);

/// Throws InputError that names all recorded_differences, if there are any.
void expect_recorded(const Target& target, const Model& model);

/// The places of the points of a target.
struct PointPlacement {
    Index count = 20;                 ///< number of points, at least 1
    std::optional<double> last = {};  ///< largest x; none: the last load step
    std::optional<double> first = {}; ///< smallest x; none: `last` over `count`
    bool logarithmic = false;         ///< whether x grows by a constant factor, not by a constant step

    /// The x of the points up to `end`. Throws InputError unless 0 < `first` < `end`, if there is a choice.
    Eigen::VectorXd up_to(double end) const;
};

/// A target with the values y(x) at these x, in the quantity's units.
Target target_at(Quantity quantity, const std::string& name, const Eigen::VectorXd& x,
                 const std::function<double(double)>& y);

/// A profile's response as a target, with its recorded model. If the last point is not given or beyond the
/// last load step, this step is used. Points at which the curve is continued to 0 or less are omitted. Unless
/// `resolution` is `off`, the band spans the curves of the given heights and of finer_responses(). Throws
/// InputError if an interface stiffness is infinite at full contact.
Target target_like(const Profile& profile, const Model& model, const std::string& name,
                   Quantity quantity = Quantity::stiffness, const PointPlacement& points = {},
                   Resolution resolution = Resolution::off);
/// Targets of several quantities, as target_like; the response is computed once.
std::vector<Target> targets_like(const Profile& profile, const Model& model, const std::string& name,
                                 const std::vector<Quantity>& quantities, const PointPlacement& points,
                                 Resolution resolution);

} // namespace rough
