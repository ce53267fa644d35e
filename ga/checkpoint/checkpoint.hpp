#pragma once

#include "ga/base/held_folder.hpp"
#include "ga/base/json.hpp"
#include "ga/pipeline/run.hpp"

#include <fstream>

namespace ga {

/// The head of a sealed file: a mark, then the length and the fingerprint of the content that follows. So a
/// file that was cut off or damaged is detected.
std::string seal_of(std::string_view bytes);

/// Reads the content of a sealed file. Throws UsageError, with the file's name, if it cannot be read or is damaged.
std::string opened(const std::filesystem::path& file);

/// Writes a sealed file and keeps the previous one as "FILE.before". The new file is completely on disk before it is
/// renamed to this name. Symbolic links are not followed. Returns the error in words, or an empty text.
std::string seal(const std::filesystem::path& name, std::string_view bytes);

/// Reads CBOR. Throws UsageError, with the file's name, if it nests too deep (bounded_json), and nlohmann's
/// exceptions if it is not CBOR.
nlohmann::json read_cbor(const std::string& bytes, const std::filesystem::path& file);

using nlohmann::json;

///@{ Write and read the parts of a checkpoint without loss. Reading throws nlohmann's exceptions on other
/// JSON.
void to_json(json& j, const Permutation& permutation);
void from_json(const json& j, Permutation& permutation);

void to_json(json& j, const Counters& c);
void from_json(const json& j, Counters& c);

/// A fitness without its levels; null for an unscored one. read_scored() reads it.
json scored(const Fitness& fitness);
/// The fitness that scored() has written.
Fitness read_scored(const json& scored);

template <class G>
void to_json(json& j, const Individual<G>& individual) {
    j = {individual.genome,
         individual.identity,
         std::vector<Identity>(individual.parents.begin(), individual.parents.end()),
         scored(individual.fitness),
         individual.origin ? json(*individual.origin) : json(),
         individual.fitness.levels()};
}
template <class G>
void from_json(const json& j, Individual<G>& individual) {
    std::vector<Identity> parents;
    read_parts(j, individual.genome, individual.identity, parents);
    individual.parents = parents.size() == 2   ? Parents(parents[0], parents[1])
                         : parents.size() == 1 ? Parents(parents[0])
                                               : Parents();
    individual.fitness = read_scored(j.at(3));
    std::uint8_t levels = 0;
    j.at(5).get_to(levels);
    individual.fitness.set_levels(levels);
    individual.origin.reset();
    if (!j.at(4).is_null()) {
        G origin;
        j.at(4).get_to(origin);
        individual.origin = std::make_shared<const G>(std::move(origin));
    }
}

template <class G>
void to_json(json& j, const Frame<G>& frame) {
    json states = json::object();
    for (const auto& [path, state] : frame.states) state.write(states[path]);
    j = {frame.next, frame.population, frame.kept, frame.numbers, std::move(states)};
}
template <class G>
void from_json(const json& j, Frame<G>& frame) {
    read_parts(j, frame.next, frame.population, frame.kept, frame.numbers);
    for (const auto& [path, state] : j.at(4).items())
        frame.states[path] = OperatorState(std::make_shared<const json>(state));
}

template <class G>
void to_json(json& j, const Snapshot<G>& snapshot) {
    j = {snapshot.frames, snapshot.counters, snapshot.next_identity, snapshot.best ? json(*snapshot.best) : json(),
         snapshot.notes,  snapshot.seconds,  snapshot.heaviest,      snapshot.idle_generations};
}
template <class G>
void from_json(const json& j, Snapshot<G>& snapshot) {
    json best;
    read_parts(j, snapshot.frames, snapshot.counters, snapshot.next_identity, best, snapshot.notes, snapshot.seconds,
               snapshot.heaviest, snapshot.idle_generations);
    if (!best.is_null()) snapshot.best = best.get<Individual<G>>();
}
///@}

/// Whether a value from a file can be one of a run of the problem, so that stages need not check it. Checks genomes by
/// `is_valid`, fitnesses by their policy, counters by their range, and observers' values by their `is_valid()`.
template <Problem P, class T>
bool can_be_kept(const P& problem, const T& value) {
    using G = typename P::Genome;
    const auto each = [&](const auto&... parts) { return (can_be_kept(problem, parts) && ...); };
    const auto finite = [](const std::vector<double>& numbers) {
        return std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
    };
    if constexpr (std::same_as<T, G>) {
        return is_valid(problem, value);
    } else if constexpr (std::same_as<T, Fitness>) {
        if (!value.known() || value.has_failed()) return true;
        const std::string& policy = value.objective(); // "f1" or "pareto f1 f2"
        const auto objectives = static_cast<std::size_t>(std::ranges::count(policy, ' '));
        const bool scored = objectives > 0
                                ? value.values().size() == objectives && finite(value.values())
                                : !value.several() && std::isfinite(value.value()) &&
                                      std::ranges::any_of(problem.objectives(), [&](const auto& objective) {
                                          return objective.name == policy && objective.minimise == value.minimises();
                                      });
        return scored && finite(value.violations()) && finite({value.violation()}) && value.violation() >= 0 &&
               value.replicates() > 0;
    } else if constexpr (std::same_as<T, Individual<G>>) {
        if (!each(value.genome, value.fitness) || (value.origin && !each(*value.origin))) return false;
        if constexpr (HasGenes<P>) // refinement reads the bounds of the origin
            return !value.origin || genes_of(problem, *value.origin).size() == genes_of(problem, value.genome).size();
        else
            return true;
    } else if constexpr (std::same_as<T, Frame<G>>) {
        return each(value.population, value.kept);
    } else if constexpr (std::same_as<T, Counters>) {
        const auto counts = [](auto... numbers) { return ((numbers >= 0 && numbers <= 1L << 53) && ...); };
        return counts(value.requested, value.evaluations, value.remembered, value.gradients, value.failures,
                      value.requested_price, value.price);
    } else if constexpr (std::same_as<T, Snapshot<G>>) {
        return each(value.frames, value.counters) && (!value.best || each(*value.best)) && finite({value.seconds}) &&
               value.seconds >= 0 && value.idle_generations >= 0;
    } else if constexpr (requires { value.is_valid(); }) {
        return value.is_valid();
    } else if constexpr (std::ranges::range<T> && !std::convertible_to<T, std::string_view>) {
        return std::ranges::all_of(value, [&](const auto& part) { return can_be_kept(problem, part); });
    } else {
        return true;
    }
}

/// Outcomes that a checkpoint can store. Others are evaluated again after a resume, which affects the count
/// of evaluations but not a result.
template <class Outcome>
concept Storable = requires(const json& j, const Outcome& outcome) {
    json(outcome);
    { j.get<Outcome>() } -> std::same_as<Outcome>;
};

/// Stores a run in one file. It is written at the end, and between stages at most once per interval. Writing
/// takes at most a twentieth of the time. Each write replaces the file by renaming; the previous file is kept
/// as "FILE.before" and used if the newer one is damaged. A resumed run reaches the result of an
/// uninterrupted one, however its process ended. If the file cannot be written, the run continues with a
/// note. Genomes must convert to and from nlohmann::json without loss.
template <Problem P>
class Checkpoints : public Checkpointer<P> {
  public:
    using Genome = typename P::Genome;   ///< stored as json
    using Outcome = typename P::Outcome; ///< stored if it converts to json
    using Taken = Snapshot<Genome>;      ///< a run between two stages

