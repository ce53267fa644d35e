#include "apps/experiments/paper/claims.hpp"
#include "apps/experiments/paper/lookup.hpp"
#include "apps/report/units.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/target/similarity.hpp"
#include "ga/base/random.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

Verdict decided(bool holds) { return holds ? Verdict::reproduced : Verdict::contradicted; }

Claim one_wave(const Studies& studies) {
    double misfit = 0;
    for (const ChromosomeExample& example : studies.chromosomes)
        misfit = std::max(misfit, example.misfit);
    const double second = 1e3 * studies.chromosomes.back().wave_length;
    return {"Figure 1", "The sum of a chromosome's ridges keeps the wave length; λ<sub>2</sub> = 66.6 µm.",
            "Eight ridges differ from one cosine of that length by at most " + readable(misfit, 2) +
                " of its range; λ<sub>2</sub> = " + readable(second, 4) + " µm.",
            "Misfit under 10<sup>−12</sup> and λ<sub>2</sub> within 0.1 µm of 66.6.",
            decided(misfit < 1e-12 && std::abs(second - 66.6) < 0.1)};
}

Claim condition(const Studies& studies) {
    const auto printed = rough::column(studies.ridges, &RidgeCount::as_printed);
    const auto slipped = rough::column(studies.ridges, &RidgeCount::last_missing);
    const auto [least, most] = std::minmax_element(slipped.begin(), slipped.end());
    const double lowest = *std::min_element(printed.begin(), printed.end());
    return {"Figure 2", "Condition (10) holds for 88.5–98 % of random phases, about 95 % on average.",
            "As printed it holds for " + percent(rough::mean(printed)) +
                " (it is an identity). With the last pair missing from "
                "g<sub>3</sub>: " +
                percent(*least) + " to " + percent(*most) + ", " + percent(rough::mean(slipped)) +
                " on average.",
            "The printed formula's shares within 88.5–98 % for every M from 2 to 1,024.",
            decided(lowest >= 0.885 && *std::max_element(printed.begin(), printed.end()) <= 0.98)};
}

Claim arccos(const Studies& studies) {
    const double share = rough::mean(rough::column(studies.ridges, &RidgeCount::right_phase));
    return {"Eq. 8", "The phase of the sum is arccos(g<sub>1</sub>/R).",
            "Right for " + percent(share) + " of random phase sets: arccos loses the sign of g<sub>2</sub>.",
            "Right for more than 99 % of them.", decided(share > 0.99)};
}

Claim part_suffices(const Studies& studies) {
    const auto& rows = studies.readings.same_pressure;
    const double kept = rough::mean(rough::column(rows, &Reduction::kept));
    const double s = rough::median(rough::column(rows, &Reduction::similarity));
    return {"Sections 1, 2.3", "K(p) needs only part of the chromosomes.",
            "Algorithm 1 keeps " + percent(kept, 2) +
                " of a database genome's chromosomes in the mean; the reduced "
                "profile's K(p) has a median similarity of " +
                readable(s) + " with the whole's.",
            "Median similarity of at least 0.9 with fewer than all chromosomes; contradicted under 0.5.",
            s >= 0.9 && kept < 1 ? Verdict::reproduced
            : s < 0.5            ? Verdict::contradicted
                                 : Verdict::undecidable};
}

/// Which half of the waves a curve owes more to.
Claim governed(const Studies& studies, bool stiffness) {
    const auto change = [&](const std::vector<Removal>& rows) {
        return rough::median(rough::column(rows, stiffness ? &Removal::stiffness : &Removal::area));
    };
    const double coarse = change(studies.readings.without_coarse),
                 fine = change(studies.readings.without_fine);
    return {"Sections 1, 2.3", stiffness ? "Coarse waves govern K." : "Fine waves govern A.",
            std::string(stiffness ? "K" : "A") + " at equal pressures changes by " + percent(coarse, 2) +
                " (median) without the longer half of the waves, by " + percent(fine, 2) +
                " without the shorter half." +
                (stiffness ? "" : " Fine waves do matter to A far more than to K."),
            std::string("The change without the ") + (stiffness ? "longer" : "shorter") +
                " half is the greater one.",
            decided(stiffness ? coarse > fine : fine > coarse)};
}

/// A miss on other profiles than the alloy's says nothing of the alloy.
Verdict decided_on_a_stand_in(bool holds) { return holds ? Verdict::reproduced : Verdict::undecidable; }

std::string range_of(const std::vector<double>& values, double factor, int digits) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return readable(factor * *least, digits) + "–" + readable(factor * *most, digits);
}

Claim alloy_stiffness(const Studies& studies) {
    const auto s = rough::column(studies.fractals, [](const FractalStudy& study) {
        return similarity(secant_stiffness(study.whole_response), secant_stiffness(study.reduced_response));
    });
    return {"Figure 3", "K(p) of the alloy's profile and of its dominant chromosomes overlap significantly.",
            "On " + std::to_string(s.size()) + " fractal profiles: similarity " + readable(rough::median(s)) +
                " in the median (" + range_of(s, 1, 2) + ").",
            "A median similarity of at least 0.9 reproduces it; the alloy's profile is not public.",
            decided_on_a_stand_in(rough::median(s) >= 0.9)};
}

Claim alloy_area(const Studies& studies) {
    const auto apart = rough::column(studies.fractals, [](const FractalStudy& study) {
        return relative_gap(area_against_pressure(study.whole_response),
                            area_against_pressure(study.reduced_response));
    });
    return {"Figure 3", "So do their A(p).",
            "On the same profiles the dominant bands' A is off by " + percent(rough::median(apart), 2) +
                " in the median (" + range_of(apart, 100, 2) + " %).",
            "At most 10 % reproduces it.", decided_on_a_stand_in(rough::median(apart) <= 0.1)};
}

