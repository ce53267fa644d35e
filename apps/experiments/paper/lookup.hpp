#pragma once

#include "apps/experiments/paper/run.hpp"
#include "apps/report/plot.hpp"
#include "domain/response/curve.hpp"

#include <array>
#include <optional>

/// What figures and claims alike look up in a run.
namespace app {

/// One of the paper's algorithms.
struct Algorithm {
    const char *name, *title; ///< in the run, on the page
    Colour colour;
    Dash dash;
};
inline constexpr std::array<Algorithm, 3> algorithms{{{"sog", "SOG", Colour::blue, Dash::solid},
                                                      {"gco", "GCO", Colour::red, Dash::dashed},
                                                      {"cco", "CCO", Colour::green, Dash::dotted}}};

/// The variant of that name, or null.
const VariantRun* find_variant(const TargetRun& target, const std::string& name);

/// An answer as figures show it.
struct ShownAnswer {
    const VariantRun* variant;
    std::string title;
    Colour colour;
    Dash dash;
};

/// The answers of the paper's algorithms, then those of the experiment's own variants.
std::vector<ShownAnswer> shown_answers(const TargetRun& target);

/// "sog-minimax" as "SOG, minimax"; an experiment's own variant by its own name.
std::string shown_name(const std::string& name);

/// "Drawn target"
std::string titled(const TargetRun& target);

/// One candidate's similarity at GCMMA (0), (1) and (2).
struct Refinement {
    std::uint64_t id;
    std::array<double, 3> similarity;
};

/// The candidates that went into the first "refine" of a variant, best first, and what became of them. (2)
/// copies (1) where there was one refinement only (CCO). Empty if the variant has none.
std::vector<Refinement> refinements(const VariantRun& variant);

/// The rows of one variant, p_bar ascending.
std::vector<ThresholdRow> thresholds_of(const TargetRun& target, const std::string& variant);

/// A database genome that meets one part of the target better than the whole.
struct Part {
    std::size_t genome;
    Scores scores;
};

/// Figure 4: among genomes whose similarity over all pressures is at most 0.95, the one that is best over the
/// low (or high) pressures; the best of all where every one is above.
std::optional<Part> best_in_part(const TargetRun& target, bool low);

/// (x, y) of a curve with the numbers as they are shown.
Series shown(const rough::Curve& curve, double x_factor, Series look);

/// Mean relative difference |b - a|/a at the points of `a` that both can be read at; NaN if there is none, or
/// a is 0.
double relative_gap(const rough::Curve& a, const rough::Curve& b);

/// Largest difference |b - a| at the points of `a` that both can be read at; NaN if there is none.
double gap(const rough::Curve& a, const rough::Curve& b);

} // namespace app
