#include "apps/cluster/crew.hpp"

#include "apps/cluster/frame.hpp"
#include "apps/cluster/hands.hpp"
#include "apps/cluster/ranks.hpp"
#include "apps/prompt/interrupt.hpp"
#include "apps/prompt/progress.hpp"
#include "apps/prompt/voice.hpp"
#include "apps/report/units.hpp"
#include "domain/errors.hpp"
#include "domain/numerics/build.hpp"
#include "domain/text/words.hpp"
#include "ga/parallel.hpp"
#include "ga/stopwatch.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <map>
#include <unistd.h>

namespace app::crew {

namespace {

using namespace std::chrono_literals;

/// What ranks tell each other.
enum Word : int {
    hello,   ///< who one is
    setting, ///< kind and setting of the chunks that follow
    chunk,   ///< id, threads, tasks
    drop,    ///< no chunk given so far is wanted
    answers, ///< id, seconds, what was thrown, answers
    roll,    ///< are you there
    alive,   ///< yes; sent now and then by one at work, too
    end,     ///< there is nothing more to do
    bye      ///< the last word
};

/// Seconds that a chunk should take: long beside talking about it, short beside the whole.
constexpr double chunk_seconds = 0.02;
/// A chunk shorter than this is given before the one in hand is done.
constexpr double short_chunk = 0.05;
/// Tasks that take no longer in all are not handed out.
constexpr double not_worth = 2e-3;
/// How long one may take to say that it is there: less than mpirun gives a run of which a rank has died.
constexpr double roll_seconds = 0.4;

/// s of silence until a rank is given up.
double patience = 10;

/// Seconds between two signs of life.
double interval() { return std::min(0.5, patience / 5); }

/// Since when another was silent. Time in which oneself did not listen does not count: a whole run may be
/// suspended and go on.
class Silence {
  public:
    void broken() { heard_ = listened_ = ga::Stopwatch(); }
    bool too_long() {
        if (listened_.seconds() > patience / 2)
            broken();
        listened_ = ga::Stopwatch();
        return heard_.seconds() > patience;
    }

  private:
    ga::Stopwatch heard_, listened_;
};

/// Ever longer while nothing happens: a tenth of the time waited, up to a millisecond.
class Pause {
  public:
    std::chrono::microseconds next() {
        const double most = 1000, least = 20;
        return std::chrono::microseconds(std::lround(std::clamp(1e5 * since_.seconds(), least, most)));
    }
    void begin_anew() { since_ = ga::Stopwatch(); }

  private:
    ga::Stopwatch since_;
};

/// Another rank, as rank 0 knows it.
struct Mate {
    std::string place = "a host that is not known"; ///< where it runs
    int threads = 1;                                ///< that it has
    bool introduced = false, present = true, left = false;
    std::shared_ptr<const Assignment> told = {}; ///< the last setting sent
    std::deque<std::uint64_t> has = {};          ///< chunks that it was given
    Silence silence = {};
};

/// What a rank has done.
struct Share {
    std::size_t tasks = 0;
    double seconds = 0; ///< at them
};

std::string words_of_place(int rank, const Mate& mate) {
    return "rank " + std::to_string(rank) + " (" + mate.place + ")";
}

/// Rank 0's view of the others, for as long as the program runs.
class Foreman {
  public:
    explicit Foreman(int ranks)
        : mates_(static_cast<std::size_t>(ranks - 1)), shares_(static_cast<std::size_t>(ranks)) {}

    void meet(const Words& words) {
        beat_ = std::jthread([this](const std::stop_token& stop) { beat(stop); });
        wait_for(patience, [](const Mate& mate) { return mate.introduced; });
        for_each([&](int rank, Mate& mate) {
            if (!mate.introduced && (lost_ = true))
                throw rough::InputError(words_of_place(rank, mate) + " has not begun within " +
                                        readable(patience) + " s, expected all ranks to start together");
            if (const std::string other = difference(introduction(words), says_[rank]); !other.empty())
                throw rough::InputError(words_of_place(rank, mate) + " has " + other);
        });
    }

