#include "apps/commands/design/run.hpp"
#include "apps/report/units.hpp"
#include "domain/contact/names.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace app {

namespace {

using rough::Quantity;

/// An interface stiffer than so many E* a millimetre is in full contact, but for rounding.
constexpr double nearly_rigid = 1e6;

std::string in_words(Quantity quantity) {
    switch (quantity) {
    case Quantity::stiffness:
        return "stiffness";
    case Quantity::interface_stiffness:
        return "interface stiffness";
    case Quantity::load_at_displacement:
        return "load";
    default:
        return "contact area";
    }
}

/// A number in as many digits, 4 at least, as show that it is below another.
std::string below(double value, double other) {
    int digits = 4;
    for (char text[40]; digits < 17; ++digits) {
        std::snprintf(text, sizeof text, "%.*g", digits, value);
        if (std::strtod(text, nullptr) < other)
            break;
    }
    return readable(value, digits);
}

void join(std::string& all, const std::string& more, const char* between = "; ") {
    if (!all.empty() && !more.empty())
        all += between;
    all += more;
}

bool asks_under(const DesignRun& run) { return run.setup.errors.any() || run.trust_options.hardness > 0; }

/// The worst similarity under all that was asked; -infinity where there was no answer under it.
double verified_under(const DesignRun& run) {
    const double own = run.found.best.lowest();
    if (!run.trust || std::none_of(run.trust->checks.begin(), run.trust->checks.end(),
                                   [](const rough::Check& check) { return check.decides; }))
        return own;
    return std::isnan(run.trust->under) ? -HUGE_VAL : std::min(own, run.trust->under);
}

/// A line in production compares like with like: the model, grid and load steps of its target.
double verified_of(const DesignRun& run) {
    return run.morphed ? run.found.best.similarity : verified_under(run);
}

bool is_verified(const DesignRun& run) { return !asks_under(run) || (run.trust && run.trust->all_decided); }

std::string conditions(const DesignRun& run) {
    std::string under = "on finer grids and in finer load steps";
    if (asks_under(run) && run.trust) {
        if (run.setup.errors.noise > 0)
            under += ", under noise";
        if (run.setup.errors.tilt > 0)
            under += ", tilted";
        if (run.trust_options.hardness > 0)
            under += ", under the hardness";
    }
    return under;
}

std::string verdict_of(const DesignRun& run, double verified) {
    std::string line;
    const double own = run.found.best.similarity;
    if (!run.out_of_reach.empty())
        line = run.out_of_reach.front().verdict() + "; no similarity is above " + readable(run.bound, 4) +
               ", the nearest found has " +
               (std::isnan(verified) ? readable(own, 4) + " as designed" : readable(verified, 4));
    else if (std::isnan(verified))
        line = "not verified: similarity " + readable(own, 4) + " as designed, wanted is " +
               brief(run.setup.required_similarity, 15) + " at worst; " +
               (run.interrupted ? "it was stopped before finer grids and load steps"
                                : "there was no time for finer grids and load steps");
    else if (run.morphed)
        line = (verified >= run.setup.required_similarity
                    ? "brought back: similarity " + readable(verified, 5)
                    : "not brought back: similarity " + below(verified, run.setup.required_similarity)) +
               " after " + readable(run.morphed->before, 4) + " before, wanted is " +
               brief(run.setup.required_similarity, 15) + "; " + readable(run.found.best.lowest(), 4) +
               " at worst, " + conditions(run);
    else if (verified >= run.setup.required_similarity)
        line = is_verified(run)
                   ? "found: similarity " + readable(verified, 5) + " at worst, " + conditions(run)
                   : "not verified: similarity " + readable(verified, 5) + " at worst, " + conditions(run) +
                         ", but there was no time for the given noise, tilt or hardness";
    else
        line = "not found within the budget: the nearest curve found has similarity " +
               (std::isinf(verified) ? "none" : below(verified, run.setup.required_similarity)) +
               " at worst, " + conditions(run) + ", wanted is " + brief(run.setup.required_similarity, 15);
    if (!run.found.best.within_limits)
        line += "; no answer holds every limit";
    return line;
}

/// A target's largest misfit in all that an answer was verified by, relative to the target.
struct LargestMisfit {
    double misfit = 0;
    rough::Index point = 0; ///< of the target
};

LargestMisfit largest_misfit(const DesignRun& run, std::size_t t) {
    std::vector<std::vector<Eigen::VectorXd>> all{misfits_of(run.setup, run.own)};
    const auto& verified = run.found.best.verification.misfits;
    if (!run.morphed && run.found.best.is_verified())
        all.insert(all.end(), verified.begin(), verified.end());
    LargestMisfit largest;
    for (const auto& misfits : all)
        for (rough::Index k = 0; k < misfits[t].size(); ++k)
            if (std::abs(misfits[t][k]) > std::abs(largest.misfit) * run.setup.targets[t].weight)
                largest = {misfits[t][k] / run.setup.targets[t].weight, k};
    return largest;
}

std::string matched(const DesignRun& run) {
    std::string all;
    for (std::size_t t = 0; t < run.setup.targets.size(); ++t) {
        const rough::Target& target = run.setup.targets[t];
        const double off = std::abs(largest_misfit(run, t).misfit);
        std::string words =
            in_words(target.quantity) + ": similarity " + readable(1 - target.weight * off, 4);
        words += target.has_band()
                     ? (off == 0 ? ", within the band" : ", outside the band by up to " + percent(off))
                     : ", off by up to " + percent(off);
        join(all, words + (run.morphed || !run.found.best.is_verified() ? " as designed" : " at worst"));
    }
    return all;
}

std::string worst_case(const DesignRun& run) {
    const rough::Answer& best = run.found.best;
    const auto known = [](double similarity) {
        return std::isnan(similarity) ? "not verified" : readable(similarity, 4);
    };
    std::string all =
        known(best.similarity) + " as designed, " + known(best.similarity_refined) +
        " on a grid 4 times finer, " + known(best.similarity_stepped) + " in 4 times the load steps, " +
        (best.is_verified()
             ? known(best.similarity_worst) + " at worst (the least of these and of both together)"
             : "so the worst is not known");
    if (!run.trust)
        return all + "; there was no time to verify more";
    for (const rough::Check& check : run.trust->checks)
        if (check.name.find("datum") != std::string::npos)
            join(all, readable(check.similarity, 4) + " with the datum 4 times farther");
        else if (check.name.find("noise") != std::string::npos ||
                 check.name.find("tilt") != std::string::npos)
            join(all, readable(check.similarity, 4) + " under " + check.name);
    if (!run.trust->left_out.empty())
        join(all, "no time was left for " + std::to_string(run.trust->left_out.size()) + " checks");
    return all;
}

/// How precise the machine must be: "for 0.95, 0.3 nm rms at 14 µm correlation, 40 nm tilt, 8 % scale".
std::string machine(const DesignRun& run) {
    if (!run.tolerance)
        return "";
    const rough::Tolerance& tolerance = *run.tolerance;
    const auto in_unit = [](double length) {
        const Unit unit = length_unit(length);
        return readable(unit.factor * length) + " " + unit.name;
    };
    std::string all, missed;
    for (const rough::ToleranceLevel& level : tolerance.levels) {
        const std::string at = brief(level.similarity, 15);
        if (level.similarity > tolerance.similarity)
            join(missed, at, ", ");
        else if (!std::isnan(level.scale) && (all.empty() || level.similarity == 0.95))
            all = "for " + at + ", " +
                  (std::isnan(level.noise_rms) ? "noise not known for lack of time"
                                               : in_unit(level.noise_rms) + " rms at " +
                                                     in_unit(tolerance.noise_length) + " correlation") +
                  ", " + in_unit(level.tilt) + " tilt, " + percent(level.scale) + " scale";
    }
    if (!missed.empty())
        join(all, "none for " + missed + ": without errors the similarity is " +
                      readable(tolerance.similarity, 4));
    if (!tolerance.complete)
        join(all, "not all is known for lack of time; set more --seconds");
    return all;
}

std::string yielding(const DesignRun& run) {
    if (!run.trust)
        return "not verified: there was no time";
    const Unit unit = pressure_unit(run.trust->peak_pressure);
    const double hardness = run.trust_options.hardness, peak = run.trust->peak_pressure;
    const std::string highest = "highest node pressure " + readable(unit.factor * peak) + " " + unit.name +
                                ", " + percent(peak / run.setup.model.body.effective_modulus) + " of E*";
    if (hardness <= 0)
        return "taken as elastic; " + highest + " (--hardness verifies it)";
    if (peak <= hardness)
        return "elastic: " + highest + ", within the hardness";
    std::string all = "yields: " + highest + ", above the hardness";
    for (const rough::Check& check : run.trust->checks)
        if (check.name.find("hardness") != std::string::npos)
            join(all, "similarity " + readable(check.similarity, 4) + " with " + check.name);
    return all;
}

/// "shortest wave 0.0146 mm (limit 0.0133 mm)"
std::string in_words(const rough::Margin& margin) {
    const bool in_mm = margin.name.ends_with("_mm");
    const std::string unit = in_mm ? " mm" : "";
    std::string name = margin.name.substr(0, margin.name.size() - (in_mm ? 3 : 0));
    std::replace(name.begin(), name.end(), '_', ' ');
    return name + " " + readable(margin.value) + unit +
           (margin.limit > 0
                ? (margin.holds() ? " (limit " : " (beyond the limit ") + readable(margin.limit) + unit + ")"
                : "");
}

/// Whether the limits that were given hold. Without any, nobody knows what can be made.
std::string making(const DesignRun& run) {
    std::string limited, free;
    for (rough::Margin margin : run.margins) {
        if (!run.limits_given)
            margin.limit = 0; // the default shortest wave is the grid's
        join(margin.limit > 0 ? limited : free, in_words(margin), ", ");
    }
    if (!run.limits_given)
        return "not known, as no limit was given: " + free +
               "; give your process's --max-slope, --min-radius, --max-height or --shortest-wave";
    return (run.found.best.within_limits ? "yes, by the given limits: " : "no: ") + limited +
           (free.empty() ? "" : "; without a limit: " + free);
}

std::string carries(const DesignRun& run) {
    const rough::Model& model = run.setup.model;
    const std::string body = std::string(name_of(model.body.kernel)) + " body, length " +
                             brief(model.grid.length, 5) +
                             (model.grid.is_2d() ? " x " + brief(model.grid.width, 5) : "") + " mm";
    const bool has_datum = model.body.kernel == rough::Kernel::free && !model.grid.is_2d();
    std::string all;
    for (const rough::Target& target : run.setup.targets) {
        const Quantity quantity = target.quantity;
        const std::string name = in_words(quantity);
        std::string own;
        if (quantity == Quantity::interface_stiffness)
            own = name + (model.grid.is_2d() ? ": over lengths weakly, at light loads"
                                             : ": over any datum, and over lengths weakly, at light loads");
        else if (model.grid.is_2d())
            own = name + ": for this length alone, with no datum to choose";
        else if (quantity == Quantity::area_at_pressure)
            own = name + ": over any datum, for this length alone";
        else if (!has_datum)
            own = name + ": for this length alone";
        else
            own = name + ": for this length and datum alone, " + brief(model.body.datum, 5) + " mm" +
                  (quantity == Quantity::stiffness ? " (interface_stiffness carries over)" : "");
        if (all.find(own) == std::string::npos)
            join(all, own);
    }
    return all + "; " + body;
}

/// How far the phases were moved, and what that did.
std::string moved(const rough::Morphed& morphed) {
    std::string all =
        "similarity " + readable(morphed.before, 4) + " before, " + readable(morphed.after, 4) + " after";
    for (const rough::PhaseChange& change : morphed.changes)
        join(all, std::to_string(change.place.series + 1) + ":" + std::to_string(change.n) + " by " +
                      readable(change.after - change.before) + " rad" +
                      (change.at_limit ? " (as far as it may)" : ""));
    return all;
}

/// What the controlled phases could not bring back.
std::string left_off(const DesignRun& run) {
    const auto& off = run.morphed->off;
    if (off.empty())
        return "";
    const auto worst = std::max_element(off.begin(), off.end(), [](const auto& a, const auto& b) {
        return std::abs(a.misfit) < std::abs(b.misfit);
    });
    const rough::Target& target = run.setup.targets[worst->target];
    const Unit unit = target.against_pressure() ? pressure_unit(target.last()) : length_unit(target.last());
    return "out of reach of these chromosomes within the largest change: " + std::to_string(off.size()) +
           " points, the worst off by " + percent(worst->misfit / target.weight) + " at " +
           readable(unit.factor * worst->x) + " " + unit.name;
}

/// Limits that the answer comes within 5 % of: "slope 0.0495 (limit 0.0500) is at its limit".
std::string binding_limits(const DesignRun& run) {
    std::string all;
    for (const rough::Margin& margin : run.margins)
        if (margin.limit > 0 && margin.margin() < 0.05)
            join(all, in_words(margin) + " is at its limit");
    return all;
}

/// Reasons why no answer was found: the largest misfit, then its possible causes.
std::string in_the_way(const DesignRun& run) {
    std::string all;
    std::size_t worst = 0;
    const auto weighted = [&](std::size_t t) {
        return run.setup.targets[t].weight * std::abs(largest_misfit(run, t).misfit);
    };
    for (std::size_t t = 1; t < run.setup.targets.size(); ++t)
        if (weighted(t) > weighted(worst))
            worst = t;
    const rough::Target& target = run.setup.targets[worst];
    const LargestMisfit largest = largest_misfit(run, worst);
    const Unit unit = target.against_pressure() ? pressure_unit(target.last()) : length_unit(target.last());
    if (run.morphed)
        return left_off(run);
    if (weighted(worst) > 1 - run.setup.required_similarity)
        join(all, "the largest misfit is " + percent(largest.misfit) + " of the " +
                      in_words(target.quantity) + " at " + readable(unit.factor * target.x[largest.point]) +
                      " " + unit.name);
    if (run.bound < run.setup.required_similarity)
        join(all, "no profile " +
                      std::string(run.out_of_reach.empty() || run.out_of_reach.front().on_this_grid
                                      ? "on this grid "
                                      : "") +
                      "has a similarity above " + readable(run.bound, 4));
    const double nodes = static_cast<double>(run.setup.model.grid.shape().nodes()),
                 wanted = target.y[largest.point] * nodes;
    if (is_contact_fraction(target.quantity) && 0.5 / wanted > 1 - run.setup.required_similarity)
        join(all, "the area asked for there is " + readable(wanted) + " of " + brief(nodes, 9) +
                      " nodes, of which half a one is " + percent(0.5 / wanted) +
                      ": more --nodes resolve it");
    join(all, binding_limits(run));
    if (!run.found.best.is_verified() && !run.interrupted)
        join(all, "there was no time to verify the answer: expected more --seconds, or fewer --nodes");
    if (!run.found.stopped.empty())
        join(all, "the search was ended early: " + run.found.stopped);
    else if (run.out_of_reach.empty())
        join(all, "the search ended by itself: another --seed, or --seconds for more");
    return all;
}

} // namespace