/// Figure 4, of one part of the pressures.
Claim part(const PaperRun& run, bool low) {
    std::string measured;
    std::vector<std::optional<bool>> holds;
    for (const TargetRun& target : run.targets)
        if (const auto best = best_in_part(target, low)) {
            const double s = low ? best->scores.low : best->scores.high;
            measured += (measured.empty() ? "" : "; ") + target.title + ": " + readable(best->scores.all) +
                        " overall and " + readable(s) + (low ? " below" : " above");
            holds.push_back(best->scores.all <= 0.95 && s > 0.95);
        }
    return {"Figure 4",
            low ? "A curve with s = 0.89 over all p reaches 0.97 below p̄."
                : "A curve with s = 0.88 over all p reaches 0.99 above p̄.",
            measured + ".",
            "A genome with s ≤ 0.95 over all p and above 0.95 in this part exists for both targets; "
            "contradicted if "
            "for neither.",
            verdict_over(holds)};
}

/// Warnock's formula for the L2 star discrepancy of points of the unit square: 0 would be perfectly even.
double discrepancy(const std::vector<std::pair<double, double>>& points) {
    const double n = static_cast<double>(points.size());
    double single = 0, pairs = 0;
    for (const auto& [x, y] : points) {
        single += (1 - x * x) * (1 - y * y);
        for (const auto& [u, v] : points)
            pairs += (1 - std::max(x, u)) * (1 - std::max(y, v));
    }
    return std::sqrt(1.0 / 9 - single / (2 * n) + pairs / (n * n));
}

Claim even_pairs(const PaperRun& run) {
    auto pairs = rough::sobol_pairs(run.layout);
    for (auto& [H, gamma] : pairs) {
        H = (H - run.layout.H_from) / (run.layout.H_to - run.layout.H_from);
        gamma = (gamma - run.layout.gamma_from) / (run.layout.gamma_to - run.layout.gamma_from);
    }
    const double sobol = discrepancy(pairs);
    ga::Stream random(ga::fold(run.origin.seed, "pairs"));
    constexpr int draws = 1000;
    int above = 0;
    for (int draw = 0; draw < draws; ++draw) {
        for (auto& [H, gamma] : pairs)
            H = random.uniform(), gamma = random.uniform();
        above += discrepancy(pairs) > sobol;
    }
    return {"Figure 5", "The Sobol pairs (H, γ) cover the rectangle evenly.",
            "L<sub>2</sub> star discrepancy " + readable(sobol, 2) + ", lower than that of " +
                percent(static_cast<double>(above) / draws) + " of random sets as large.",
            "Lower than that of 95 % of 1,000 random sets.", decided(above >= 0.95 * draws)};
}

Claim trend(const PaperRun& run) {
    std::string measured;
    for (const TargetRun& target : run.targets) {
        int inside = 0;
        const rough::Index points = target.target.points();
        for (rough::Index k = 0; k < points; ++k) {
            double least = INFINITY, most = -INFINITY;
            for (const Answered& member : run.database) {
                const double y = secant_stiffness(member.response).at(target.target.x[k]);
                least = std::min(least, y);
                most = std::max(most, y);
            }
            inside += target.target.y[k] >= least && target.target.y[k] <= most;
        }
        measured += target.title + ": " + std::to_string(inside) + " of " + std::to_string(points) +
                    " points lie among the database's curves. ";
    }
    return {"Figure 6", "The target's trend is like that of the 100 genomes' K(p).", measured,
            "Undecidable: the paper's target is drawn by hand and not published; ours is drawn after the "
            "database.",
            Verdict::undecidable};
}

Claim pressures(const PaperRun& run) {
    const auto own = rough::column(run.database, [&](const Answered& member) {
        return run.max_pressure / std::abs(member.genome.scale);
    });
    const auto [least, most] = std::minmax_element(own.begin(), own.end());
    return {"Section 4.1", "p<sub>max</sub> is larger than every genome's own highest pressure.",
            "With A = 1 in mm the genomes' own are " + readable(*least, 2) + " to " + readable(*most, 2) +
                " MPa, p<sub>max</sub> is " + readable(run.max_pressure, 2) +
                " MPa. Scores do not depend on it.",
            "p<sub>max</sub> above the largest of them.", decided(run.max_pressure > *most)};
}

Claim threshold_units() {
    return {"Section 4", "p̄ = 0.08 1/mm, and 0.5–1.1 × 10<sup>−4</sup> N/m.",
            "The units agree neither with each other nor with p<sub>max</sub>; here p̄ is a share of "
            "p<sub>max</sub>, "
            "0.5, swept over 0.31–0.69.",
            "Undecidable: the text does not allow a conversion.", Verdict::undecidable};
}

} // namespace

std::vector<Claim> formula_claims(const Studies& studies) {
    return {one_wave(studies), condition(studies), arccos(studies)};
}

std::vector<Claim> part_claims(const Studies& studies) {
    return {part_suffices(studies), governed(studies, true), governed(studies, false),
            alloy_stiffness(studies), alloy_area(studies)};
}

std::vector<Claim> database_claims(const PaperRun& run) {
    return {part(run, true), part(run, false), even_pairs(run),
            trend(run),      pressures(run),   threshold_units()};
}

std::vector<Claim> series_claims(const PaperRun& run, const Studies& studies) {
    std::vector<Claim> claims;
    for (const auto& part : {formula_claims(studies), part_claims(studies), database_claims(run)})
        claims.insert(claims.end(), part.begin(), part.end());
    return claims;
}

} // namespace app
