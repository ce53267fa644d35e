#include "domain/design/tolerance.hpp"

#include "domain/errors.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/numerics/fourier.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/problem/response.hpp"
#include "ga/base/budget.hpp"
#include "ga/base/parallel.hpp"
#include "ga/base/random.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace rough {

namespace {

constexpr int min_draws = 40, max_draws = 1000, min_draws_in_time = 5;
constexpr int few_draws = 20;                       ///< for the octaves, at least
constexpr double line_nodes = 4096, map_nodes = 64; ///< up to so many nodes, max_draws are made
constexpr double precision = 1.01;                  ///< ratio of a size that is lost to one that is kept
constexpr double max_scale = 0.99;

/// Signals that there is no time left.
struct OutOfTime {};

/// Draws of noise of which this many may lose a similarity that a share of 0.95 keeps.
std::size_t may_lose(std::size_t draws) {
    return static_cast<std::size_t>((1 - Tolerance::share) * static_cast<double>(draws) + 1e-9);
}

int draws_for(const Grid& grid) {
    const double nodes = static_cast<double>(grid.shape().nodes()),
                 full = max_draws * (grid.is_2d() ? map_nodes : line_nodes);
    return static_cast<int>(std::clamp<double>(std::round(full / nodes), min_draws, max_draws));
}

/// Similarities of one surface with errors in its heights, which stay as they are made.
class MadeSurface {
  public:
    MadeSurface(const DesignSetup& given, const Genome& genome, const ToleranceOptions& options)
        : setup_(exactly(completed(given))), surface_(sample(genome, setup_.model.grid)),
          range_(surface_.heights.maxCoeff() - surface_.heights.minCoeff()), options_(options),
          threads_(ga::thread_count(options.threads)),
          watch_({std::numeric_limits<long>::max(), options.seconds, options.stop}) {
        setup_.max_pressure.reset();
        models_ = loaded_models(setup_);
        if (given.max_pressure) // it is loaded as far as in the search
            for (Model& model : models_)
                extend(model.loading, *given.max_pressure);
        for (Model& model : models_)
            model.contact.stop = [this] { return watch_.expired(); };
        if (!(options_.noise_length > 0))
            options_.noise_length = setup_.model.grid.length / 60;
    }
    MadeSurface(const MadeSurface&) = delete; // its models refer to its clock

    double range() const { return range_; }
    double noise_length() const { return options_.noise_length; }
    double seconds_left() const { return options_.seconds - watch_.seconds(); }
    int threads() const { return threads_; }

    /// Similarity with these errors (mm) of the heights; -infinity without a response.
    double similarity(const Eigen::VectorXd& errors) const {
        Profile made = surface_;
        made.heights += errors;
        std::vector<Response> responses;
        try {
            for (const Model& model : models_)
                responses.push_back(respond(made, model));
            return rough::similarity(setup_, scored(setup_, std::move(responses)));
        } catch (const std::exception&) {
            if (watch_.expired())
                throw OutOfTime();
            return -HUGE_VAL;
        }
    }
    double similarity() const { return similarity(Eigen::VectorXd::Zero(surface_.nodes())); }

    /// Similarities, in rising order, of the first so many draws of noise with this rms (mm).
    std::vector<double> with_noise(double rms, int draws) {
        std::vector<std::size_t> all(static_cast<std::size_t>(draws));
        std::iota(all.begin(), all.end(), 0);
        make(rms, all);
        std::vector<double> similarities;
        for (const std::size_t i : all)
            similarities.push_back(noise_[i].similarity.at(rms));
        std::sort(similarities.begin(), similarities.end());
        return similarities;
    }
    /// Whether 95 % of the first so many draws keep a similarity. A draw that keeps it with more noise keeps
    /// it, and one that loses it with less noise loses it: only the other draws are pressed.
    bool keep(double level, double rms, int draws) {
        std::vector<std::size_t> open;
        std::size_t lost = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(draws); ++i) {
            bool kept_above = false, lost_below = false;
            if (i < noise_.size())
                for (const auto& [size, similarity] : noise_[i].similarity) {
                    lost_below = lost_below || (size <= rms && similarity < level);
                    kept_above = kept_above || (size >= rms && similarity >= level);
                }
            lost += lost_below;
            if (!lost_below && !kept_above)
                open.push_back(i);
        }
        make(rms, open);
        for (const std::size_t i : open)
            lost += noise_[i].similarity.at(rms) < level;
        return lost <= may_lose(static_cast<std::size_t>(draws));
    }

