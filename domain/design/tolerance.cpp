#include "domain/design/tolerance.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/statistics.hpp"
#include "ga/base/budget.hpp"
#include "ga/base/parallel.hpp"

#include <set>
#include <span>

namespace rough {
namespace {

constexpr int min_draws = 40, max_draws = 1000, min_draws_in_time = 5;
constexpr int few_draws = 20;                       ///< minimum to bracket a noise
constexpr double line_nodes = 4096, map_nodes = 64; ///< largest grids that get max_draws
constexpr double precision = 1.015; ///< ratio of the smallest size found to fail to the largest found to hold
constexpr double max_scale = 0.99, max_tilt = 16; ///< relative to all heights, to the height range
constexpr double smallest = 0x1p-40;              ///< smallest size that is tried, relative to the largest

/// How many of these draws may fail while a share of 0.95 keeps the similarity.
std::size_t may_lose(int draws) { return static_cast<std::size_t>((1 - Tolerance::share) * draws + 1e-9); }

int draws_for(const Grid& grid) {
    const double nodes = static_cast<double>(grid.shape().nodes()),
                 full = max_draws * (grid.is_2d() ? map_nodes : line_nodes);
    return static_cast<int>(std::clamp<double>(std::round(full / nodes), min_draws, max_draws));
}

/// Similarities of one design under errors. They throw ga::Stopped when the time is over.
class ErrorTrials {
  public:
    ErrorTrials(const DesignSetup& given, const Genome& genome, const ToleranceOptions& options)
        : options_(options), threads_(ga::thread_count(options.threads)),
          watch_({std::numeric_limits<long>::max(), options.seconds, options.stop}), setup_(given),
          made_(stopping(setup_), genome),
          range_(made_.surface().heights.maxCoeff() - made_.surface().heights.minCoeff()) {}
    ErrorTrials(const ErrorTrials&) = delete; // the surface refers to the clock

    const Eigen::VectorXd& heights() const { return made_.surface().heights; }
    double range() const { return range_; }
    int threads() const { return threads_; }
    double seconds_left() const { return options_.seconds - watch_.seconds(); }
    double similarity() const { return made_.similarity(Eigen::VectorXd::Zero(made_.surface().nodes())); }

    /// Similarities of the first draws of noise with this rms (mm), in rising order.
    std::vector<double> with_noise(double rms, int draws) {
        std::vector<double> similarities(static_cast<std::size_t>(draws));
        draws_.resize(std::max(draws_.size(), similarities.size()));
        each(similarities.size(), [&](std::size_t i) { similarities[i] = similarity_under(draws_[i], i, rms); });
        std::sort(similarities.begin(), similarities.end());
        return similarities;
    }
    /// Whether 95 % of the first draws keep a similarity. A draw that keeps it under more noise is not
    /// computed again, nor is one that fails under less noise.
    bool keep(double level, double rms, int draws) {
        draws_.resize(std::max(draws_.size(), static_cast<std::size_t>(draws)));
        std::vector<std::size_t> unknown;
        std::size_t lost = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(draws); ++i) {
            bool kept_above = false, lost_below = false;
            for (const auto& [size, similarity] : draws_[i].similarity) {
                lost_below = lost_below || (size <= rms && similarity < level);
                kept_above = kept_above || (size >= rms && similarity >= level);
            }
            lost += lost_below;
            if (!lost_below && !kept_above) unknown.push_back(i);
        }
        each(unknown.size(), [&](std::size_t i) { similarity_under(draws_[unknown[i]], unknown[i], rms); });
        for (const std::size_t i : unknown) lost += draws_[i].similarity.at(rms) < level;
        return lost <= may_lose(draws);
    }

    /// For each size of an error, the lowest similarity under these shapes (heights, mm) in either direction.
    std::vector<double> lowest(const std::vector<Eigen::VectorXd>& shapes, const std::vector<double>& sizes) const {
        const std::size_t cases = 2 * shapes.size();
        std::vector<double> all(sizes.size() * cases), result;
        each(all.size(), [&](std::size_t i) {
            all[i] = made_.similarity((i % 2 ? -1 : 1) * sizes[i / cases] * shapes[i % cases / 2]);
        });
        for (auto from = all.begin(); from != all.end(); from += static_cast<std::ptrdiff_t>(cases))
            result.push_back(*std::min_element(from, from + static_cast<std::ptrdiff_t>(cases)));
        return result;
    }

  private:
    /// One draw of noise with rms 1, and its similarity for each rms (mm) that was tried.
    struct Draw {
        Eigen::VectorXd heights = {};
        std::map<double, double> similarity = {};
    };

