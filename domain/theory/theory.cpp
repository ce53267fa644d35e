#include "domain/theory/theory.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/fourier.hpp"
#include "ga/base/random.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <numbers>

namespace rough {
namespace {

/// int q^n C dq over the spectrum, for any directions of the waves.
double moment(const Spectrum& spectrum, int n) {
    return (spectrum.wave_number.array().pow(n) * spectrum.power.array()).sum();
}

/// int_from^to q^exponent dq
double power_integral(double exponent, double from, double to) {
    const double n = exponent + 1;
    return std::abs(n) < 1e-12 ? std::log(to / from) : (std::pow(to, n) - std::pow(from, n)) / n;
}

using std::numbers::pi;

double normal_density(double s) { return std::exp(-s * s / 2) / std::sqrt(2 * pi); }

struct Node {
    double at, weight;
};
/// Gauss' rule of 30 nodes on both halves.
std::vector<Node> nodes_on(double from, double to) {
    using Gauss = boost::math::quadrature::gauss<double, 30>;
    std::vector<Node> nodes;
    const double half = (to - from) / 4;
    for (const double middle : {from + half, to - half})
        for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i)
            for (const double side : {-half, half})
                nodes.push_back({middle + side * Gauss::abscissa()[i], half * Gauss::weights()[i]});
    return nodes;
}

/// Load, area and stiffness of the summits at a separation.
struct State {
    double pressure, fraction, stiffness;
};

/// The curve of states at the separations d >= 0, on whose pressure `unit` is the scale of the fall.
template <class StateAt>
TheoryCurve curve_of(const Eigen::VectorXd& pressures, double unit, StateAt at) {
    const Eigen::VectorXd none = Eigen::VectorXd::Constant(pressures.size(), std::numeric_limits<double>::quiet_NaN());
    TheoryCurve curve{pressures, none, none};
    const double largest = at(0).pressure;
    for (Index j = 0; j < pressures.size(); ++j) {
        const double wanted = pressures[j];
        if (!(wanted <= largest)) continue;
        const auto excess = [&](double d) { return std::log(at(d).pressure / wanted); };
        double far = unit;
        while (excess(far) > 0) far += unit;
        std::uintmax_t rounds = 100;
        const auto [low, high] = boost::math::tools::toms748_solve(
            excess, far - unit, far, boost::math::tools::eps_tolerance<double>(48), rounds);
        const State state = at((low + high) / 2);
        curve.contact_fraction[j] = state.fraction;
        curve.stiffness[j] = state.stiffness;
    }
    return curve;
}

void expect_gaussian(const SpectralMoments& m) {
    if (!(m.m0 > 0 && m.m2 > 0 && m.m4 > 0))
        refuse("theory: moments ", m.m0, ", ", m.m2, ", ", m.m4, " are not all above 0; give a rough surface");
    if (!(m.bandwidth() > 1.5))
        refuse("theory: bandwidth ", m.bandwidth(),
               " is out of range (above 1.5, as for every isotropic Gaussian surface)");
}

/// int_t^inf (s - t)^n phi(s) ds, phi the standard normal density, for n = 1/2, 1 and 3/2.
struct Exceedances {
    double half, one, three_halves;
};
/// For any t, to about ten digits.
Exceedances exceedances(double t) {
    static const std::vector<Node> unit = nodes_on(0, 1);
    const double last = std::sqrt(std::pow(std::max(t, 0.0), 2) + 80); // beyond it the density is exp(-40) of that at t
    const double root = std::sqrt(last - t);
    Exceedances of{0, 0, 0};
    for (const Node& node : unit) { // s = t + v^2, smooth in v
        const double v = root * node.at, share = 2 * root * node.weight * v * v * normal_density(t + v * v);
        of.half += share;
        of.one += share * v;
        of.three_halves += share * v * v;
    }
    return of;
}

/// 1/sqrt(2 pi) int f(h'(q)) q/h'(q) dm0, in which q^2 dm0 = 2 h' dh'.
template <class Function>
double over_waves(const Spectrum& spectrum, Function f) {
    double sum = 0, square = 0;
    for (Index k = 0; k < spectrum.power.size(); ++k) {
        const double q = spectrum.wave_number[k], before = std::sqrt(square);
        square += q * q * spectrum.power[k];
        if (square > before * before)
            sum += 2 / q * boost::math::quadrature::gauss<double, 7>::integrate(f, before, std::sqrt(square));
    }
    return sum / std::sqrt(2 * std::numbers::pi);
}

} // namespace