    /// For each tilt over the length (mm), the lowest similarity of all its directions.
    std::vector<double> with_tilts(const std::vector<double>& tilts) const {
        const Extent shape = surface_.shape();
        Eigen::ArrayXXd along_x(shape.columns, shape.rows);
        along_x.colwise() = Eigen::ArrayXd::LinSpaced(
            shape.columns, 0, surface_.spacing * static_cast<double>(shape.columns - 1));
        std::vector<Eigen::VectorXd> slopes{along_x.reshaped() / setup_.model.grid.length};
        if (surface_.is_2d()) {
            along_x.rowwise() = Eigen::ArrayXd::LinSpaced(
                                    shape.rows, 0, surface_.row_spacing * static_cast<double>(shape.rows - 1))
                                    .transpose();
            slopes.emplace_back(along_x.reshaped() / setup_.model.grid.width);
        }
        return lowest(tilts, slopes);
    }
    /// For each relative error of all heights, the lower similarity of both signs.
    std::vector<double> with_scales(const std::vector<double>& errors) const {
        return lowest(errors, {surface_.heights});
    }

  private:
    void extend(Loading& loading, double max_pressure) const {
        double last = 0; // of the targets against pressure
        for (const Target& target : setup_.targets)
            last = std::max(last, target.against_pressure() ? target.last() : 0);
        if (loading.to_pressure > 0)
            loading.to_pressure *= std::max(1., max_pressure / last);
        else
            loading.to_displacement =
                std::max(loading.to_displacement,
                         loading.reach * displacement_range(surface_, setup_.model.body.kernel));
    }
    /// One draw of noise with rms 1, and the similarity for each rms (mm) that was tried.
    struct Draw {
        Eigen::VectorXd heights = {};
        std::map<double, double> similarity = {};
    };
    void make(double rms, const std::vector<std::size_t>& draws) {
        if (!draws.empty())
            noise_.resize(std::max(noise_.size(), draws.back() + 1));
        each(draws.size(), [&](std::size_t i) {
            Draw& draw = noise_[draws[i]];
            if (draw.heights.size() == 0)
                draw.heights = height_noise(setup_.model.grid, options_.noise_length,
                                            ga::fold(ga::fold(options_.seed, "height noise"), draws[i]));
            draw.similarity[rms] = similarity(rms * draw.heights);
        });
    }
    template <class Job>
    void each(std::size_t n, Job job) const {
        ga::parallel_for(n, threads_, [&](std::size_t i) {
            if (watch_.expired())
                throw OutOfTime();
            job(i);
        });
    }
    std::vector<double> lowest(const std::vector<double>& sizes,
                               const std::vector<Eigen::VectorXd>& errors) const {
        const std::size_t ways = 2 * errors.size();
        std::vector<double> all(sizes.size() * ways), result(sizes.size());
        each(all.size(), [&](std::size_t i) {
            all[i] = similarity((i % 2 ? -sizes[i / ways] : sizes[i / ways]) * errors[i % ways / 2]);
        });
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            const auto from = all.begin() + static_cast<std::ptrdiff_t>(i * ways);
            result[i] = *std::min_element(from, from + static_cast<std::ptrdiff_t>(ways));
        }
        return result;
    }

    DesignSetup setup_; ///< without Eq. 11
    Profile surface_;
    double range_; ///< of its heights, mm
    ToleranceOptions options_;
    int threads_;
    ga::Watch watch_;
    std::vector<Model> models_; ///< one for each way the targets are loaded
    std::vector<Draw> noise_;
};

/// The similarity that is kept at some sizes of an error, by size.
using KeptBySize = std::map<double, double>;

/// Tries octaves of a size up to `cap`: from one that keeps `high` to one that loses `low`.
template <class KeptAt>
KeptBySize octaves(double cap, double high, double low, KeptAt kept) {
    KeptBySize all{{cap / 1024, kept(cap / 1024)}};
    while (all.begin()->second < high && all.begin()->first > cap * 0x1p-40) {
        const double size = all.begin()->first / 2;
        all[size] = kept(size);
    }
    while (all.rbegin()->second >= low && all.rbegin()->first < cap) {
        const double size = 2 * all.rbegin()->first;
        all[size] = kept(size);
    }
    return all;
}

/// The octave before the first that loses the level, 0 if all lose it, and that one; both the last octave if
/// none loses it.
std::pair<double, double> bracket(const KeptBySize& all, double level) {
    const auto lost =
        std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.second < level; });
    const double kept = lost == all.begin() ? 0 : std::prev(lost)->first;
    return {kept, lost == all.end() ? kept : lost->first};
}