    DesignSetup stopping(DesignSetup setup) const {
        setup.model.contact.stop = [this, before = setup.model.contact] {
            return watch_.expired() || is_stopped(before);
        };
        return setup;
    }
    double similarity_under(Draw& draw, std::uint64_t number, double rms) const {
        if (draw.heights.size() == 0)
            draw.heights = height_noise(setup_.model.grid, setup_.errors.noise_length,
                                        ga::fold(ga::fold(options_.seed, "height noise"), number));
        return draw.similarity[rms] = made_.similarity(rms * draw.heights);
    }
    template <class Job>
    void each(std::size_t n, Job job) const {
        ga::parallel_for(n, threads_, [&](std::size_t i) {
            if (watch_.expired() || is_stopped(setup_.model.contact)) throw ga::Stopped{"time budget spent"};
            job(i);
        });
    }

    ToleranceOptions options_;
    int threads_;
    ga::Watch watch_;
    DesignSetup setup_;
    SurfaceWithErrors made_;
    double range_; ///< height range, mm
    std::vector<Draw> draws_;
};

using KeptBySize = std::map<double, double>; ///< the similarity under some sizes of an error, by size

/// Sizes up to `cap`, each `ratio` times the one before, from one that keeps `high` to one below `low`.
template <class KeptAt>
KeptBySize ladder(double cap, double ratio, double high, double low, KeptAt kept) {
    KeptBySize all{{cap / 1024, kept(cap / 1024)}};
    while (all.begin()->second < high && all.begin()->first > smallest * cap) {
        const double size = all.begin()->first / ratio;
        all[size] = kept(size);
    }
    while (all.rbegin()->second >= low && all.rbegin()->first < cap) {
        const double size = std::min(cap, ratio * all.rbegin()->first);
        all[size] = kept(size);
    }
    return all;
}

/// The largest size before the first below the level, or 0, and that first size; if none is, twice the last.
std::pair<double, double> bracket(const KeptBySize& all, double level) {
    const auto lost = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.second < level; });
    const double kept = lost == all.begin() ? 0 : std::prev(lost)->first;
    return {kept, lost == all.end() ? kept : lost->first};
}

/// Sets the largest tilts or scales up to which all keep a level. Octaves are divided into `parts`; then the
/// interval before the first size below the level is divided further.
void find_errors(const ErrorTrials& trials, const std::vector<Eigen::VectorXd>& shapes, double cap, int parts,
                 std::span<ToleranceLevel> levels, double ToleranceLevel::*error) {
    KeptBySize all = ladder(cap, 2, levels.front().similarity, levels.back().similarity,
                            [&](double size) { return trials.lowest(shapes, {size}).front(); });
    using Gaps = std::vector<std::pair<double, double>>;
    const auto probe_inside = [&](const Gaps& gaps, int into) {
        std::vector<double> sizes;
        for (const auto& [from, to] : gaps)
            for (int i = 1; i < into; ++i) sizes.push_back(from + (to - from) * i / into);
        const std::vector<double> similarities = trials.lowest(shapes, sizes);
        for (std::size_t i = 0; i < sizes.size(); ++i) all[sizes[i]] = similarities[i];
    };
    Gaps octaves;
    double last = 0;
    for (const auto& [size, similarity] : all) octaves.emplace_back(std::exchange(last, size), size);
    probe_inside(octaves, parts);
    for (ToleranceLevel& level : levels) {
        auto [from, to] = bracket(all, level.similarity);
        while (to > precision * from && to > smallest * cap) {
            probe_inside({{from, to}}, 4);
            std::tie(from, to) = bracket(all, level.similarity);
        }
        level.*error = from;
    }
}

/// The largest noise under which the draws keep the level, by bisection. It begins with few draws and repeats
/// with more, each time around the noise found before.
double largest_noise(ErrorTrials& trials, const KeptBySize& rough_steps, double level, int few, int draws) {
    auto [from, to] = bracket(rough_steps, level);
    if (from == 0 || from == to) return from;
    for (int n = few;; n = std::min(3 * n, draws)) {
        const double ratio = n < draws ? 1.1 : precision, margin = 1 + 1.5 / std::sqrt(n);
        if (n > few) to *= margin;
        while (to < trials.range() && trials.keep(level, to, n)) from = std::exchange(to, margin * to);
        while (from > smallest * trials.range() && !trials.keep(level, from, n))
            to = std::exchange(from, from / margin);
        while (to > ratio * from) {
            const double middle = (from + to) / 2;
            (trials.keep(level, middle, n) ? from : to) = middle;
        }
        if (n == draws) return from;
    }
}

/// Wilson's 95 % confidence interval of a share that was measured with this many draws.
std::pair<double, double> share_interval(double share, int draws) {
    const double z = 1.96, n = draws, centre = share + z * z / (2 * n),
                 half = z * std::sqrt(share * (1 - share) / n + z * z / (4 * n * n)), all = 1 + z * z / n;
    return {(centre - half) / all, (centre + half) / all};
}