    void hand_out(const Errand& errand) {
        const auto of = std::make_shared<const Assignment>(Assignment{errand.kind, errand.setting});
        if (!of_ || of_->kind != of->kind || of_->setting != of->setting)
            of_ = of;
        next_ = 0;
        over_ = false;
        const struct Ending { // whatever ends it: what is still under way is not wanted
            Foreman& foreman;
            ~Ending() { foreman.call_off(); }
        } ending{*this};
        Pause pause;
        bool rolled = false;
        for (;;) {
            fill(errand);
            if (open_.empty())
                return;
            const bool moved = listen(&errand) | take_own(errand);
            if (stop_asked() && !std::exchange(rolled, true))
                call_roll(errand);
            expect_signs_of_life();
            if (lost_ || errand.ended())
                return;
            if (moved)
                pause.begin_anew();
            else
                hands_.wait(pause.next());
        }
    }

    bool is_worth(const std::string& kind, std::size_t tasks, int threads) {
        const auto known = seconds_each_.find(kind);
        return tasks > 1 && !lost_ &&
               (known == seconds_each_.end() ||
                known->second * static_cast<double>(tasks) / threads > not_worth);
    }

    int leave(int code) {
        beat_ = {};
        for (std::size_t rank = 0; rank < shares_.size(); ++rank)
            tell("rank " + std::to_string(rank) + ": " + std::to_string(shares_[rank].tasks) + " tasks in " +
                 readable(shares_[rank].seconds) + " s");
        tell("rank 0: " + std::to_string(ranks::traffic().messages) + " messages, " +
             std::to_string(ranks::traffic().bytes) + " bytes");
        std::cout.flush();
        for_each([&](int rank, Mate&) { ranks::send(rank, end, ""); });
        wait_for(lost_ || stop_asked() ? roll_seconds : patience, [](const Mate& mate) { return mate.left; });
        for_each([&](int rank, Mate& mate) {
            if (!mate.left)
                lose(rank, mate, "has not ended");
        });
        if (!lost_) {
            ranks::leave();
            return code;
        }
        ranks::end_all(code == 0 ? exit_interrupted : code);
    }

  private:
    template <class Do>
    void for_each(Do one) {
        for (std::size_t i = 0; i < mates_.size(); ++i)
            one(static_cast<int>(i) + 1, mates_[i]);
    }
    template <class Is>
    void wait_for(double seconds, Is is, const Errand* errand = nullptr) {
        const ga::Stopwatch clock;
        Pause pause;
        while (!std::all_of(mates_.begin(), mates_.end(), is) && clock.seconds() < seconds) {
            listen(errand);
            hands_.wait(pause.next());
        }
    }

    /// Gives out what there is room for.
    void fill(const Errand& errand) {
        for (bool given = true; given;) {
            given = false;
            for_each([&](int rank, Mate& mate) {
                if (mate.has.size() < depth(errand.kind)) {
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
                }
            });
            if (hands_.has() < depth(errand.kind))
                if (Chunk one = cut(errand, ga::thread_count(0)); !one.tasks.empty()) {
                    given = true;
                    hands_.give(std::move(one));
                }
        }
    }

