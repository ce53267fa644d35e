#include "domain/database/build.hpp"

#include "domain/errors.hpp"
#include "domain/mwm/response.hpp"
#include "ga/base/parallel.hpp"

#include <map>
#include <unistd.h>

namespace rough {
namespace {

/// The unfinished batches of a build.
class Batches {
  public:
    Batches(GenomeStore& store, const BuildOptions& options) : store_(store), options_(options) {
        // A batch is held in memory and stored as one cell.
        constexpr double max_numbers = 1e7;
        const DatabaseSetup& setup = store.setup();
        const double per_genome = std::max(2 * max_phases(setup.law) + 100, 2. * setup.model.loading.steps + 1);
        size_ = std::clamp<std::uint64_t>(static_cast<std::uint64_t>(max_numbers / per_genome), 1,
                                          std::max<std::uint64_t>(options.batch, 1));
        stored_ = store.stored();
    }

    std::optional<std::uint64_t> next() {
        if (ended()) return std::nullopt;
        if (handed_out_ == last_.count) {
            const auto span = store_.take(wanted_, size_, [&](std::uint64_t first) { return open_.count(first) > 0; });
            if (!span) return std::nullopt;
            last_ = *span;
            open_[last_.first] = {last_, std::vector<Response>(last_.count), last_.count};
            handed_out_ = 0;
        }
        return last_.first + handed_out_++;
    }
    void take(std::uint64_t genome, Response response) {
        const auto after = open_.upper_bound(genome);
        const auto found = after == open_.begin() ? open_.end() : std::prev(after);
        if (found == open_.end() || genome - found->first >= found->second.span.count)
            refuse("genome ", genome, ": computed but not requested; run one program on all ranks");
        auto& [span, responses, missing] = found->second;
        responses[genome - span.first] = std::move(response);
        if (--missing > 0) return;
        stored_ += store_.add(span, responses) ? span.count : 0;
        open_.erase(found);
        goes_on_ = options_.go_on(stored_);
    }
    bool ended() const { return !goes_on_ || (options_.stop && options_.stop->load()); }
    std::uint64_t missing() const {
        std::uint64_t count = 0;
        for (const Span& gap : store_.gaps(wanted_)) count += gap.count;
        return count;
    }

  private:
    struct Batch {
        Span span;
        std::vector<Response> responses;
        std::uint64_t missing; ///< responses
    };

    GenomeStore& store_;
    const BuildOptions& options_;
    Span wanted_{options_.first, options_.genomes}, last_; ///< still to do; the batch taken last
    std::uint64_t size_ = 1, stored_ = 0, handed_out_ = 0; ///< handed_out_ genomes of last_
    std::map<std::uint64_t, Batch> open_;                  ///< each under its first genome
    bool goes_on_ = true;
};

void compute_on_threads(int threads, const DatabaseSetup& setup, const Orders& orders) {
    std::mutex lock;
    const int count = ga::thread_count(threads);
    ga::parallel_for(static_cast<std::size_t>(count), count, [&](std::size_t) {
        std::unique_lock held(lock);
        while (const auto genome = orders.next()) {
            held.unlock();
            Response response = response_for(setup, *genome);
            held.lock();
            if (!orders.ended()) orders.take(*genome, std::move(response));
        }
    });
}

} // namespace

Response response_for(const DatabaseSetup& setup, std::uint64_t genome) {
    try {
        return respond(drawn(setup.law, genome), setup.model);
    } catch (const NotConverged&) {
        const double nothing = std::numeric_limits<double>::quiet_NaN();
        const Eigen::VectorXd column = Eigen::VectorXd::Constant(setup.model.loading.steps, nothing);
        return {nothing, column, column, column, column, column, Solver::automatic};
    }
}

void build(GenomeStore& store, const BuildOptions& options) {
    for (const Span& span : store.batches()) // nothing is appended to a damaged file
        store.responses(span);
    Batches batches(store, options);
    const Orders orders{batches.missing(), [&] { return batches.next(); },
                        [&](std::uint64_t genome, Response response) { batches.take(genome, std::move(response)); },
                        [&] { return batches.ended(); }};
    if (options.computing)
        options.computing(store.setup(), orders);
    else
        compute_on_threads(options.threads, store.setup(), orders);
}

std::uint64_t merge(const std::vector<std::filesystem::path>& files, const std::filesystem::path& out) {
    std::vector<GenomeStore> all;
    for (const auto& file : files) {
        all.push_back(GenomeStore::open(file));
        const GenomeStore &first = all.front(), &last = all.back();
        if (const std::string other = difference(named_values(last.setup()), named_values(first.setup()));
            !other.empty())
            refuse(file.string(), ": its ", other, " as that of ", files.front().string(),
                   "; merge databases of one set-up");
        if (last.version() != first.version())
            refuse(file.string(), ": made by version ", last.version(), ", but ", files.front().string(), " by ",
                   first.version(), "; build one of them again");
    }
    const std::filesystem::path draft = out.string() + "." + std::to_string(::getpid()) + ".tmp";
    const struct Draft {
        const std::filesystem::path& file;
        ~Draft() {
            std::error_code none;
            std::filesystem::remove(file, none); // gone if it was renamed
            std::filesystem::remove(file.string() + "-journal", none);
        }
    } ending{draft};
    std::filesystem::remove(draft);
    std::uint64_t count = 0;
    {
        GenomeStore merged = GenomeStore::create(draft, all.front().setup());
        for (const GenomeStore& one : all)
            for (const Span& span : one.batches()) {
                const std::vector<Response> responses = one.responses(span);
                for (const Span& part : merged.gaps(span)) {
                    const auto begin = responses.begin() + static_cast<std::ptrdiff_t>(part.first - span.first);
                    merged.add(part, {begin, begin + static_cast<std::ptrdiff_t>(part.count)});
                }
            }
        count = merged.stored();
    }
    std::filesystem::rename(draft, out);
    return count;
}

} // namespace rough