RandomSurface random_surface(const Profile& surface, bool periodic) {
    RandomSurface random{continuous_spectrum(surface, periodic), surface.is_2d()};
    if (!(random.spectrum.power.sum() > 0)) refuse("theory: the surface is flat; give a rough one");
    return random;
}

RandomSurface random_surface(const SelfAffine& of) {
    if (!(of.hurst > 0 && of.hurst < 1)) refuse("hurst: ", of.hurst, " is out of range (0 to 1, both excluded)");
    if (!(of.shortest > 0 && of.longest > of.shortest && std::isfinite(of.longest)))
        refuse("cut-offs: ", of.longest, " and ", of.shortest,
               " mm are not positive lengths in descending order; give the longer one first");
    if (!(of.rms_slope > 0) || !std::isfinite(of.rms_slope) || of.wave_numbers < 1)
        refuse("rms slope: ", of.rms_slope, " is out of range (above 0, finite)");
    RandomSurface random{{Eigen::VectorXd(of.wave_numbers), {}, Eigen::VectorXd(of.wave_numbers)}, of.is_2d};
    const double lowest = 2 * std::numbers::pi / of.longest,
                 step = std::log(of.longest / of.shortest) / static_cast<double>(of.wave_numbers);
    for (Index k = 0; k < of.wave_numbers; ++k) {
        const double from = lowest * std::exp(step * static_cast<double>(k)), to = from * std::exp(step);
        // Around the circle a map's q^-2(1 + H) is a profile's q^-(1 + 2 H).
        const double heights = power_integral(-1 - 2 * of.hurst, from, to),
                     slopes = power_integral(1 - 2 * of.hurst, from, to);
        random.spectrum.power[k] = heights;
        random.spectrum.wave_number[k] = std::sqrt(slopes / heights);
    }
    random.spectrum.power *= of.rms_slope * of.rms_slope / moment(random.spectrum, 2);
    return random;
}

SpectralMoments spectral_moments(const RandomSurface& surface) {
    const double of_slope = surface.is_2d ? 1.0 / 2 : 1, of_curvature = surface.is_2d ? 3.0 / 8 : 1;
    return {moment(surface.spectrum, 0), of_slope * moment(surface.spectrum, 2),
            of_curvature * moment(surface.spectrum, 4)};
}

double rms_slope(const RandomSurface& surface) { return std::sqrt(moment(surface.spectrum, 2)); }