    /// The next tasks for a rank of so many threads.
    Chunk cut(const Errand& errand, int threads) {
        Chunk one{++chunks_, errand.threads, of_, {}};
        if (errand.threads > 0)
            threads = errand.threads;
        const double left = static_cast<double>(std::max(errand.count, next_ + 1) - next_);
        const double sharers = static_cast<double>(mates_.size() + 1);
        const auto known = seconds_each_.find(errand.kind);
        const double in_time =
            known == seconds_each_.end() ? threads : chunk_seconds * threads / known->second;
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
    std::size_t depth(const std::string& kind) const {
        const auto known = seconds_each_.find(kind);
        return known == seconds_each_.end() || known->second > short_chunk ? 1 : 2;
    }

    /// Takes in what was said; whether anything was.
    bool listen(const Errand* errand) {
        const std::vector<ranks::Message> messages = ranks::arrived();
        for (const ranks::Message& message : messages) {
            Mate& mate = mates_[static_cast<std::size_t>(message.rank) - 1];
            mate.silence.broken();
            mate.present = true;
            if (message.word == hello) {
                const auto parts = unframed(message.bytes);
                mate.place = parts.at(0);
                mate.threads = number_of<int>(parts.at(1));
                says_[message.rank] = parts.at(2);
                mate.introduced = true;
            } else if (message.word == end) {
                lost_ = true;
                ask_to_stop();
            } else if (message.word == bye) {
                mate.left = true;
            } else if (message.word == answers) {
                auto parts = unframed(message.bytes);
                Done done{
                    number_of<std::uint64_t>(parts.at(0)), number_of<double>(parts.at(1)), {}, parts.at(2)};
                done.answers.assign(parts.begin() + 3, parts.end());
                mate.has.pop_front();
                if (errand)
                    take(*errand, done, message.rank);
            }
        }
        return !messages.empty();
    }
    bool take_own(const Errand& errand) {
        const auto done = hands_.done();
        if (done)
            take(errand, *done, 0);
        return done.has_value();
    }
    void take(const Errand& errand, const Done& done, int rank) {
        const auto found = open_.find(done.id);
        if (found == open_.end())
            return; // of an errand that has ended
        const Given given = found->second;
        open_.erase(found);
        if (!done.error.empty())
            throw rough::InputError(done.error);
        const double each = done.seconds * std::min<double>(given.threads, static_cast<double>(given.count)) /
                            static_cast<double>(given.count);
        Share& share = shares_[static_cast<std::size_t>(rank)];
        share.tasks += given.count;
        share.seconds += done.seconds;
        double& known = seconds_each_.try_emplace(errand.kind, each).first->second;
        known += 0.2 * (std::max(each, 1e-7) - known);
        for (std::size_t i = 0; i < given.count; ++i)
            errand.take(given.first + i, done.answers[i]);
    }

    void call_off() {
        if (open_.empty())
            return;
        open_.clear();
        hands_.drop();
        for_each([&](int rank, Mate& mate) {
            if (!mate.has.empty())
                ranks::send(rank, drop, "");
        });
        for (; hands_.has() > 0; hands_.wait(1ms))
            hands_.done();
    }

    /// Asks everybody whether they are there: a launcher asks a run to end also when one of its ranks has
    /// died.
    void call_roll(const Errand& errand) {
        for_each([&](int rank, Mate& mate) {
            mate.present = false;
            ranks::send(rank, roll, "");
        });
        wait_for(
            roll_seconds, [](const Mate& mate) { return mate.present; }, &errand);
        for_each([&](int rank, Mate& mate) {
            if (!mate.present)
                lose(rank, mate, "does not answer");
        });
    }
    void expect_signs_of_life() {
        for_each([&](int rank, Mate& mate) {
            if (!mate.has.empty() && mate.silence.too_long())
                lose(rank, mate, "has not answered for " + readable(patience) + " s");
        });
    }
    /// Says so, once, and has the run end as if it were asked to.
    void lose(int rank, const Mate& mate, const std::string& why) {
        if (std::exchange(lost_, true))
            return;
        clear_progress();
        std::cerr << error_mark() << words_of_place(rank, mate) << " " << why
                  << ", the run ends with what it has; what has checkpoints goes on with --resume, on any "
                     "number of ranks\n"
                  << std::flush;
        ask_to_stop();
    }

    /// Tells the others that rank 0 is there, whatever else it is at.
    void beat(const std::stop_token& stop) {
        std::mutex own;
        std::condition_variable_any wait;
        for (std::unique_lock lock(own); !stop.stop_requested();) {
            for_each([&](int rank, Mate&) { ranks::send(rank, alive, ""); });
            wait.wait_for(lock, stop, std::chrono::duration<double>(interval()), [] { return false; });
        }
    }

    struct Given {
        std::size_t first = 0, count = 0; ///< tasks
        int threads = 1;
    };

    std::vector<Mate> mates_;         ///< rank 1 and on
    std::vector<Share> shares_;       ///< rank 0 and on
    std::map<int, std::string> says_; ///< introductions
    Hands hands_;
    std::shared_ptr<const Assignment> of_;       ///< what is handed out now
    std::map<std::string, double> seconds_each_; ///< of one thread for a task, by kind: what was measured
    std::map<std::uint64_t, Given> open_;        ///< chunks of the errand that are not answered
    std::uint64_t chunks_ = 0;
    std::size_t next_ = 0; ///< the next task's place
    bool over_ = false;    ///< there are no more
    bool lost_ = false;    ///< a rank was given up
    std::jthread beat_;    ///< the last to be made, the first to go
};

std::unique_ptr<Foreman>& foreman() {
    static std::unique_ptr<Foreman> one; // none where there are no other ranks
    return one;
}

/// "host, process 4711"
std::string own_place() {
    char name[256] = "";
    ::gethostname(name, sizeof name - 1);
    return std::string(name) + ", process " + std::to_string(::getpid());
}

/// Does what rank 0 hands out until it says that there is nothing more.
[[noreturn]] void serve(const Words& words) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        std::signal(signal, SIG_IGN); // rank 0 decides
    ranks::send(0, hello, framed({own_place(), number_bytes(ga::thread_count(0)), introduction(words)}));
    Hands hands;
    std::shared_ptr<const Assignment> of;
    ga::Stopwatch told;
    Silence silence;
    const auto tell = [&](Word word, const std::string& bytes) {
        ranks::send(0, word, bytes);
        told = ga::Stopwatch();
    };
    for (Pause pause;;) {
        const auto messages = ranks::arrived();
        for (const ranks::Message& message : messages)
            if (message.word == setting) {
                auto parts = unframed(message.bytes);
                of = std::make_shared<const Assignment>(Assignment{parts.at(0), parts.at(1)});
            } else if (message.word == chunk) {
                auto parts = unframed(message.bytes);
                hands.give({number_of<std::uint64_t>(parts.at(0)),
                            number_of<int>(parts.at(1)),
                            of,
                            {parts.begin() + 2, parts.end()}});
            } else if (message.word == drop) {
                hands.drop();
            } else if (message.word == roll) {
                tell(alive, "");
            } else if (message.word == end) {
                tell(bye, "");
                while (!ranks::all_sent())
                    std::this_thread::sleep_for(1ms);
                ranks::leave();
                std::_Exit(0); // what is under way is not waited for
            }
        bool moved = !messages.empty();
        if (moved)
            silence.broken();
        if (ranks::own() == 1 && silence.too_long()) {
            std::cerr << error_mark() << "rank 0 has not answered for " << readable(patience)
                      << " s, the run ends without it; what has checkpoints goes on with --resume\n"
                      << std::flush;
            ranks::send(0, end, ""); // should it wake up, it need not say so too
            ranks::end_all(exit_interrupted);
        }
        for (auto done = hands.done(); done; done = hands.done()) {
            std::vector<std::string> parts{number_bytes(done->id), number_bytes(done->seconds), done->error};
            parts.insert(parts.end(), done->answers.begin(), done->answers.end());
            tell(answers, framed(parts));
            moved = true;
        }
        if (hands.has() > 0 && told.seconds() > interval())
            tell(alive, "");
        if (moved)
            pause.begin_anew();
        else
            hands.wait(pause.next());
    }
}

void take_patience(Words& words) {
    const std::string flag = "--patience";
    const auto found = std::find_if(words.begin(), words.end(), [&](const std::string& word) {
        return word == flag || word.starts_with(flag + "=");
    });
    if (found == words.end())
        return;
    const bool joined = *found != flag;
    if (!joined && found + 1 == words.end())
        throw rough::InputError(flag + ": given without a value, expected seconds");
    const std::string given = joined ? found->substr(flag.size() + 1) : *(found + 1);
    patience = rough::number_from(given, flag);
    if (!(patience >= 0.1 && patience <= 1e6))
        throw rough::InputError(flag + ": " + given + " given, expected 0.1 to 1e6 seconds");
    words.erase(found, found + (joined ? 1 : 2));
}

} // namespace

std::string introduction(const Words& words) {
    const rough::Build build = rough::build();
    std::string line;
    for (const std::string& word : words)
        line += (line.empty() ? "" : " ") + word;
    return framed({RUGOSA_VERSION, build.compiler + " " + build.flags, build.vectors, line});
}

std::string difference(const std::string& one, const std::string& other) {
    const auto own = unframed(one), theirs = unframed(other);
    const char* const names[] = {"version", "build", "vectors (RUGOSA_VECTORS)", "words"};
    for (std::size_t i = 0; i < own.size(); ++i)
        if (i >= theirs.size() || own[i] != theirs[i])
            return std::string(names[i]) + " '" + (i < theirs.size() ? theirs[i] : "") + "', expected '" +
                   own[i] + "' as rank 0 has";
    return "";
}

void join(Words& words) {
    ranks::join();
    if (ranks::own() > 0) {
        try {
            take_patience(words);
        } catch (const rough::InputError&) { // rank 0 says so
        }
        serve(words);
    }
    if (ranks::count() > 1)
        foreman() = std::make_unique<Foreman>(ranks::count());
    take_patience(words);
    if (foreman())
        foreman()->meet(words);
}

int leave(int code) {
    if (!foreman()) {
        ranks::leave();
        return code;
    }
    const int last = foreman()->leave(code);
    foreman().reset();
    return last;
}

bool is_alone() { return !foreman(); }
bool is_worth(const std::string& kind, std::size_t tasks, int threads) {
    return foreman() && foreman()->is_worth(kind, tasks, threads);
}
void hand_out(const Errand& errand) { foreman()->hand_out(errand); }

} // namespace app::crew