std::vector<std::pair<std::string, double>> off_unasked(const DesignRun& run) {
    std::vector<std::pair<std::string, double>> all;
    const auto& asked = run.setup.targets;
    if (!run.setup.like || !asked.front().against_pressure())
        return all;
    rough::DesignSetup setup = run.setup;
    setup.targets.clear();
    for (const Quantity quantity :
         {Quantity::stiffness, Quantity::area_at_pressure, Quantity::interface_stiffness}) {
        if (std::any_of(asked.begin(), asked.end(),
                        [&](const rough::Target& target) { return target.quantity == quantity; }))
            continue;
        rough::Target target = asked.front();
        target.quantity = quantity;
        target.lower = target.upper = {}; // of what was asked
        setup.targets.push_back(std::move(target));
    }
    setup = rough::in_finer_steps(std::move(setup), 1); // values of the scan's own curve
    const std::vector<double> each = similarities(setup, respond(setup, run.found.best.genome, setup.model));
    for (std::size_t t = 0; t < each.size(); ++t)
        if (setup.targets[t].y.maxCoeff() < nearly_rigid * run.setup.model.body.effective_modulus)
            all.emplace_back(in_words(setup.targets[t].quantity), 1 - each[t]);
    return all;
}

bool is_found(const DesignRun& run) {
    return verified_of(run) >= run.setup.required_similarity && is_verified(run) &&
           run.out_of_reach.empty() && run.found.best.within_limits;
}