Profile realised(const SelfAffine& parameters, const Grid& grid, std::uint64_t seed) {
    random_surface(parameters); // refuses what is out of range
    if (!grid.periodic || grid.is_2d() != parameters.is_2d)
        refuse("self-affine surface: the grid does not fit; give a periodic one, a line for a profile, a "
               "map for a map");
    const Extent shape = grid.shape();
    const double dx = 1 / grid.length, dy = grid.is_2d() ? 1 / grid.width : 0;
    const double lowest = (1 - 1e-12) / parameters.longest, largest = (1 + 1e-12) / parameters.shortest;
    const auto last = static_cast<Index>(largest / dx), last_row = grid.is_2d() ? static_cast<Index>(largest / dy) : 0;
    Eigen::ArrayXXcd waves = Eigen::ArrayXXcd::Zero(shape.columns, shape.rows);
    ga::Stream random(ga::fold(seed, "self-affine surface"));
    double slopes = 0; // mean square
    for (Index j = -last_row; j <= last_row; ++j)
        for (Index i = j > 0 ? 0 : 1; i <= last; ++i) { // one of q and -q
            const double q = std::hypot(dx * static_cast<double>(i), dy * static_cast<double>(j));
            if (q < lowest || q > largest) continue;
            const double amplitude = std::pow(q, -parameters.hurst - (parameters.is_2d ? 1 : 0.5)),
                         phase = random.uniform(0, 2 * std::numbers::pi);
            slopes += std::pow(2 * std::numbers::pi * q * amplitude, 2) / 2;
            waves(i % shape.columns, (j + last_row * shape.rows) % shape.rows) += std::polar(amplitude, phase);
        }
    if (!(slopes > 0))
        refuse("self-affine surface: no wave of ", parameters.longest, " to ", parameters.shortest,
               " mm fits a surface of ", grid.length, " mm; give longer or shorter cut-offs");
    const double scale = parameters.rms_slope / std::sqrt(slopes);
    return {scale * inverse_complex_transform(waves).real().reshaped().matrix(), grid.spacing(), shape.rows,
            grid.row_spacing()};
}

Summits summits(const SpectralMoments& m) {
    expect_gaussian(m);
    const double alpha = m.bandwidth();
    return {m.m4 / m.m2 / (6 * pi * std::sqrt(3)), 3 * std::sqrt(pi / m.m4) / 8,
            std::sqrt((1 - 0.8968 / alpha) * m.m0)};
}

TheoryCurve greenwood_williamson(const SpectralMoments& moments, double effective_modulus,
                                 const Eigen::VectorXd& pressures) {
    const Summits s = summits(moments);
    const double load = s.density * effective_modulus * std::sqrt(s.radius) * std::pow(s.deviation, 1.5);
    return curve_of(pressures, s.deviation, [&](double d) {
        const Exceedances over = exceedances(d / s.deviation);
        return State{4.0 / 3 * load * over.three_halves, pi * s.density * s.radius * s.deviation * over.one,
                     2 * load / s.deviation * over.half};
    });
}

TheoryCurve persson(const RandomSurface& surface, double effective_modulus, const Eigen::VectorXd& pressures) {
    TheoryCurve curve{pressures, Eigen::VectorXd(pressures.size()), Eigen::VectorXd(pressures.size())};
    const double slope = rms_slope(surface), gamma = 0.45;
    for (Index j = 0; j < pressures.size(); ++j) {
        const double load = std::numbers::sqrt2 * pressures[j] / effective_modulus;
        curve.contact_fraction[j] = std::erf(load / slope);
        curve.stiffness[j] = pressures[j] / over_waves(surface.spectrum, [&](double h) {
                                 const double s = load / h, error = std::erf(s);
                                 return (gamma + 3 * (1 - gamma) * error * error) * std::exp(-s * s);
                             });
    }
    return curve;
}

const std::vector<std::string>& theory_names() {
    static const std::vector<std::string> names{"greenwood-williamson", "persson"};
    return names;
}

const std::string& name_of(Theory theory) { return theory_names()[static_cast<std::size_t>(theory)]; }

bool holds_for(Theory theory, bool is_2d) { return is_2d || theory == Theory::persson; }

TheoryCurve predicted_curve(Theory theory, const RandomSurface& surface, double effective_modulus,
                            const Eigen::VectorXd& pressures) {
    if (!holds_for(theory, surface.is_2d))
        refuse(name_of(theory), ": this theory is for maps only; choose persson for a profile");
    if (!(effective_modulus > 0) || !(pressures.array() > 0).all())
        refuse(name_of(theory), ": modulus or a mean pressure is not above 0; give positive ones");
    return theory == Theory::persson ? persson(surface, effective_modulus, pressures)
                                     : greenwood_williamson(spectral_moments(surface), effective_modulus, pressures);
}

} // namespace rough
