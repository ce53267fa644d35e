#include "domain/numerics/statistics.hpp"
#include "experiments/compare/problems/problems.hpp"

#include <cstdlib>
#include <numbers>

namespace app {
namespace {

using Array = Eigen::ArrayXd;
using Index = Eigen::Index;

constexpr double tau = 2 * std::numbers::pi;
constexpr double next_to_nothing = 1e-99; // replaces 0, which has no logarithm
constexpr long modulus = 2147483647;

// BBOB's random generator of 2009, which gives instances the optima, rotations and peaks of COCO.

/// n numbers in (0, 1): Park and Miller's generator (1988) through a table of 32 (Bays and Durham 1976).
Array unif(Index n, long seed) {
    long state = std::max(1L, std::labs(seed));
    const auto step = [&] { return state = 16807 * state % modulus; };
    std::array<long, 32> table{};
    for (int i = 0; i < 8; ++i) step();
    for (std::size_t i = table.size(); i-- > 0;) table[i] = step();
    Array numbers(n);
    long out = table[0];
    for (double& number : numbers) {
        long& slot = table[static_cast<std::size_t>(out / 67108865)];
        out = slot;
        slot = step();
        number = std::max(next_to_nothing, static_cast<double>(out) / static_cast<double>(modulus));
    }
    return numbers;
}

/// n normal numbers (Box and Muller 1958).
Array gauss(Index n, long seed) {
    const Array u = unif(2 * n, seed);
    return u.head(n).binaryExpr(u.tail(n), [](double size, double turn) {
        const double number = std::sqrt(-2 * std::log(size)) * std::cos(tau * turn);
        return number == 0 ? next_to_nothing : number;
    });
}

/// An orthogonal matrix by Gram and Schmidt from normal columns.
Eigen::MatrixXd rotation(int dimension, long seed) {
    const Array drawn = gauss(dimension * dimension, seed);
    Eigen::MatrixXd columns = drawn.matrix().reshaped(dimension, dimension);
    for (int i = 0; i < dimension; ++i) {
        for (int j = 0; j < i; ++j) columns.col(i) -= columns.col(i).dot(columns.col(j)) * columns.col(j);
        columns.col(i).normalize();
    }
    return columns;
}

/// The optimum, on a lattice of 8e-4 in [-4, 4]^n.
Array place_of_optimum(int dimension, long seed) {
    return unif(dimension, seed).unaryExpr([](double u) {
        const double place = 8 * std::floor(1e4 * u) / 1e4 - 4;
        return place == 0 ? -1e-5 : place;
    });
}

/// The seed of a function's instance; 3 and 4, 17 and 18 share theirs.
long seed_of(int function, int instance) {
    return (function == 4 ? 3 : function == 18 ? 17 : function) + 10000L * instance;
}

/// The value at the optimum: 100 times a ratio of normal numbers, with two decimals, from -1000 to 1000.
double value_of_optimum(int function, int instance) {
    const long seed = seed_of(function, instance);
    const double ratio = gauss(1, seed)[0] / gauss(1, seed + 1)[0];
    return std::clamp(std::floor(100 * 100 * ratio + 0.5) / 100, -1000.0, 1000.0);
}

double rounded(double x) { return std::floor(x + 0.5); }

/// T_osz: bumps on a logarithmic scale that leave sign and order.
double oscillating(double x) {
    if (x == 0) return 0;
    const double l = std::log(std::abs(x)) / 0.1;
    const double waves = x > 0 ? std::sin(l) + std::sin(0.79 * l) : std::sin(0.55 * l) + std::sin(0.31 * l);
    return std::copysign(std::exp(0.1 * (l + 0.49 * waves)), x);
}
Array oscillating(const Array& x) {
    return x.unaryExpr([](double xi) { return oscillating(xi); });
}

/// T_asy^beta: the positive half grows faster, the more so the later the coordinate.
Array asymmetric(double beta, const Array& ramp, const Array& x) {
    Array y = x;
    for (Index i = 0; i < y.size(); ++i)
        if (y[i] > 0) y[i] = std::pow(y[i], 1 + beta * ramp[i] * std::sqrt(y[i]));
    return y;
}

/// f_pen: squared distances beyond [-5, 5].
double penalty(const Array& x) { return (x.abs() - 5).max(0).square().sum(); }

double ellipsoid(const Array& ramp, const Array& z) { return (Eigen::pow(1e6, ramp) * z.square()).sum(); }
double rastrigin(const Array& z) {
    return 10 * (static_cast<double>(z.size()) - (tau * z).cos().sum()) + z.square().sum();
}
double rest(const Array& z) { return z.tail(z.size() - 1).square().sum(); }

/// Terms of Rosenbrock's function, one for each pair of neighbours.
Array valley(const Array& z) {
    const Index n = z.size() - 1;
    return 100 * (z.head(n).square() - z.tail(n)).square() + (z.head(n) - 1).square();
}

double weierstrass(const Array& z) {
    double sum = 0, lowest = 0;
    for (int k = 0; k < 12; ++k) {
        const double a = std::pow(0.5, k), b = std::pow(3.0, k);
        sum += a * (tau * b * (z + 0.5)).cos().sum() / static_cast<double>(z.size());
        lowest += a * std::cos(tau * b * 0.5);
    }
    return 10 * std::pow(sum - lowest, 3);
}

double schaffers(const Array& z) {
    const Index n = z.size() - 1;
    const Array s = (z.head(n).square() + z.tail(n).square()).sqrt();
    return std::pow((s.sqrt() * (1 + (50 * s.pow(0.2)).sin().square())).mean(), 2);
}

double griewank_rosenbrock(const Array& z) {
    const Array s = valley(z);
    return 10 + 10 * (s / 4000 - s.cos()).mean();
}

double katsuura(const Array& z) {
    const double n = static_cast<double>(z.size());
    double product = 1;
    for (Index i = 0; i < z.size(); ++i) {
        double sum = 0;
        for (int j = 1; j <= 32; ++j) {
            const double scale = std::ldexp(1.0, j);
            sum += std::abs(scale * z[i] - rounded(scale * z[i])) / scale;
        }
        product *= 1 + static_cast<double>(i + 1) * sum;
    }
    return 10 / (n * n) * (std::pow(product, 10 / std::pow(n, 1.2)) - 1);
}

/// Indices in ascending order of the numbers.
std::vector<double> order_of(const Array& numbers) {
    const auto order = rough::ascending({numbers.begin(), numbers.end()});
    return {order.begin(), order.end()};
}

} // namespace

Array Bbob::scales(double condition) const { return Eigen::pow(condition, ramp_ / 2); }

Bbob::Bbob(int function, int dimension, int instance)
    : function_(function), dimension_(dimension), value_(value_of_optimum(function, instance)),
      ramp_(Array::LinSpaced(dimension, 0, 1)) {
    const long seed = seed_of(function, instance);
    constexpr long other = 1000000; // between the seeds of the two rotations
    shift_ = place_of_optimum(dimension, function == 12 ? seed + other : seed);
    first_ = rotation(dimension, seed + other);
    second_ = rotation(dimension, seed);
    const double condition = function == 23 ? 100 : function == 16 ? 0.01 : 10;
    combined_ = first_ * scales(condition).matrix().asDiagonal() * second_;

    const double stretch = std::max(1.0, std::sqrt(dimension) / 8);
    if (function == 4)
        for (Index i = 0; i < dimension; i += 2) shift_[i] = std::abs(shift_[i]);
    if (function == 8) shift_ *= 0.75;
    Array best = shift_;
    if (function == 5) best = shift_ = shift_.unaryExpr([](double xi) { return xi > 0 ? 5.0 : -5.0; });
    if (function == 9 || function == 19) {
        second_ *= stretch;
        best = (second_.transpose() * Eigen::VectorXd::Constant(dimension, 0.5 / (stretch * stretch))).array();
    }
    if (function == 20 || function == 24) {
        const Array drawn = function == 20 ? unif(dimension, seed) : gauss(dimension, seed);
        const double middle = function == 20 ? 0.5 : 0, distance = function == 20 ? 4.2096874637 / 2 : 2.5 / 2;
        shift_ = drawn.unaryExpr([&](double number) { return number < middle ? -1.0 : 1.0; });
        best = distance * shift_;
    }
    if (function == 21 || function == 22) {
        draw_peaks(seed);
        best = (second_.transpose() * peaks_.col(0).matrix()).array();
    }
    optimum_.assign(best.begin(), best.end());
}

void Bbob::draw_peaks(long seed) {
    const Index count = function_ == 21 ? 101 : 21;
    const double width = function_ == 21 ? 10 : 9.8, below = static_cast<double>(count - 2);
    const std::vector<double> levels = order_of(unif(count - 1, seed));
    const Array places = unif(dimension_ * count, seed);
    heights_.resize(count);
    peaks_.resize(dimension_, count);
    widths_.resize(dimension_, count);
    for (Index k = 0; k < count; ++k) {
        heights_[k] = k == 0 ? 10 : 1.1 + 8 * static_cast<double>(k - 1) / below;
        const double condition = k > 0             ? std::pow(1000, levels[static_cast<std::size_t>(k - 1)] / below)
                                 : function_ == 21 ? std::sqrt(1000)
                                                   : 1000;
        const std::vector<double> order = order_of(unif(dimension_, seed + 1000 * k));
        std::ranges::transform(order, widths_.col(k).begin(),
                               [&](double place) { return std::pow(condition, place / (dimension_ - 1) - 0.5); });
        const Array place = (k == 0 ? 0.8 : 1) * (width * places.segment(k * dimension_, dimension_) - width / 2);
        peaks_.col(k) = (second_ * place.matrix()).array();
    }
}

double Bbob::operator()(const std::vector<double>& x) const {
    return value_ + above(Eigen::Map<const Array>(x.data(), dimension_));
}

double Bbob::above(const Array& x) const {
    const Array moved = x - shift_;
    Array z;
    switch (function_) {
    case 1:
        return moved.square().sum();
    case 2:
        return ellipsoid(ramp_, oscillating(moved));
    case 3:
        return rastrigin(scales(10) * asymmetric(0.2, ramp_, oscillating(moved)));
    case 4:
        z = oscillating(moved);
        for (Index i = 0; i < dimension_; ++i)
            z[i] *= std::sqrt(std::pow(10, ramp_[i])) * (i % 2 == 0 && z[i] > 0 ? 10 : 1);
        return rastrigin(z) + 100 * penalty(x);
    case 5: // flat beyond the corner
        return (scales(100) * (5 - (x * shift_ / 5).min(5))).sum();
    case 6:
        z = (combined_ * moved.matrix()).array();
        return std::pow(oscillating((z * (z * shift_ > 0).select(Array::Constant(z.size(), 100), 1)).square().sum()),
                        0.9);
    case 7:
        return step_ellipsoid(x);
    case 8:
        return valley(std::max(1.0, std::sqrt(dimension_) / 8) * moved + 1).sum();
    case 9:
        return valley((second_ * x.matrix()).array() + 0.5).sum();
    case 10:
        return ellipsoid(ramp_, oscillating(turned(moved)));
    case 11:
        z = oscillating(turned(moved));
        return 1e6 * z[0] * z[0] + rest(z);
    case 12:
        z = turned(asymmetric(0.5, ramp_, turned(moved)));
        return z[0] * z[0] + 1e6 * rest(z);
    case 13:
        z = (combined_ * moved.matrix()).array();
        return z[0] * z[0] + 100 * std::sqrt(rest(z));
    case 14:
        z = turned(moved).abs();
        return std::sqrt(z.pow(2 + 4 * ramp_).sum());
    case 15:
        return rastrigin((combined_ * asymmetric(0.2, ramp_, oscillating(turned(moved))).matrix()).array());
    case 16:
        return weierstrass((combined_ * oscillating(turned(moved)).matrix()).array()) + 10.0 / dimension_ * penalty(x);
    case 17:
    case 18:
        return schaffers(scales(function_ == 17 ? 10 : 1000) *
                         (second_ * asymmetric(0.5, ramp_, turned(moved)).matrix()).array()) +
               10 * penalty(x);
    case 19:
        return griewank_rosenbrock((second_ * x.matrix()).array() + 0.5);
    case 20:
        return schwefel(x);
    case 21:
    case 22:
        return gallagher(x);
    case 23:
        return katsuura((combined_ * moved.matrix()).array()) + penalty(x);
    default:
        return lunacek(x);
    }
}

double Bbob::step_ellipsoid(const Array& x) const {
    Array z = scales(10) * (second_ * (x - shift_).matrix()).array();
    const double first = std::abs(z[0]);
    for (double& zi : z) zi = std::abs(zi) > 0.5 ? rounded(zi) : rounded(10 * zi) / 10;
    z = turned(z);
    return 0.1 * std::max(first / 1e4, (Eigen::pow(100, ramp_) * z.square()).sum()) + penalty(x);
}

double Bbob::schwefel(const Array& x) const {
    constexpr double best = 4.2096874637; // 2 |x_opt|
    const Array hat = 2 * shift_ * x;
    Array z = hat;
    z.tail(dimension_ - 1) += 0.25 * (hat.head(dimension_ - 1) - best);
    z = 100 * (scales(10) * (z - best) + best);
    return 0.01 * ((z.abs() - 500).max(0).square().sum() + 418.9828872724339 - (z * z.abs().sqrt().sin()).mean());
}

double Bbob::gallagher(const Array& x) const {
    const Array z = (second_ * x.matrix()).array();
    const auto weighed = (widths_ * (peaks_.colwise() - z).square()).colwise().sum().transpose();
    const double highest = (heights_ * (-0.5 / dimension_ * weighed).exp()).maxCoeff();
    const double below = oscillating(10 - highest);
    return below * below + penalty(x);
}

double Bbob::lunacek(const Array& x) const {
    constexpr double mu0 = 2.5, depth = 1;
    const double s = 1 - 0.5 / (std::sqrt(dimension_ + 20.0) - 4.1), mu1 = -std::sqrt((mu0 * mu0 - depth) / s);
    const Array hat = 2 * shift_ * x;
    const Array z = turned(scales(100) * (second_ * (hat - mu0).matrix()).array());
    return std::min((hat - mu0).square().sum(), depth * dimension_ + s * (hat - mu1).square().sum()) +
           10 * (dimension_ - (tau * z).cos().sum()) + 1e4 * penalty(x);
}

} // namespace app
