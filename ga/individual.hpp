#pragma once

#include "ga/errors.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace ga {

/// A name that is copied and compared as one pointer. Names live as long as the program: use it for the few
/// names a program has, never for data.
class Name {
  public:
    Name() = default;
    /// Enters the name where it is new. Safe to call from any thread.
    Name(const std::string& text) {
        static std::mutex guard;
        static std::set<std::string> names;
        const std::lock_guard lock(guard);
        text_ = &*names.insert(text).first;
    }
    const std::string& text() const { return *text_; } ///< as it was given; not for an empty name
    /// One pointer against another.
    bool operator==(const Name&) const = default;

  private:
    const std::string* text_ = nullptr;
};

/// Why an evaluation failed, shared by all individuals with that genome.
using Reason = std::shared_ptr<const std::string>;

/// How good an individual is, and by which objective. A fitness that was never given cannot be read; a failed
/// one keeps its reason, reads as minus infinity and so ranks last.
class Fitness {
  public:
    Fitness() = default;
    /// `value` under an objective, greater is better.
    Fitness(Name objective, double value) : value_(value), objective_(objective) {}
    /// Scored under `objective`, but without a value.
    static Fitness failed(Name objective, Reason reason) {
        Fitness fitness(objective, -std::numeric_limits<double>::infinity());
        fitness.reason_ = std::move(reason);
        return fitness;
    }

    bool known() const { return objective_ != Name(); } ///< whether it was scored at all
    /// Whether it was scored under this objective.
    bool known(Name objective) const { return objective_ == objective; }
    bool has_failed() const { return reason_ != nullptr; } ///< whether the evaluation failed

    /// Greater is better. Throws UsageError when unscored.
    double value() const {
        if (!known())
            throw UsageError("an individual's fitness was read before it was scored; expected score first");
        return value_;
    }
    /// Its name. Throws UsageError when unscored.
    const std::string& objective() const { return value(), objective_.text(); }
    Name objective_name() const { return objective_; } ///< empty when unscored
    /// Why the evaluation failed; empty when it did not.
    const std::string& reason() const {
        static const std::string none;
        return reason_ ? *reason_ : none;
    }

  private:
    double value_ = 0;
    Name objective_;
    Reason reason_;
};

/// A number that names an individual within a run, the same for any number of threads.
using Identity = std::uint64_t;

/// The identities an individual descends from: none, one or two.
class Parents {
  public:
    Parents() = default;
    /// Of a mutation.
    explicit Parents(Identity only) : identities_{only, 0}, count_(1) {}
    /// Of a cross-over.
    Parents(Identity first, Identity second) : identities_{first, second}, count_(2) {}
    const Identity* begin() const { return identities_.data(); } ///< the first
    const Identity* end() const { return begin() + count_; }     ///< behind the last
    std::size_t size() const { return count_; }                  ///< 0, 1 or 2
    /// The same, in the same order.
    bool operator==(const Parents&) const = default;

  private:
    std::array<Identity, 2> identities_{};
    std::size_t count_ = 0;
};

/// A genome on its way through the stages. Its identity stays when it is scored, refined or transformed; a
/// scored individual that is crossed or mutated begets another, which names it as a parent.
template <class G>
struct Individual {
    G genome{};                      ///< what is evolved
    Identity identity = 0;           ///< names it within the run
    Parents parents;                 ///< whom it was made of
    Fitness fitness;                 ///< unscored until a stage scores it
    std::shared_ptr<const G> origin; ///< the genome as it was when this identity was first refined, or none

    /// Its fitness' value. Throws UsageError when unscored.
    double value() const { return fitness.value(); }
};

/// Individuals in an order that stages may rely on.
template <class G>
using Population = std::vector<Individual<G>>;

/// Unscored individuals with identities 0, 1, ... in the order given.
template <class G>
Population<G> population(std::vector<G> genomes) {
    Population<G> individuals(genomes.size());
    for (std::size_t i = 0; i < genomes.size(); ++i) {
        individuals[i].genome = std::move(genomes[i]);
        individuals[i].identity = i;
    }
    return individuals;
}

} // namespace ga
