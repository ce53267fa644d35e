#include "domain/accuracy/load_rows.hpp"

#include "domain/accuracy/error_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace rough {

namespace {

/// Rows of the first pass: fewer would not describe the curve, and rows are cheap next to the factor.
constexpr std::size_t first_rows = 64;

class Rows {
  public:
    Rows(const Profile& profile, const Body& body, const std::vector<double>& displacements,
         const ContactOptions& options)
        : profile_(profile), body_(body), options_(options), displacements_(displacements),
          known_(displacements.size(), 0), least_fraction_(1 / static_cast<double>(profile.nodes())) {
        rows_.steps.resize(displacements.size());
        for (std::size_t j = 0; j < displacements.size(); ++j)
            if (displacements[j] <= 0)
                known_[j] = 1;
    }

    void solve(const std::vector<std::size_t>& which) {
        std::vector<std::size_t> open;
        std::vector<double> at;
        for (const std::size_t j : which)
            if (!known_[j]) {
                open.push_back(j);
                at.push_back(displacements_[j]);
            }
        if (open.empty())
            return;
        const ContactCurve curve = solve_contact(profile_, body_, at, options_);
        for (std::size_t k = 0; k < open.size(); ++k) {
            rows_.steps[open[k]] = curve.steps[k];
            known_[open[k]] = 1;
        }
        rows_.solved += static_cast<int>(open.size());
        rows_.solver = curve.solver;
        if (open.back() + 1 == displacements_.size())
            rows_.last_contact = curve.last_contact;
    }

    /// Reads the rows between solved ones; returns the rows to solve next, none if `accuracy` is met.
    std::vector<std::size_t> read_between(double accuracy) {
        std::vector<std::size_t> next;
        LoadStep start; // nothing touches at displacement 0
        std::size_t a = 0;
        bool from_origin = true;
        rows_.error = rows_.area_error = 0;
        for (std::size_t b = 0; b < known_.size(); ++b) {
            if (!known_[b])
                continue;
            const std::size_t first = from_origin ? 0 : a + 1;
            const double worst = first < b ? read_gap(first, b, start) : 0;
            rows_.error = std::max(rows_.error, worst);
            if (worst > accuracy) {
                // The bound of a secant falls as the distance of the solved rows.
                const auto pieces = static_cast<std::size_t>(
                    std::min(std::ceil(worst / accuracy) + 1, static_cast<double>(b - first + 1)));
                for (std::size_t piece = 1; piece < pieces; ++piece)
                    next.push_back(first + (b - first) * piece / pieces);
            }
            start = rows_.steps[b];
            a = b;
            from_origin = false;
        }
        next.erase(std::unique(next.begin(), next.end()), next.end());
        return next;
    }

    LoadRows take() { return std::move(rows_); }

  private:
    struct Reading {
        double off,
            least; ///< how far off the exact pressure a row may be, and the least that this may be, MPa
    };

    /// Reads row j between two solved ones.
    Reading read(std::size_t j, const LoadStep& a, const LoadStep& b) {
        const double x = displacements_[j], h = b.displacement - a.displacement;
        const double t = (x - a.displacement) / h;
        const double chord = a.pressure + t * (b.pressure - a.pressure);
        const double tangents = std::max({a.pressure + a.tangent_stiffness * (x - a.displacement),
                                          b.pressure - b.tangent_stiffness * (b.displacement - x), 0.0});
        const double cubic = (1 + 2 * t) * (1 - t) * (1 - t) * a.pressure + t * t * (3 - 2 * t) * b.pressure +
                             h * t * (1 - t) * ((1 - t) * a.tangent_stiffness - t * b.tangent_stiffness);
        LoadStep& step = rows_.steps[j];
        step.displacement = x;
        step.pressure = std::clamp(cubic, std::min(tangents, chord), chord);
        step.tangent_stiffness = (1 - t) * a.tangent_stiffness + t * b.tangent_stiffness;
        step.contact_fraction = (1 - t) * a.contact_fraction + t * b.contact_fraction;
        const double area_off = std::max(t, 1 - t) * (b.contact_fraction - a.contact_fraction);
        rows_.area_error =
            std::max(rows_.area_error, area_off / std::max(a.contact_fraction, least_fraction_));
        step.kkt_residual = std::max(a.kkt_residual, b.kkt_residual);
        return {std::max(chord - step.pressure, step.pressure - tangents), std::min(tangents, chord)};
    }

    /// Reads rows first..b-1 between the solved a and b; returns the bound of the relative error of theirs
    /// and b's pressures and secants.
    double read_gap(std::size_t first, std::size_t b, const LoadStep& start) {
        const LoadStep end = rows_.steps[b];
        const auto over = [](double off, double exact) { return off > 0 ? off / exact : 0; };
        // A convex cubic's secants lie between the two tangents, as the exact ones do.
        const double rise = 3 * (end.pressure - start.pressure) / (end.displacement - start.displacement);
        const bool convex = 2 * start.tangent_stiffness + end.tangent_stiffness <= rise &&
                            rise <= start.tangent_stiffness + 2 * end.tangent_stiffness;
        double worst = 0, last_off = 0, last = start.displacement;
        for (std::size_t j = first; j <= b; ++j) {
            const auto [off, pressure] = j < b ? read(j, start, end) : Reading{0, 1};
            const LoadStep& step = rows_.steps[j];
            const double length = step.displacement - last;
            const double least = length * start.tangent_stiffness;
            double secant_off = off + last_off;
            if (convex)
                secant_off = std::min(secant_off, length * end.tangent_stiffness - least);
            worst = std::max({worst, over(off, pressure), over(secant_off, least)});
            last_off = off;
            last = step.displacement;
        }
        return worst;
    }

    const Profile& profile_;
    const Body& body_;
    const ContactOptions& options_;
    const std::vector<double>& displacements_;
    std::vector<char> known_;
    double least_fraction_; ///< of one node
    LoadRows rows_;
};

} // namespace

LoadRows solve_rows(const Profile& profile, const Body& body, const std::vector<double>& displacements,
                    const ContactOptions& options, double accuracy) {
    Rows rows(profile, body, displacements, options);
    const std::size_t count = displacements.size();
    const std::size_t apart = accuracy > 0 ? std::max<std::size_t>(1, count / first_rows) : 1;
    std::vector<std::size_t> next;
    for (std::size_t j = count; j > 0; j -= std::min(j, apart))
        next.push_back(j - 1);
    std::reverse(next.begin(), next.end());
    while (!next.empty()) {
        rows.solve(next);
        next = rows.read_between(accuracy);
    }
    return rows.take();
}

} // namespace rough