Summary summary_of(const DesignRun& run) {
    Summary summary;
    summary.verified = verified_of(run);
    summary.found = is_found(run);
    summary.verdict = verdict_of(run, summary.verified);
    const auto add = [&](const char* key, const char* name, const std::string& text) {
        if (!text.empty())
            summary.facts.push_back({key, name, text});
    };
    if (run.morphed)
        add("moved", "Moved", moved(*run.morphed));
    add("matched", "Matched", matched(run));
    std::string off = run.not_asked ? "" : "not verified: there was no time";
    for (const auto& [name, share] : run.not_asked.value_or(std::vector<std::pair<std::string, double>>()))
        join(off, name + " was not asked for and is off by up to " + percent(share));
    if (!run.setup.like)
        off = "everything but the target's quantities; at the last load " +
              percent(run.own.responses.front().contact_fraction.tail(1)[0]) + " of the nodes touch";
    add("not_asked_for", "Not asked for", off);
    add("worst_case", "At worst", worst_case(run));
    add("machine", "Machine", machine(run));
    add("yielding", "Elastic", yielding(run));
    add("making", "Can be made", making(run));
    add("carries_over", "Holds for", carries(run));
    if (!summary.found)
        add("in_the_way", "In the way", in_the_way(run));
    return summary;
}

nlohmann::json summary_json(const DesignRun& run) {
    const Summary& summary = run.summary;
    nlohmann::json result{{"found", summary.found}, {"not_asked", nlohmann::json::object()}};
    result["lowest"] = std::isfinite(summary.verified) ? nlohmann::json(summary.verified) : nlohmann::json();
    for (const auto& [name, share] : run.not_asked.value_or(std::vector<std::pair<std::string, double>>()))
        result["not_asked"][name] = share;
    for (const Fact& fact : summary.facts)
        result[fact.key] = fact.text;
    return result;
}

} // namespace app
