#include "domain/contact/kernel.hpp"

#include "domain/numerics/fourier.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

namespace rough {

namespace {

constexpr double pi = std::numbers::pi;

/// 2 integral of asinh(b/|x|) over the element at distance r (in spacings); b is half the strip's width.
double strip_entry(double r, double b) {
    if (r == 0)
        return 4 * (0.5 * std::asinh(2 * b) + b * std::asinh(0.5 / b));
    if (r < 4) {
        auto primitive = [b](double x) { return x * std::asinh(b / x) + b * std::asinh(x / b); };
        return 2 * (primitive(r + 0.5) - primitive(r - 0.5));
    }
    // Eight Gauss points: the nearest singularity is 8 half-widths away, so the error is below 1e-18, where
    // the closed form's difference would lose log10(r) digits.
    static constexpr double abscissa[] = {0.18343464249564980494, 0.52553240991632898582,
                                          0.79666647741362673959, 0.96028985649753623168};
    static constexpr double weight[] = {0.36268378337836198297, 0.31370664587788728734,
                                        0.22238103445337447054, 0.10122853629037625915};
    double sum = 0;
    for (int k = 0; k < 4; ++k)
        sum +=
            weight[k] * (std::asinh(b / (r - 0.5 * abscissa[k])) + std::asinh(b / (r + 0.5 * abscissa[k])));
    return sum;
}

} // namespace

double profile_length(const Profile& profile, Kernel kernel) {
    const Index columns = profile.shape().columns;
    return profile.spacing * static_cast<double>(kernel == Kernel::periodic ? columns : columns - 1);
}

double elements(const Profile& profile, Kernel kernel) {
    if (profile.is_2d())
        return static_cast<double>(profile.nodes());
    return profile_length(profile, kernel) / profile.spacing;
}

double datum_limit(const Profile& profile) {
    return profile.spacing * static_cast<double>(profile.nodes()) / 4;
}

namespace {

/// The last two that were made of other keys by this thread: a search asks for the same again and again, or
/// for a fine and a coarse grid's in turn.
template <class Key, class Make>
Eigen::VectorXd remembered(const Key& key, Make make) {
    struct Known {
        std::optional<Key> of;
        Eigen::VectorXd values;
    };
    thread_local Known last, before;
    if (last.of != key) {
        std::swap(last, before);
        if (last.of != key)
            last = {key, make()};
    }
    return last.values;
}

} // namespace

Eigen::VectorXd periodic_spectrum(Index nodes, const Layering& layering) {
    return remembered(std::pair(nodes, layering), [&] {
        Eigen::VectorXd spectrum(nodes / 2 + 1);
        spectrum[0] = mean_compliance(layering, 1);
        for (Index k = 1; k < spectrum.size(); ++k) { // S_k = 2/(E* q_k), q_k = 2 pi k/L
            spectrum[k] = static_cast<double>(nodes) / (pi * static_cast<double>(k));
            if (!layering.layers.empty())
                spectrum[k] *= relative_compliance(layering, 1, 2 / spectrum[k]);
        }
        return spectrum;
    });
}

namespace {

Eigen::VectorXd computed_column(Kernel kernel, Index nodes, double datum, double strip_width,
                                const Layering& layering) {
    Eigen::VectorXd column(nodes);
    switch (kernel) {
    case Kernel::free: {
        // -(2/pi) [F(r+a) - F(r-a) - 2a], F(t) = t ln|t/d|, a = 1/2
        const double d2 = datum * datum;
        column[0] = -(2 / pi) * (std::log(0.5 / datum) - 1);
        for (Index i = 1; i < nodes; ++i) {
            const double r = static_cast<double>(i);
            column[i] = -(2 / pi) * (r * std::log1p(1 / (r - 0.5)) + 0.5 * std::log((r * r - 0.25) / d2) - 1);
        }
        break;
    }
    case Kernel::periodic: {
        FourierOperator transform = FourierOperator::circulant(nodes, periodic_spectrum(nodes, layering));
        std::fill_n(transform.input(), nodes, 0.0);
        transform.input()[0] = 1;
        const double* row = transform.apply();
        for (Index i = 0; i < nodes; ++i) // symmetric to the last bit
            column[i] = i == 0 ? row[0] : 0.5 * (row[i] + row[nodes - i]);
        break;
    }
    case Kernel::strip:
        for (Index i = 0; i < nodes; ++i)
            column[i] = strip_entry(static_cast<double>(i), strip_width / 2) / pi;
        break;
    }
    return column;
}

} // namespace

Eigen::VectorXd influence_column(Kernel kernel, Index nodes, double datum, double strip_width,
                                 const Layering& layering) {
    return remembered(std::tuple(kernel, nodes, datum, strip_width, layering),
                      [&] { return computed_column(kernel, nodes, datum, strip_width, layering); });
}

namespace {

/// Of Love's double integral of 1/r: its difference over a cell's corners is the integral over the cell.
double love_corner(double x, double y) {
    return (x == 0 ? 0 : x * std::asinh(y / std::abs(x))) + (y == 0 ? 0 : y * std::asinh(x / std::abs(y)));
}

/// The integral of 1/r over a cell 1 x b about (x, y): between corners near by; far away, where their
/// difference loses digits, by 4 x 4 Gauss points, good to 1e-14 from `far` cells on.
double cell_potential(double x, double y, double b) {
    constexpr double far = 16;
    const double r = std::hypot(x, y);
    if (r < far * std::max(1.0, b))
        return love_corner(x + 0.5, y + 0.5 * b) - love_corner(x - 0.5, y + 0.5 * b) -
               love_corner(x + 0.5, y - 0.5 * b) + love_corner(x - 0.5, y - 0.5 * b);
    static constexpr double abscissa[] = {-0.43056815579702628761, -0.16999052179242813, 0.16999052179242813,
                                          0.43056815579702628761};
    static constexpr double weight[] = {0.17392742256872692869, 0.32607257743127307131,
                                        0.32607257743127307131, 0.17392742256872692869};
    double sum = 0;
    for (int m = 0; m < 4; ++m)
        for (int k = 0; k < 4; ++k) {
            const double dx = x + abscissa[k], dy = y + b * abscissa[m];
            sum += weight[m] * weight[k] / std::sqrt(dx * dx + dy * dy);
        }
    return b * sum;
}

Eigen::VectorXd computed_area_column(Kernel kernel, Extent shape, double row_spacing,
                                     const Layering& layering) {
    Eigen::VectorXd column(shape.nodes());
    if (kernel == Kernel::periodic) {
        FourierOperator transform =
            FourierOperator::circulant(shape, area_spectrum(shape, row_spacing, layering));
        std::fill_n(transform.input(), shape.nodes(), 0.0);
        transform.input()[0] = 1;
        const double* table = transform.apply();
        const auto mirror = [](Index i, Index n) { return i == 0 ? 0 : n - i; };
        for (Index j = 0; j < shape.rows; ++j)
            for (Index i = 0; i < shape.columns; ++i) { // symmetric to the last bit
                const double* row = table + j * shape.columns;
                const double* other = table + mirror(j, shape.rows) * shape.columns;
                const Index k = mirror(i, shape.columns);
                column[j * shape.columns + i] = 0.25 * ((row[i] + row[k]) + (other[i] + other[k]));
            }
        return column;
    }
    for (Index j = 0; j < shape.rows; ++j)
        for (Index i = 0; i < shape.columns; ++i)
            column[j * shape.columns + i] =
                cell_potential(static_cast<double>(i), row_spacing * static_cast<double>(j), row_spacing) /
                std::numbers::pi;
    return column;
}

} // namespace

Eigen::VectorXd area_spectrum(Extent shape, double row_spacing, const Layering& layering) {
    return remembered(std::tuple(shape.columns, shape.rows, row_spacing, layering), [&] {
        const Index half = shape.columns / 2 + 1;
        Eigen::VectorXd spectrum(half * shape.rows);
        for (Index j = 0; j < shape.rows; ++j)
            for (Index i = 0; i < half; ++i) { // 2/|q|, q = 2 pi (k_x/L_x, k_y/L_y)
                const double x = static_cast<double>(i) / static_cast<double>(shape.columns);
                const double y = static_cast<double>(std::min(j, shape.rows - j)) /
                                 (row_spacing * static_cast<double>(shape.rows));
                double& value = spectrum[j * half + i];
                value = i == 0 && j == 0 ? mean_compliance(layering, 1)
                                         : 1 / (std::numbers::pi * std::sqrt(x * x + y * y));
                if (!layering.layers.empty() && i + j > 0)
                    value *= relative_compliance(layering, 1, 2 / value);
            }
        return spectrum;
    });
}

Eigen::VectorXd area_influence_column(Kernel kernel, Extent shape, double row_spacing,
                                      const Layering& layering) {
    return remembered(std::tuple(kernel, shape.columns, shape.rows, row_spacing, layering),
                      [&] { return computed_area_column(kernel, shape, row_spacing, layering); });
}

bool contact_sets_nest(Extent shape, double row_spacing, const Layering& layering) {
    if (layering.layers.empty())
        return true;
    constexpr double rounding = 1e-9; // of the diagonal
    const Eigen::VectorXd found =
        remembered(std::tuple(shape.columns, shape.rows, row_spacing, layering), [&] {
            Eigen::ArrayXd stiffness = 1 / (row_spacing > 0 ? area_spectrum(shape, row_spacing, layering)
                                                            : periodic_spectrum(shape.columns, layering))
                                               .array();
            if (!layering.carries_mean())
                stiffness[0] = 0;
            FourierOperator inverse = FourierOperator::circulant(shape, stiffness.matrix());
            std::fill_n(inverse.input(), shape.nodes(), 0.0);
            inverse.input()[0] = 1;
            const Eigen::Map<const Eigen::VectorXd> column(inverse.apply(), shape.nodes());
            return Eigen::VectorXd::Constant(1, column.tail(shape.nodes() - 1).maxCoeff() / column[0]);
        });
    return found[0] <= rounding;
}

bool contact_sets_nest(const Body& body, const Grid& grid) {
    return contact_sets_nest(
        grid.shape(), grid.is_2d() ? grid.row_spacing() / grid.spacing() : 0,
        in_units(completed(body, grid.length).layering, grid.spacing(), body.effective_modulus));
}

} // namespace rough
