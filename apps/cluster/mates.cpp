#include "apps/cluster/mates.hpp"

#include "apps/cluster/crew.hpp"
#include "apps/cluster/frame.hpp"
#include "apps/cluster/ranks.hpp"
#include "apps/cluster/watch.hpp"
#include "apps/prompt/interrupt.hpp"
#include "apps/prompt/progress.hpp"
#include "apps/prompt/verbosity.hpp"
#include "apps/report/units.hpp"
#include "domain/errors.hpp"

#include <iostream>

namespace app::crew {

namespace {

/// How long one may take to say that it is there: less than mpirun gives a run of which a rank has died.
constexpr double roll_seconds = 0.4;

std::string words_of_place(int rank, const Mate& mate) {
    return "rank " + std::to_string(rank) + " (" + mate.place + ")";
}

} // namespace

void Mates::meet(const std::string& introduction) {
    watch_ = watch();
    beat_ = now_and_then([] {
        for (int rank = 1; rank < ranks::count(); ++rank)
            ranks::send(rank, alive, "");
    });
    wait_for(patience, &Mate::introduced, {});
    for_each([&](int rank, Mate& mate) {
        if (!mate.introduced && (lost_ = true))
            throw rough::InputError(words_of_place(rank, mate) + " has not begun within " +
                                    readable(patience) + " s, expected all ranks to start together");
        if (const std::string other = difference(introduction, mate.introduction); !other.empty())
            throw rough::InputError(words_of_place(rank, mate) + " has " + other);
    });
}

bool Mates::listen(const Take& take) {
    const std::vector<ranks::Message> messages = ranks::arrived();
    for (const ranks::Message& message : messages) {
        Mate& mate = all_[static_cast<std::size_t>(message.rank) - 1];
        mate.silence.broken();
        mate.present = true;
        if (message.word == hello) {
            const auto parts = unframed(message.bytes);
            mate.place = parts.at(0);
            mate.threads = number_of<int>(parts.at(1));
            mate.introduction = parts.at(2);
            mate.introduced = true;
        } else if (message.word == end) { // it has given up rank 0, and said so
            lost_ = true;
            ask_to_stop();
        } else if (message.word == bye) {
            mate.left = true;
        } else if (message.word == answers) {
            mate.has.pop_front();
            if (take)
                take(message.rank, message.bytes);
        }
    }
    return !messages.empty();
}

void Mates::wait_for(double seconds, bool Mate::*is, const Take& take) {
    const ga::Stopwatch clock;
    Pause pause;
    const auto all = [&] {
        return std::all_of(all_.begin(), all_.end(), [&](const Mate& mate) { return mate.*is; });
    };
    for (; !all() && clock.seconds() < seconds; std::this_thread::sleep_for(pause.next()))
        listen(take);
}

void Mates::call_roll(const Take& take) {
    for_each([&](int rank, Mate& mate) {
        mate.present = false;
        ranks::send(rank, roll, "");
    });
    wait_for(roll_seconds, &Mate::present, take);
    for_each([&](int rank, Mate& mate) {
        if (!mate.present)
            lose(rank, mate, "does not answer");
    });
}

void Mates::expect_signs_of_life() {
    for_each([&](int rank, Mate& mate) {
        if (!mate.has.empty() && mate.silence.too_long())
            lose(rank, mate, "has not answered for " + readable(patience) + " s");
    });
}

bool Mates::dismiss() {
    if (!lost_) {
        for_each([&](int rank, Mate&) { ranks::send(rank, end, ""); });
        wait_for(stop_asked() ? roll_seconds : patience, &Mate::left, {});
        for_each([&](int rank, Mate& mate) {
            if (!mate.left)
                lose(rank, mate, "has not ended");
        });
    }
    beat_ = {};
    if (!lost_)
        for_each([&](int rank, Mate&) { ranks::send(rank, part, ""); });
    return !lost_;
}

void Mates::lose(int rank, const Mate& mate, const std::string& why) {
    if (std::exchange(lost_, true))
        return;
    clear_progress();
    std::cerr << error_mark() << words_of_place(rank, mate) << " " << why
              << ", the run ends with what it has; what has checkpoints goes on with --resume, on any "
                 "number of ranks\n"
              << std::flush;
    ask_to_stop();
}

} // namespace app::crew