    /// @param file         stores the run
    /// @param description  other settings that decide the result (the problem's); a file with different ones
    /// is refused
    /// @param resume       continue from the file if it exists; otherwise it is replaced
    /// @param interval     seconds between two writes
    Checkpoints(std::filesystem::path file, std::string description, bool resume, double interval = 1)
        : file_(std::move(file)), description_(std::move(description)), resume_(resume), interval_(interval) {}

    /// Stores a value of an observer with the run. It is written with every checkpoint and read when the run
    /// is resumed, before its first stage. The value must outlive the run.
    template <class T>
    void keep(const std::string& name, T& value) {
        kept_.push_back({name, [&value] { return json(value); },
                         [&value](const json& j, const P& problem) {
                             j.get_to(value);
                             expect_valid(can_be_kept(problem, value));
                         }});
    }

    std::optional<Taken> begin(Ledger<P>& ledger, std::uint64_t run) override {
        run_ = run;
        const std::filesystem::path file = held_path(file_), before = file.string() + ".before";
        if (!resume_) {
            std::error_code none;
            std::filesystem::remove(before, none); // left by another run
        }
        if (!resume_ || !(std::filesystem::exists(file) || std::filesystem::exists(before))) return std::nullopt;
        std::string bytes;
        try {
            bytes = opened(std::filesystem::exists(file) ? file_ : before);
        } catch (const UsageError& damaged) {
            if (!std::filesystem::exists(before)) throw;
            bytes = opened(before);
            std::filesystem::rename(before, file); // the next write renames this file to FILE.before
            trouble_ = std::string(damaged.what()) + "; went on from the one before";
        }
        try {
            const json j = read_cbor(bytes, file_);
            if (j.at("version") != version || j.at("run") != run_ || j.at("description") != description_)
                throw UsageError("checkpoint '" + file_.string() +
                                 "' is of another run; use the same version, pipeline, seed, start, settings "
                                 "and input files");
            for (const auto& value : kept_) value.read(j.at("kept").at(value.name), ledger.problem());
            recall(j, ledger);
            Taken snapshot;
            j.at("snapshot").get_to(snapshot);
            if (!j.at("answer").is_null()) j.at("answer").get_to(answer_.emplace());
            expect_valid(can_be_kept(ledger.problem(), snapshot) &&
                         (!answer_ || can_be_kept(ledger.problem(), *answer_)));
            return snapshot;
        } catch (const json::exception&) {
            throw UsageError("checkpoint '" + file_.string() + "' has other parts than a run writes" + advice);
        } catch (const Invalid&) {
            throw UsageError("checkpoint '" + file_.string() + "' has values that no run writes" + advice);
        }
    }
    std::optional<Population<Genome>> answer() const override { return answer_; }
    bool due(double seconds) const override { return seconds >= next_write_; }
    std::string trouble() const override {
        return trouble_ + (trouble_.empty() || unwritten_.empty() ? "" : "; ") + unwritten_;
    }

