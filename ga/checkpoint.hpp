#pragma once

#include "ga/run.hpp"
#include "ga/variation/permutation.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace ga {

using nlohmann::json;

///@{
/// What checkpoints hold, and back without loss: a failure keeps its reason. Reading throws
/// nlohmann's exceptions on anything else.
inline void to_json(json& j, const Permutation& permutation) { j = permutation.order; }
inline void from_json(const json& j, Permutation& permutation) { j.get_to(permutation.order); }

inline void to_json(json& j, const Counters& c) {
    j = {c.asked, c.evaluations, c.remembered, c.gradients, c.failures, c.given_up};
}
inline void from_json(const json& j, Counters& c) {
    c = {j.at(0), j.at(1), j.at(2), j.at(3), j.at(4), j.at(5)};
}

template <class G>
void to_json(json& j, const Individual<G>& individual) {
    const Fitness& fitness = individual.fitness;
    j = {individual.genome,
         individual.identity,
         std::vector<Identity>(individual.parents.begin(), individual.parents.end()),
         fitness.known() ? json(fitness.objective()) : json(),
         fitness.known() ? fitness.value() : 0.0,
         fitness.has_failed() ? json(fitness.reason()) : json(),
         individual.origin ? json(*individual.origin) : json()};
}
template <class G>
void from_json(const json& j, Individual<G>& individual) {
    j.at(0).get_to(individual.genome);
    j.at(1).get_to(individual.identity);
    const auto parents = j.at(2).get<std::vector<Identity>>();
    individual.parents = parents.size() == 2   ? Parents(parents[0], parents[1])
                         : parents.size() == 1 ? Parents(parents[0])
                                               : Parents();
    individual.fitness = {};
    if (!j.at(3).is_null()) {
        const Name objective(j.at(3).get<std::string>());
        individual.fitness = j.at(5).is_null()
                                 ? Fitness(objective, j.at(4))
                                 : Fitness::failed(objective, std::make_shared<const std::string>(j.at(5)));
    }
    individual.origin.reset();
    if (!j.at(6).is_null())
        individual.origin = std::make_shared<const G>(j.at(6).get<G>());
}

template <class G>
void to_json(json& j, const Frame<G>& frame) {
    j = {frame.next, frame.population, frame.kept, frame.numbers};
}
template <class G>
void from_json(const json& j, Frame<G>& frame) {
    j.at(0).get_to(frame.next);
    j.at(1).get_to(frame.population);
    j.at(2).get_to(frame.kept);
    j.at(3).get_to(frame.numbers);
}

template <class G>
void to_json(json& j, const Snapshot<G>& snapshot) {
    j = {snapshot.frames,        snapshot.counters,
         snapshot.next_identity, snapshot.best ? json(*snapshot.best) : json(),
         snapshot.notes,         snapshot.seconds};
}
template <class G>
void from_json(const json& j, Snapshot<G>& snapshot) {
    j.at(0).get_to(snapshot.frames);
    j.at(1).get_to(snapshot.counters);
    j.at(2).get_to(snapshot.next_identity);
    if (!j.at(3).is_null())
        snapshot.best = j.at(3).get<Individual<G>>();
    j.at(4).get_to(snapshot.notes);
    j.at(5).get_to(snapshot.seconds);
}
///@}

/// Outcomes that a checkpoint can hold; others are evaluated again where they are asked for after it, which
/// changes the count of evaluations and no result.
template <class Outcome>
concept Storable = requires(const json& j, const Outcome& outcome) {
    json(outcome);
    { j.get<Outcome>() } -> std::same_as<Outcome>;
};

/// Keeps a run in one file, replaced as a whole by renaming: between stages, at most once in so many seconds
/// and for at most a twentieth of the time, and at the end. A run that is resumed from it, after whatever end
/// of its process, reaches the very result of one that was never interrupted. Genomes must convert to and
/// from nlohmann::json without loss.
template <Problem P>
class Checkpoints : public Keeper<P> {
  public:
    using Genome = typename P::Genome;   ///< kept as json
    using Outcome = typename P::Outcome; ///< kept where it converts to json

    /// @param file         where the run is kept
    /// @param description  whatever else decides the result (the problem's settings); a file with another
    ///                     is refused
    /// @param resume       go on from the file if there is one; otherwise it is replaced
    /// @param interval     seconds between two writes
    Checkpoints(std::filesystem::path file, std::string description, bool resume, double interval = 1)
        : file_(std::move(file)), description_(std::move(description)), resume_(resume), interval_(interval) {
    }

    /// Keeps a value of an observer with the run: it is written with every checkpoint and read back when the
    /// run is resumed, before its first stage. The value must live as long as the run.
    template <class T>
    void keep(const std::string& name, T& value) {
        kept_.push_back(
            {name, [&value] { return json(value); }, [&value](const json& j) { value = j.get<T>(); }});
    }

