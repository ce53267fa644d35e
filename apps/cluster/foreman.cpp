#include "apps/cluster/foreman.hpp"

#include "apps/cluster/frame.hpp"
#include "apps/cluster/ranks.hpp"
#include "apps/experiments/contact_trial.hpp"
#include "apps/prompt/interrupt.hpp"
#include "apps/prompt/verbosity.hpp"
#include "apps/report/units.hpp"
#include "domain/errors.hpp"
#include "ga/base/parallel.hpp"

#include <iostream>

namespace app::crew {

namespace {

/// Seconds that a chunk should take: long beside talking about it, short beside the whole.
constexpr double chunk_seconds = 0.05;
/// Tasks that take no longer in all are not handed out.
constexpr double not_worth = 2e-3;

} // namespace

bool Foreman::is_worth(const std::string& kind, std::size_t tasks, int threads) const {
    const auto known = seconds_each_.find(kind);
    return tasks > 1 && !mates_.lost() &&
           (known == seconds_each_.end() || known->second * static_cast<double>(tasks) / threads > not_worth);
}

void Foreman::hand_out(const Errand& errand) {
    if (!of_ || of_->kind != errand.kind || of_->setting != errand.setting)
        of_ = std::make_shared<const Assignment>(Assignment{errand.kind, errand.setting});
    next_ = 0;
    over_ = false;
    const struct Ending { // whatever ends it: what is still under way is not wanted
        Foreman& foreman;
        ~Ending() { foreman.call_off(); }
    } ending{*this};
    const auto take_answers = [&](int rank, const std::string& bytes) {
        auto parts = unframed(bytes);
        Done done{number_of<std::uint64_t>(parts.at(0)), number_of<double>(parts.at(1)), {}, parts.at(2)};
        done.answers.assign(parts.begin() + 3, parts.end());
        take(errand, done, rank);
    };
    Pause pause;
    double begun = processor_seconds();
    bool rolled = false;
    for (;;) {
        fill(errand);
        if (open_.empty())
            return;
        const bool moved = mates_.listen(take_answers) | take_own(errand);
        if (stop_asked() && !std::exchange(rolled, true))
            mates_.call_roll(take_answers);
        mates_.expect_signs_of_life();
        if (mates_.lost() || errand.ended())
            return;
        if (moved) {
            pause.begin_anew();
            continue;
        }
        talking_ += processor_seconds() - begun;
        hands_.wait(pause.next());
        begun = processor_seconds();
    }
}

/// Gives out what there is room for.
void Foreman::fill(const Errand& errand) {
    for (bool given = true; given;) {
        given = false;
        mates_.for_each([&](int rank, Mate& mate) {
            if (mate.has.size() >= depth(errand.kind))
                return;
            const Chunk one = cut(errand, mate.threads);
            if (one.tasks.empty())
                return;
            given = true;
            if (mate.told != of_) {
                mate.told = of_;
                ranks::send(rank, setting, framed({of_->kind, of_->setting}));
            }
            if (mate.has.empty())
                mate.silence.broken();
            mate.has.push_back(one.id);
            std::vector<std::string> parts{number_bytes(one.id), number_bytes(one.threads)};
            parts.insert(parts.end(), one.tasks.begin(), one.tasks.end());
            ranks::send(rank, chunk, framed(parts));
        });
        if (hands_.has() < depth(errand.kind))
            if (Chunk one = cut(errand, ga::thread_count(0)); !one.tasks.empty()) {
                given = true;
                hands_.give(std::move(one));
            }
    }
}

/// The next tasks for a rank of so many threads.
Chunk Foreman::cut(const Errand& errand, int threads) {
    Chunk one{++chunks_, errand.threads, of_, {}};
    if (errand.threads > 0)
        threads = errand.threads;
    const double left = static_cast<double>(std::max(errand.count, next_ + 1) - next_);
    const double sharers = static_cast<double>(shares_.size());
    const auto known = seconds_each_.find(errand.kind);
    const double in_time = known == seconds_each_.end() ? threads : chunk_seconds * threads / known->second;
    const double least = std::min<double>(threads, std::ceil(left / sharers));
    const double most = std::max(least, std::ceil(left / (2 * sharers)));
    const auto size = static_cast<std::size_t>(std::clamp(in_time, least, most));
    const std::size_t first = next_;
    while (one.tasks.size() < size && !over_)
        if (auto task = errand.next()) {
            one.tasks.push_back(std::move(*task));
            ++next_;
        } else {
            over_ = true;
        }
    if (!one.tasks.empty())
        open_[one.id] = {first, one.tasks.size(), threads};
    return one;
}

/// How many chunks a rank has at a time: the next before one is done, unless tasks take so long that it would
/// wait while others are idle.
std::size_t Foreman::depth(const std::string& kind) const {
    const auto known = seconds_each_.find(kind);
    return known == seconds_each_.end() || known->second > chunk_seconds ? 1 : 2;
}

bool Foreman::take_own(const Errand& errand) {
    const auto done = hands_.done();
    if (done)
        take(errand, *done, 0);
    return done.has_value();
}

void Foreman::take(const Errand& errand, const Done& done, int rank) {
    const auto found = open_.find(done.id);
    if (found == open_.end())
        return; // of an errand that has ended
    const Given given = found->second;
    open_.erase(found);
    if (!done.error.empty())
        throw rough::InputError(done.error);
    const auto count = static_cast<double>(given.count);
    const double each = std::max(1e-7, done.seconds * std::min<double>(given.threads, count) / count);
    double& known = seconds_each_.try_emplace(errand.kind, each).first->second;
    known += 0.2 * (each - known);
    Share& share = shares_[static_cast<std::size_t>(rank)];
    share.tasks += given.count;
    share.seconds += done.seconds;
    for (std::size_t i = 0; i < given.count; ++i)
        errand.take(given.first + i, done.answers[i]);
}

void Foreman::call_off() {
    if (open_.empty())
        return;
    open_.clear();
    hands_.drop();
    mates_.for_each([&](int rank, Mate& mate) {
        if (!mate.has.empty())
            ranks::send(rank, drop, "");
    });
    for (; hands_.has() > 0; hands_.wait(std::chrono::milliseconds(1)))
        hands_.done();
}

int Foreman::leave(int code) {
    for (std::size_t rank = 0; rank < shares_.size(); ++rank)
        tell("rank " + std::to_string(rank) + ": " + std::to_string(shares_[rank].tasks) + " tasks in " +
             readable(shares_[rank].seconds) + " s");
    tell("rank 0: " + std::to_string(ranks::traffic().messages) + " messages, " +
         std::to_string(ranks::traffic().bytes) + " bytes, " + readable(talking_) +
         " s of handing out and taking in");
    std::cout.flush();
    if (mates_.dismiss()) {
        ranks::leave(farewell(), code);
        return code;
    }
    ranks::end_all(farewell(), code == 0 ? exit_interrupted : code);
}

} // namespace app::crew