    void write(const Taken& snapshot, const Ledger<P>& ledger, const Population<Genome>* answer = nullptr) override {
        const Stopwatch clock;
        json j = {{"version", version},
                  {"run", run_},
                  {"description", description_},
                  {"snapshot", snapshot},
                  {"answer", answer ? json(*answer) : json()},
                  {"kept", json::object()}};
        for (const auto& value : kept_) j["kept"][value.name] = value.write();
        remember(j, snapshot, ledger);
        const std::vector<std::uint8_t> bytes = json::to_cbor(j);
        const std::string error = seal(file_, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        unwritten_ = error.empty() ? ""
                                   : "checkpoint '" + file_.string() + "' cannot be written (" + error +
                                         "); the run went on without it";
        next_write_ = snapshot.seconds + std::max(interval_, 20 * clock.seconds());
    }

  private:
    static constexpr int version = 6;

    struct StoredItem {
        std::string name;
        std::function<json()> write;
        std::function<void(const json&, const P&)> read;
    };

    struct Invalid {};
    static void expect_valid(bool valid) {
        if (!valid) throw Invalid{};
    }
    static constexpr const char* advice = "; use one that this version has written, or start again";

    static json stored(const typename Table<Evaluation<Outcome>>::Entry& entry) {
        if (const Outcome* outcome = std::get_if<Outcome>(&entry.value))
            return {entry.print.high, entry.print.low, *outcome};
        return {entry.print.high, entry.print.low, nullptr, *std::get<Reason>(entry.value)};
    }

    /// Both halves of the memory; evaluations of a stopped stage are stored separately.
    void remember(json& j, const Taken& snapshot, const Ledger<P>& ledger) const {
        if constexpr (Storable<Outcome>) {
            const auto list = [](const auto& table, std::size_t from, std::size_t to) {
                json entries = json::array();
                for (std::size_t i = from; i < to; ++i)
                    if (const auto& entry = table.entry(i); !std::holds_alternative<Pending>(entry.value))
                        entries.push_back(stored(entry));
                return entries;
            };
            const auto& [young, old] = std::tie(ledger.memory.young, ledger.memory.old);
            const std::size_t known = std::min(snapshot.remembered, young.size());
            j["memory"] = {list(old, 0, old.size()), list(young, 0, known), list(young, known, young.size()),
                           ledger.memory.room()};
        }
    }
    static void recall(const json& j, Ledger<P>& ledger) {
        if constexpr (Storable<Outcome>) {
            const auto evaluation = [&](const json& entry) -> Evaluation<Outcome> {
                if (entry.size() > 3) return reason(entry.at(3).get<std::string>());
                auto outcome = entry.at(2).get<Outcome>();
                if constexpr (ValidatesOutcomes<P>) expect_valid(ledger.problem().valid_outcome(outcome));
                return outcome;
            };
            const json& stored = j.at("memory"); // old, young, prepaid
            for (std::size_t part = 0; part < 3; ++part)
                for (const json& entry : stored.at(part)) {
                    Fingerprint print;
                    read_parts(entry, print.high, print.low);
                    if (part < 2)
                        (part == 0 ? ledger.memory.old : ledger.memory.young).at(print) = evaluation(entry);
                    else if (!ledger.memory.old.find(print))
                        ledger.prepay(print, evaluation(entry));
                }
            std::size_t room = 0;
            stored.at(3).get_to(room);
            ledger.memory.resume(room);
        }
    }

    std::filesystem::path file_;
    std::string description_, trouble_, unwritten_;
    bool resume_;
    double interval_;
    double next_write_ = 0;
    std::uint64_t run_ = 0;
    std::optional<Population<Genome>> answer_;
    std::vector<StoredItem> kept_;
};

} // namespace ga