/// Narrows a bracket by bisection until its ends differ by a ratio; `keeps` tells whether a size is kept.
template <class Keeps>
std::pair<double, double> narrowed(std::pair<double, double> sizes, double ratio, Keeps keeps) {
    auto& [from, to] = sizes;
    while (to > ratio * from) {
        const double middle = (from + to) / 2;
        (keeps(middle) ? from : to) = middle;
    }
    return sizes;
}

/// The largest tilt or scale up to which every one keeps the level: `probes` of them up to the first octave
/// that loses it are looked at, then the first of these that does is bisected.
template <class KeptAt>
double largest_error(const KeptBySize& all, double level, int probes, KeptAt kept) {
    const double upper = bracket(all, level).second;
    std::vector<double> sizes;
    for (int i = 1; i <= probes; ++i)
        sizes.push_back(upper * i / probes);
    const std::vector<double> similarities = kept(sizes);
    const auto lost = std::find_if(similarities.begin(), similarities.end(),
                                   [&](double similarity) { return similarity < level; });
    if (lost == similarities.end())
        return upper;
    const double to = sizes[static_cast<std::size_t>(lost - similarities.begin())];
    return narrowed({std::max(to - sizes.front(), 1e-3 * sizes.front()), to}, precision,
                    [&](double size) { return kept({size}).front() >= level; })
        .first;
}

/// The largest noise of which so many draws keep the level: bracketed by the few draws of the octaves, then
/// bisected with all.
double largest_noise(MadeSurface& made, const KeptBySize& octaves, double level, int few, int draws) {
    const double cap = made.range();
    auto [from, to] = bracket(octaves, level);
    if (from == 0 || from == to)
        return from;
    std::tie(from, to) = narrowed({from, to}, 1.2, [&](double rms) { return made.keep(level, rms, few); });
    to *= 1.1;
    while (to < cap && made.keep(level, to, draws))
        to *= 1.3;
    while (from > 1e-12 * cap && !made.keep(level, from, draws))
        from /= 2;
    return narrowed({from, to}, precision, [&](double rms) { return made.keep(level, rms, draws); }).first;
}

/// Wilson's interval of a share (95 %) of which so many draws are known.
std::pair<double, double> share_interval(double share, int draws) {
    const double z = 1.96, n = draws, centre = share + z * z / (2 * n),
                 half = z * std::sqrt(share * (1 - share) / n + z * z / (4 * n * n)), all = 1 + z * z / n;
    return {(centre - half) / all, (centre + half) / all};
}

/// How many draws of noise are made, and how many tilts and scales are looked at.
struct Effort {
    int draws, probes;
};

/// All that is wanted; less if time is short, as some curves tell: it is planned for 0.7 of the time.
Effort effort_for(const MadeSurface& made, const Grid& grid, const ToleranceOptions& options) {
    Effort effort{draws_for(grid), grid.is_2d() ? 4 : 64};
    if (options.fixed_draws || std::isinf(options.seconds))
        return effort;
    const ga::Stopwatch clock;
    const std::vector<double> tried(static_cast<std::size_t>(made.threads()), 1e-6);
    made.with_scales(tried); // two curves each
    const double curves = 1.4 * made.seconds_left() * made.threads() / clock.seconds();
    effort.probes = static_cast<int>(std::clamp<double>(curves / 64, 2, effort.probes));
    // 14 curves for each bisection of a tilt or a scale; 32 for their octaves; 7 octaves of noise; and 5 for
    // each draw.
    const double left = curves - 6 * (2 * effort.probes + 14) - 32 - 7 * few_draws;
    effort.draws = static_cast<int>(std::clamp<double>(left / 5, min_draws_in_time, effort.draws));
    return effort;
}

} // namespace

