#pragma once

#include "ga/base/errors.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace ga {

/// A name that is copied and compared as one pointer. Names are never freed, so do not use it for data.
class Name {
  public:
    Name() = default;
    /// The name of this text. Stores the text if it is new. Any thread may call it.
    Name(const std::string& text);
    const std::string& text() const { return *text_; } ///< the text; not for an empty name
    /// Whether both names are equal.
    bool operator==(const Name&) const = default;

  private:
    const std::string* text_ = nullptr;
};

/// The reason why the evaluation of a genome failed; shared by all individuals with this genome.
using Reason = std::shared_ptr<const std::string>;
/// Makes a reason from a text.
inline Reason reason(std::string words) { return std::make_shared<const std::string>(std::move(words)); }
/// The reason from the exception that is being handled. Call it in a catch block. Stopped is not a failure
/// and is thrown again.
Reason reason_caught();

/// Values of several objectives, higher is better.
using Point = std::vector<double>;

/// The fitness of an individual under a policy: the name of one objective, or "pareto f1 f2 ..." for several.
/// It has the values of the objectives and the violations of constraints, or the reason of a failure. A
/// missing fitness cannot be read, and fitnesses of different policies are never compared.
class Fitness {
  public:
    Fitness() = default;
    /// The value under one objective, which is maximised or minimised.
    Fitness(Name objective, double value, bool minimise = false)
        : value_(value), policy_(objective), minimise_(minimise) {}
    /// The values under several objectives, with higher being better.
    Fitness(Name policy, Point values)
        : policy_(policy), detail_(std::make_shared<const Detail>(Detail{std::move(values), nullptr, {}})) {}
    /// A failed evaluation under a policy. Its violation is infinite.
    static Fitness failed(Name policy, Reason why);
    /// A copy with one violation per constraint, 0 or less if the constraint holds. `sum` is the sum of the
    /// violations beyond the levels, if it was computed before.
    Fitness constrained(std::vector<double> violations, std::optional<double> sum = {}) const;
    /// A copy that is the mean of a number of replicates.
    Fitness averaged(std::size_t replicates) const {
        Fitness fitness = *this;
        fitness.replicates_ = static_cast<std::uint32_t>(replicates);
        return fitness;
    }
    /// A copy in which each constraint holds up to its level; missing levels are 0.
    Fitness relaxed(const std::vector<double>& levels) const;

    bool known() const { return policy_ != Name(); } ///< whether the individual was scored under any policy
    /// Whether the individual was scored under this policy.
    bool known(Name policy) const { return policy_ == policy; }
    bool has_failed() const { return detail_ && detail_->failure; } ///< whether the evaluation failed
    /// Whether it has several objectives.
    bool several() const { return detail_ && !detail_->values.empty(); }
    /// Whether the evaluation succeeded and all constraints hold.
    bool feasible() const { return !(violation_ > 0); }
    /// The sum of violations beyond the constraints' levels, 0 or more; infinite if the evaluation failed.
    double violation() const { return violation_; }
    /// The violation of each constraint, 0 or more, without regard to levels; empty if all constraints hold.
    const std::vector<double>& violations() const {
        static const std::vector<double> none;
        return detail_ ? detail_->violations : none;
    }
    /// Sets the levels of evaluation whose outcomes were requested for the individual, one bit each.
    void set_levels(std::uint8_t levels) { levels_ = levels; }
    /// The levels of evaluation whose outcomes were requested for the individual, one bit each.
    std::uint8_t levels() const { return levels_; }
    bool minimises() const { return minimise_; }           ///< whether a lower value is better
    std::size_t replicates() const { return replicates_; } ///< number of replicates in the mean, 1 or more

    /// Whether it has the value of one objective: it was scored under one, and the evaluation succeeded.
    bool has_value() const { return known() && !has_failed() && !several(); }
    /// The value under one objective; minus infinity if the evaluation failed. Throws UsageError if the
    /// individual is unscored or scored under several objectives.
    double value() const {
        need(true);
        return value_;
    }
    /// The value, with its sign changed if the objective is minimised.
    double merit() const {
        need(true);
        return minimise_ ? -value_ : value_;
    }
    /// The values under several objectives, with higher being better; empty under one objective or after a failure.
    const Point& values() const {
        static const Point none;
        need(false);
        return detail_ ? detail_->values : none;
    }
    /// The name of the policy. Throws UsageError if the individual is unscored.
    const std::string& objective() const { return need(false), policy_.text(); }
    Name objective_name() const { return policy_; } ///< name of the policy; empty if unscored
    /// Why the evaluation failed; empty if it did not.
    const std::string& reason() const {
        static const std::string none;
        return has_failed() ? *detail_->failure : none;
    }

  private:
    struct Detail {
        Point values;
        Reason failure;
        std::vector<double> violations;
    };

    void need(bool one) const {
        if (!known() || (one && several())) refuse();
    }
    void refuse() const;

    double value_ = 0, violation_ = 0;
    Name policy_;
    std::shared_ptr<const Detail> detail_;
    std::uint32_t replicates_ = 1;
    std::uint8_t levels_ = 0;
    bool minimise_ = false;
};

/// A number that names an individual within a run, the same for any number of threads.
using Identity = std::uint64_t;

/// The identities of an individual's parents: none, one or two.
class Parents {
  public:
    Parents() = default;
    /// The parent of a mutant.
    explicit Parents(Identity only) : identities_{only, 0}, count_(1) {}
    /// The parents of a cross-over.
    Parents(Identity first, Identity second) : identities_{first, second}, count_(2) {}
    const Identity* begin() const { return identities_.data(); } ///< the first parent
    const Identity* end() const { return begin() + count_; }     ///< past the last parent
    std::size_t size() const { return count_; }                  ///< number of parents: 0, 1 or 2
    /// Whether the parents are equal, in the same order.
    bool operator==(const Parents&) const = default;

  private:
    std::array<Identity, 2> identities_{};
    std::size_t count_ = 0;
};

/// A genome with its identity and fitness. The identity stays when it is scored, refined or transformed.
/// Cross-over, or mutation after scoring, makes a new individual with this one as a parent.
template <class G>
struct Individual {
    G genome{};                      ///< the genome
    Identity identity = 0;           ///< number of the individual, unique in the run
    Parents parents;                 ///< identities of the parents
    Fitness fitness;                 ///< empty until a stage scores it
    std::shared_ptr<const G> origin; ///< the genome before the first refinement, or null

    /// The fitness under one objective. Throws UsageError if the individual is unscored.
    double value() const { return fitness.value(); }
};

/// A list of individuals; stages may rely on their order.
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