/// The number of draws of noise, and the number of parts of each octave of tilts and scales.
struct Effort {
    int draws, parts;
    bool operator==(const Effort&) const = default;
};
/// The effort if there is time. Similarities to contact fractions jump when a node touches, so there are more
/// parts for such targets.
Effort full_effort(const DesignSetup& setup) {
    const Grid& grid = setup.model.grid;
    const bool jumps = std::ranges::any_of(setup.targets, is_contact_fraction, &Target::quantity);
    return {draws_for(grid), grid.is_2d() ? 2 : jumps ? 64 : 8};
}
/// The effort for a number of curves. There are two per tilt and scale in 7 octaves and for 18 finer sizes, 4
/// per draw, and 4 noises with few draws.
Effort effort_of(double curves, Effort full) {
    const int parts = static_cast<int>(std::clamp<double>(curves / 200, 1, full.parts));
    const double left = curves - 4 * (7 * parts + 18) - 4 * few_draws;
    return {static_cast<int>(std::clamp<double>(left / 4, min_draws_in_time, full.draws)), parts};
}

/// The effort in the time that is left, of which 0.7 is planned by the time of some curves.
Effort effort_in_time(ErrorTrials& trials, Effort full) {
    const ga::Stopwatch clock;
    trials.lowest({trials.heights()}, std::vector(static_cast<std::size_t>(trials.threads()), 1e-6)); // 2 each
    return effort_of(1.4 * trials.seconds_left() * trials.threads() / clock.seconds(), full);
}

} // namespace

Tolerance tolerance_of(const DesignSetup& setup, const Genome& genome, const ToleranceOptions& options) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    ErrorTrials trials(setup, genome, options);
    Tolerance result;
    result.noise_length = setup.errors.noise_length;
    result.similarity = unknown;
    for (const double level : std::set<double, std::greater<>>{0.99, 0.95, 0.9, setup.required_similarity})
        result.levels.push_back({level, unknown, unknown, unknown});
    try {
        result.similarity = trials.similarity();
        const Effort full = full_effort(setup);
        const Effort priced = options.draws ? Effort{*options.draws, full.parts} : effort_of(options.price, full);
        const bool in_time = !options.fixed_draws && !options.draws && !std::isinf(options.seconds);
        const auto [draws, parts] = in_time ? effort_in_time(trials, priced) : priced;
        result.shortened = Effort{draws, parts} != priced;
        result.draws = draws;
        std::tie(result.share_from, result.share_to) = share_interval(Tolerance::share, draws);
        const auto first = std::ranges::find_if(
            result.levels, [&](const ToleranceLevel& level) { return level.similarity <= result.similarity; });
        for (ToleranceLevel& level : std::span(result.levels.begin(), first))
            level.noise_rms = level.tilt = level.scale = 0;
        const std::span feasible(first, result.levels.end());
        if (!feasible.empty()) {
            find_errors(trials, unit_tilts(setup.model.grid), max_tilt * trials.range(), parts, feasible,
                        &ToleranceLevel::tilt);
            find_errors(trials, {trials.heights()}, max_scale, parts, feasible, &ToleranceLevel::scale);
            const int few = std::max(std::min(few_draws, draws), draws / 10);
            const KeptBySize all =
                ladder(trials.range(), 4, feasible.front().similarity, feasible.back().similarity, [&](double rms) {
                    const std::vector<double> similarities = trials.with_noise(rms, few);
                    const double kept = similarities[may_lose(few)];
                    result.curve.push_back({rms, kept, quantile(similarities, 0.5), few});
                    return kept;
                });
            for (ToleranceLevel& level : feasible) // replaced when all draws are done
                level.noise_rms = bracket(all, level.similarity).first;
            for (auto level = feasible.rbegin(); level != feasible.rend(); ++level) {
                level->noise_rms = largest_noise(trials, all, level->similarity, few, draws);
                if (level->noise_rms > 0) result.curve.push_back({level->noise_rms, level->similarity, unknown, draws});
            }
        }
    } catch (const ga::Stopped&) {
        result.complete = false;
        if (std::isnan(result.levels.back().noise_rms)) // before the first noise was found
            result.draws = 0, result.share_from = 0, result.share_to = 1;
    }
    std::ranges::sort(result.curve, {}, &NoiseQuantile::noise_rms);
    return result;
}

double similarity_under_errors(const DesignSetup& setup, const Genome& genome, const ToleranceOptions& options) {
    try {
        ErrorTrials trials(setup, genome, options);
        const double tilted = trials.lowest(unit_tilts(setup.model.grid), {setup.errors.tilt}).front();
        if (!(setup.errors.noise > 0)) return tilted;
        const int count = options.draws.value_or(draws_for(setup.model.grid));
        return std::min(tilted, trials.with_noise(setup.errors.noise, count)[may_lose(count)]);
    } catch (const ga::Stopped&) {
        return std::numeric_limits<double>::quiet_NaN();
    }
}

} // namespace rough