Tolerance tolerance_of(const DesignSetup& setup, const Genome& genome, const ToleranceOptions& options) {
    MadeSurface made(setup, genome, options);
    Tolerance result;
    result.noise_length = made.noise_length();
    result.similarity = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> levels{0.99, 0.95, 0.9, setup.required_similarity};
    std::sort(levels.rbegin(), levels.rend());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    for (const double level : levels)
        result.levels.push_back({level, unknown, unknown, unknown});
    try {
        result.similarity = made.similarity();
        const Effort effort = effort_for(made, setup.model.grid, options);
        result.draws = effort.draws;
        std::tie(result.share_from, result.share_to) = share_interval(Tolerance::share, result.draws);
        std::vector<ToleranceLevel*> feasible;
        for (ToleranceLevel& level : result.levels) {
            if (level.similarity > result.similarity)
                level.noise_rms = level.tilt = level.scale = 0;
            else
                feasible.push_back(&level);
        }
        if (!feasible.empty()) {
            const double high = feasible.front()->similarity, low = feasible.back()->similarity;
            const auto find = [&](double ToleranceLevel::*error, double cap, auto kept) {
                const KeptBySize all =
                    octaves(cap, high, low, [&](double size) { return kept({size}).front(); });
                for (ToleranceLevel* level : feasible)
                    level->*error = largest_error(all, level->similarity, effort.probes, kept);
            };
            using Sizes = std::vector<double>;
            find(&ToleranceLevel::tilt, 16 * made.range(),
                 [&](const Sizes& tilts) { return made.with_tilts(tilts); });
            find(&ToleranceLevel::scale, max_scale,
                 [&](const Sizes& errors) { return made.with_scales(errors); });
            const int few = std::max(std::min(few_draws, result.draws), result.draws / 10);
            const KeptBySize all = octaves(made.range(), high, low, [&](double rms) {
                const std::vector<double> similarities = made.with_noise(rms, few);
                const double kept = similarities[may_lose(similarities.size())];
                result.curve.push_back({rms, kept, quantile(similarities, 0.5), few});
                return kept;
            });
            for (ToleranceLevel* level : feasible) // until all draws are made
                level->noise_rms = bracket(all, level->similarity).first;
            for (auto level = feasible.rbegin(); level != feasible.rend(); ++level) {
                const double similarity = (*level)->similarity;
                (*level)->noise_rms = largest_noise(made, all, similarity, few, result.draws);
                if ((*level)->noise_rms > 0)
                    result.curve.push_back({(*level)->noise_rms, similarity, unknown, result.draws});
            }
        }
    } catch (const OutOfTime&) {
        result.complete = false;
    }
    std::sort(result.curve.begin(), result.curve.end(),
              [](const auto& a, const auto& b) { return a.noise_rms < b.noise_rms; });
    return result;
}

double similarity_under_noise(const DesignSetup& setup, const Genome& genome, double noise_rms,
                              const ToleranceOptions& options) {
    try {
        const std::vector<double> all =
            MadeSurface(setup, genome, options).with_noise(noise_rms, draws_for(setup.model.grid));
        return all[may_lose(all.size())];
    } catch (const OutOfTime&) {
        return std::numeric_limits<double>::quiet_NaN();
    }
}

double similarity_under_tilt(const DesignSetup& setup, const Genome& genome, double tilt) {
    return MadeSurface(setup, genome, {.threads = 1}).with_tilts({tilt}).front();
}

Eigen::VectorXd height_noise(const Grid& grid, double length, std::uint64_t seed) {
    constexpr double cut = 12; // q l beyond which amplitudes are below 2e-8 of the largest
    const double period = grid.wraps ? 1 : 2, pi = std::numbers::pi;
    const auto elements = [&](Index nodes) { return grid.wraps ? nodes : 2 * std::max<Index>(1, nodes - 1); };
    const Extent shape{elements(grid.nodes), grid.is_2d() ? elements(grid.rows) : 1};
    const double dq = 2 * pi * length / (period * grid.length), // of q l
        dq_y = grid.is_2d() ? 2 * pi * length / (period * grid.width) : 0;
    const auto last = static_cast<Index>(cut / dq),
               last_y = grid.is_2d() ? static_cast<Index>(cut / dq_y) : 0;
    const auto folded = [](Index k, Index n) { return (k % n + n) % n; };
    AlignedBuffer<std::complex<double>> waves(shape.nodes());
    std::fill_n(waves.data(), shape.nodes(), 0.);
    ga::Stream random(seed);
    double power = 0;
    for (Index j = -last_y; j <= last_y; ++j)
        for (Index i = -last; i <= last; ++i) {
            const double ql = std::hypot(dq * static_cast<double>(i), dq_y * static_cast<double>(j));
            if (ql > cut)
                continue;
            const double amplitude = std::exp(-ql * ql / 8), a = random.normal(), b = random.normal();
            power += amplitude * amplitude;
            waves[folded(j, shape.rows) * shape.columns + folded(i, shape.columns)] +=
                std::complex(amplitude * a, amplitude * b);
        }
    auto* data = reinterpret_cast<fftw_complex*>(waves.data());
    fftw_execute_dft(complex_fourier_plan(shape).backward, data, data);
    Eigen::VectorXd heights(grid.shape().nodes());
    for (Index k = 0; k < heights.size(); ++k)
        heights[k] = waves[k / grid.nodes * shape.columns + k % grid.nodes].real() / std::sqrt(power);
    return heights;
}

} // namespace rough