    std::optional<Population<Genome>> begin(Context<P>& context, std::uint64_t run) override {
        run_ = run;
        if (!resume_ || !std::filesystem::exists(file_))
            return std::nullopt;
        try {
            std::ifstream stream(file_, std::ios::binary);
            const json j = json::from_cbor(stream);
            if (j.at("version") != version || j.at("run") != run_ || j.at("description") != description_)
                throw UsageError("checkpoint '" + file_.string() +
                                 "' is of another run; expected the same pipeline, seed, start and settings");
            for (const auto& value : kept_)
                value.read(j.at("kept").at(value.name));
            recall(j, context.evaluator());
            context.resume(j.at("snapshot").get<Snapshot<Genome>>());
            if (j.at("answer").is_null())
                return std::nullopt;
            return j.at("answer").get<Population<Genome>>();
        } catch (const json::exception& error) {
            throw UsageError("checkpoint '" + file_.string() + "' cannot be read: " + error.what());
        }
    }

    void pause(const Context<P>& context) override {
        const double now = context.seconds();
        if (now < next_write_)
            return;
        write(context.snapshot(), context.evaluator(), {});
        const double took = context.seconds() - now;
        next_write_ = now + std::max(interval_, 20 * took);
    }
    void stop(const Snapshot<Genome>& snapshot, const Evaluator<P>& evaluator) override {
        write(snapshot, evaluator, {});
    }
    void finish(const Context<P>& context, const Population<Genome>& answer) override {
        write(context.snapshot(), context.evaluator(), answer);
    }

  private:
    static constexpr int version = 1;

    struct Kept {
        std::string name;
        std::function<json()> write;
        std::function<void(const json&)> read;
    };

    void write(const Snapshot<Genome>& snapshot, const Evaluator<P>& evaluator, const json& answer) const {
        json j = {{"version", version},   {"run", run_},      {"description", description_},
                  {"snapshot", snapshot}, {"answer", answer}, {"kept", json::object()}};
        for (const auto& value : kept_)
            j["kept"][value.name] = value.write();
        remember(j, snapshot, evaluator);
        const std::filesystem::path temporary = file_.string() + ".tmp";
        {
            std::ofstream stream(temporary, std::ios::binary);
            json::to_cbor(j, stream);
            stream.flush();
            if (!stream)
                throw UsageError("checkpoint '" + temporary.string() + "' cannot be written");
        }
        std::filesystem::rename(temporary, file_);
    }

    static json stored(const typename Table<Evaluation<Outcome>>::Entry& entry) {
        if (const Outcome* outcome = std::get_if<Outcome>(&entry.value))
            return {entry.print.high, entry.print.low, *outcome};
        return {entry.print.high, entry.print.low, nullptr, *std::get<Reason>(entry.value)};
    }

    /// Both halves of the memory; what a stopped stage had evaluated already is set apart.
    void remember(json& j, const Snapshot<Genome>& snapshot, const Evaluator<P>& evaluator) const {
        if constexpr (Storable<Outcome>) {
            json old = json::array(), young = json::array(), prepaid = json::array();
            for (const auto& entry : evaluator.memory().old().entries())
                old.push_back(stored(entry));
            std::size_t count = 0;
            for (const auto& entry : evaluator.memory().young().entries())
                if (const bool known = count++ < snapshot.remembered;
                    !std::holds_alternative<Pending>(entry.value))
                    (known ? young : prepaid).push_back(stored(entry));
            j["memory"] = {std::move(old), std::move(young), std::move(prepaid)};
        }
    }
    static void recall(const json& j, Evaluator<P>& evaluator) {
        if constexpr (Storable<Outcome>) {
            const auto each = [](const json& list, auto take) {
                for (const json& entry : list) {
                    const Fingerprint print{entry.at(0), entry.at(1)};
                    if (entry.size() == 3)
                        take(print, Evaluation<Outcome>(entry.at(2).get<Outcome>()));
                    else
                        take(print, Evaluation<Outcome>(std::make_shared<const std::string>(entry.at(3))));
                }
            };
            auto& memory = evaluator.memory();
            const auto into = [](auto& half) {
                return [&half](const Fingerprint& print, auto evaluation) {
                    half.at(print) = std::move(evaluation);
                };
            };
            each(j.at("memory").at(0), into(memory.old()));
            each(j.at("memory").at(1), into(memory.young()));
            each(j.at("memory").at(2), [&](const Fingerprint& print, auto evaluation) {
                if (!memory.old().find(print))
                    evaluator.prepay(print, std::move(evaluation));
            });
        }
    }

    std::filesystem::path file_;
    std::string description_;
    bool resume_;
    double interval_;
    double next_write_ = 0;
    std::uint64_t run_ = 0;
    std::vector<Kept> kept_;
};

} // namespace ga
