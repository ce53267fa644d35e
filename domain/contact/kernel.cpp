#include "domain/contact/kernel.hpp"

#include "domain/numerics/fourier.hpp"

#include <cmath>
#include <numbers>

namespace rough {
namespace {

using std::numbers::pi;

/// 2 integral of asinh(b/|x|) over the element at distance r (in spacings); b is half the strip's width.
double strip_entry(double r, double b) {
    if (r == 0) return 4 * (0.5 * std::asinh(2 * b) + b * std::asinh(0.5 / b));
    if (r < 4) {
        auto primitive = [b](double x) { return x * std::asinh(b / x) + b * std::asinh(x / b); };
        return 2 * (primitive(r + 0.5) - primitive(r - 0.5));
    }
    // Eight Gauss points: the nearest singularity is 8 half-widths away, so the error is below 1e-18. The
    // difference of the closed form would lose log10(r) digits there.
    static constexpr double abscissa[] = {0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959,
                                          0.96028985649753623168};
    static constexpr double weight[] = {0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054,
                                        0.10122853629037625915};
    double sum = 0;
    for (int k = 0; k < 4; ++k)
        sum += weight[k] * (std::asinh(b / (r - 0.5 * abscissa[k])) + std::asinh(b / (r + 0.5 * abscissa[k])));
    return sum;
}

/// The integral of x^2/r^3 over the patch at distance r: Cerruti's solution less strip_entry() for a
/// Poisson's ratio of 1/2.
double cerruti_entry(double r, double b) {
    if (r == 0) return 4 * b * std::asinh(0.5 / b);
    const double from = (r - 0.5) / b, to = (r + 0.5) / b, near = std::hypot(1, from), far = std::hypot(1, to);
    return 2 * b * std::log1p((1 + (from + to) / (near + far)) / (b * (from + near)));
}

/// Love's double integral of 1/r, whose difference over a cell's corners is the integral over the cell.
double love_corner(double x, double y) {
    return (x == 0 ? 0 : x * std::asinh(y / std::abs(x))) + (y == 0 ? 0 : y * std::asinh(x / std::abs(y)));
}

/// The integral of 1/r over a cell 1 x b about (x, y). Near the cell by its corners. From `far` cells on,
/// where their difference loses digits, by 4 x 4 Gauss points, good to 1e-14.
double cell_potential(double x, double y, double b) {
    constexpr double far = 16;
    const double r = std::hypot(x, y);
    if (r < far * std::max(1.0, b))
        return love_corner(x + 0.5, y + 0.5 * b) - love_corner(x - 0.5, y + 0.5 * b) -
               love_corner(x + 0.5, y - 0.5 * b) + love_corner(x - 0.5, y - 0.5 * b);
    static constexpr double abscissa[] = {-0.43056815579702628761, -0.16999052179242813, 0.16999052179242813,
                                          0.43056815579702628761};
    static constexpr double weight[] = {0.17392742256872692869, 0.32607257743127307131, 0.32607257743127307131,
                                        0.17392742256872692869};
    double sum = 0;
    for (int m = 0; m < 4; ++m)
        for (int k = 0; k < 4; ++k) {
            const double dx = x + abscissa[k], dy = y + b * abscissa[m];
            sum += weight[m] * weight[k] / std::sqrt(dx * dx + dy * dy);
        }
    return b * sum;
}

struct Known {
    std::optional<std::pair<UnitBody, Extent>> of;
    Eigen::VectorXd values;
};

/// Remembers the last two results of this thread. A search needs the same one many times, or those of a fine
/// and a coarse grid in turn.
template <class Make>
Eigen::VectorXd remembered(const UnitBody& body, Extent shape, Make make) {
    const std::pair key(body, shape);
    thread_local Known last, before;
    if (last.of != key) {
        std::swap(last, before);
        if (last.of != key) last = {key, make()};
    }
    return last.values;
}

/// The column of the circulant with these eigenvalues, before it is made symmetric.
Eigen::VectorXd circulant_column(const Eigen::VectorXd& eigenvalues, Extent shape) {
    FourierOperator transform = FourierOperator::circulant(shape, eigenvalues);
    return Eigen::VectorXd::Map(transform.apply({0}, Eigen::VectorXd::Ones(1)), shape.nodes());
}

/// -(2/pi) [F(r+a) - F(r-a) - 2a], F(t) = t ln|t/d|, a = 1/2
double flamant_entry(double r, double datum) {
    if (r == 0) return -(2 / pi) * (std::log(0.5 / datum) - 1);
    return -(2 / pi) * (r * std::log1p(1 / (r - 0.5)) + 0.5 * std::log((r * r - 0.25) / (datum * datum)) - 1);
}

} // namespace

double profile_length(const Profile& profile, Kernel kernel) {
    const Index columns = profile.shape().columns;
    return profile.spacing * static_cast<double>(profile.is_2d() || kernel == Kernel::periodic ? columns : columns - 1);
}

double largest_displacement(const Profile& profile, const Body& body) {
    if (!body.relative_to_mean() || body.yields()) // nodes at the hardness may sink in
        return std::numeric_limits<double>::infinity();
    const double highest = profile.heights.maxCoeff();
    return (highest - profile.heights.array()).mean(); // Delta_full = max Z - mean Z
}

double elements(const Profile& profile, Kernel kernel) {
    if (profile.is_2d()) return static_cast<double>(profile.nodes());
    return profile_length(profile, kernel) / profile.spacing;
}

double datum_limit(const Profile& profile) { return profile.spacing * static_cast<double>(profile.nodes()) / 4; }

UnitBody in_units(const Body& body, double spacing, double row_spacing) {
    return {body.kernel, row_spacing / spacing, body.datum.value_or(0) / spacing,
            body.strip_width.value_or(0) / spacing, in_units(body.layering, spacing, body.effective_modulus)};
}

Eigen::VectorXd periodic_spectrum(const UnitBody& body, Extent shape) {
    return remembered(body, shape, [&] {
        const Layering& layering = body.layering;
        const Index half = shape.columns / 2 + 1;
        Eigen::VectorXd spectrum(half * shape.rows);
        for (Index j = 0; j <= shape.rows / 2; ++j)
            for (Index i = 0; i < half; ++i) { // 2/|q|, q = 2 pi (k_x/L_x, k_y/L_y)
                const double k = static_cast<double>(i), n = static_cast<double>(shape.columns), x = k / n;
                const double y = static_cast<double>(j) / (body.row_spacing * static_cast<double>(shape.rows));
                double& value = spectrum[j * half + i];
                value = i == 0 && j == 0 ? mean_compliance(layering, 1, body.traction)
                        : body.is_2d()   ? 1 / (pi * std::sqrt(x * x + y * y))
                                         : n / (pi * k);
                if (!layering.layers.empty() && i + j > 0)
                    value *= relative_compliance(layering, 1, 2 / value, body.traction);
            }
        for (Index j = shape.rows / 2 + 1; j < shape.rows; ++j) // waves of the same lengths
            spectrum.segment(j * half, half) = spectrum.segment((shape.rows - j) * half, half);
        return spectrum;
    });
}

Eigen::VectorXd extended_column(const UnitBody& body, const Eigen::VectorXd& known, Extent from, Extent shape,
                                Team& team) {
    Eigen::VectorXd column(shape.nodes());
    const Eigen::VectorXd table =
        body.kernel == Kernel::periodic ? circulant_column(periodic_spectrum(body, shape), shape) : Eigen::VectorXd();
    const auto mirror = [](Index i, Index n) { return i == 0 ? 0 : n - i; };
    team.each_block(shape.rows, [&](Index j, int) {
        for (Index i = 0; i < shape.columns; ++i) {
            const double x = static_cast<double>(i);
            double& entry = column[j * shape.columns + i];
            if (body.kernel == Kernel::periodic) { // symmetric to the last bit
                const double* row = table.data() + j * shape.columns;
                const double* other = table.data() + mirror(j, shape.rows) * shape.columns;
                const Index k = mirror(i, shape.columns);
                entry = body.is_2d() ? 0.25 * ((row[i] + row[k]) + (other[i] + other[k])) : 0.5 * (row[i] + row[k]);
            } else if (j < from.rows && i < from.columns)
                entry = known[j * from.columns + i];
            else if (body.is_2d())
                entry = cell_potential(x, body.row_spacing * static_cast<double>(j), body.row_spacing) / pi;
            else
                entry = body.kernel == Kernel::free ? flamant_entry(x, body.datum)
                                                    : strip_entry(x, body.strip_width / 2) / pi;
            if (body.kernel == Kernel::strip && body.traction == Traction::tangential) {
                const double nu = body.layering.poissons_ratio;
                entry += nu / (1 - nu) * cerruti_entry(x, body.strip_width / 2) / pi;
            }
        }
    });
    return column;
}

Eigen::VectorXd influence_column(const UnitBody& body, Extent shape, Team& team) {
    return remembered(body, shape, [&] { return extended_column(body, {}, {0, 0}, shape, team); });
}

bool contact_sets_nest(const UnitBody& body, Extent shape) {
    if (body.layering.layers.empty()) return true;
    constexpr double rounding = 1e-9; // relative to the diagonal
    const Eigen::VectorXd highest = remembered(body, shape, [&] {
        Eigen::VectorXd stiffness = periodic_spectrum(body, shape).cwiseInverse();
        if (!body.layering.carries_mean()) stiffness[0] = 0;
        const Eigen::VectorXd column = circulant_column(stiffness, shape);
        return Eigen::VectorXd::Constant(1, column.tail(shape.nodes() - 1).maxCoeff() / column[0]);
    });
    return highest[0] <= rounding;
}

bool contact_sets_nest(const Body& body, const Grid& grid) {
    return contact_sets_nest(in_units(body, grid.spacing(), grid.row_spacing()), grid.shape());
}

} // namespace rough
