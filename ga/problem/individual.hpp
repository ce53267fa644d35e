#pragma once

#include "ga/base/errors.hpp"
#include "ga/problem/ranking.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
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
/// The reason of these words.
inline Reason reason(std::string words) { return std::make_shared<const std::string>(std::move(words)); }
/// The reason that the exception in hand gives, whatever was thrown; Stopped, which is no failure, goes on.
/// To be called where one is caught.
[[gnu::cold]] inline Reason reason_caught() {
    try {
        throw;
    } catch (const Stopped&) {
        throw;
    } catch (const std::exception& error) {
        return reason(error.what());
    } catch (...) {
        return reason("an exception that is no std::exception");
    }
}

/// How good an individual is, and by which policy: the name of one objective, or "pareto f1 f2 ..." for
/// several at once. It has the objectives' values, by how much constraints are violated, or why the
/// evaluation failed. A fitness that was never given cannot be read, and two of different policies are never
/// compared.
class Fitness {
  public:
    Fitness() = default;
    /// `value` under one objective, as the objective states it.
    Fitness(Name objective, double value, bool minimise = false, double violation = 0)
        : value_(value), policy_(objective), minimise_(minimise) {
        if (violation > 0)
            *this = constrained({violation});
    }
    /// Under several objectives at once; `values` are turned so that greater is better.
    Fitness(Name policy, Point values, double violation = 0)
        : policy_(policy), detail_(std::make_shared<const Detail>(Detail{std::move(values), nullptr, {}})) {
        if (violation > 0)
            *this = constrained({violation});
    }
    /// Scored under a policy, but without a value.
    static Fitness failed(Name policy, Reason why) {
        Fitness fitness(policy, -std::numeric_limits<double>::infinity());
        fitness.detail_ = std::make_shared<const Detail>(Detail{{}, std::move(why), {}});
        return fitness;
    }
    /// The same under constraints that are violated by so much each; 0 or less if one holds. `sum` is what
    /// exceeds their levels, if it was computed before.
    Fitness constrained(std::vector<double> violations, std::optional<double> sum = {}) const {
        Fitness fitness = *this;
        if (std::any_of(violations.begin(), violations.end(), [](double each) { return each > 0; })) {
            for (double& each : violations)
                each = std::max(each, 0.0);
            fitness.detail_ = std::make_shared<const Detail>(
                Detail{several() ? detail_->values : Point(), nullptr, std::move(violations)});
        }
        fitness = fitness.relaxed({});
        fitness.violation_ = sum.value_or(fitness.violation_);
        return fitness;
    }
    /// The same as the mean of so many replicates.
    Fitness averaged(std::size_t replicates) const {
        Fitness fitness = *this;
        fitness.replicates_ = static_cast<std::uint32_t>(replicates);
        return fitness;
    }
    /// The same if each constraint counts as held up to its level; levels that are not given are 0.
    Fitness relaxed(const std::vector<double>& levels) const {
        Fitness fitness = *this;
        fitness.violation_ = 0;
        for (std::size_t k = 0; k < violations().size(); ++k)
            fitness.violation_ += std::max(0.0, violations()[k] - (k < levels.size() ? levels[k] : 0));
        return fitness;
    }

    bool known() const { return policy_ != Name(); } ///< whether it was scored at all
    /// Whether it was scored under this policy.
    bool known(Name policy) const { return policy_ == policy; }
    bool has_failed() const { return detail_ && detail_->failure; }      ///< whether the evaluation failed
    bool several() const { return detail_ && !detail_->values.empty(); } ///< under several objectives
    bool feasible() const { return !(violation_ > 0); }                  ///< no constraint is violated
    /// Sum over the constraints, beyond the levels up to which they count as held; 0 or more.
    double violation() const { return violation_; }
    /// Of each constraint, 0 or more, whatever its level; empty if all hold.
    const std::vector<double>& violations() const {
        static const std::vector<double> none;
        return detail_ ? detail_->violations : none;
    }
    bool minimises() const { return minimise_; }           ///< whether less is better
    std::size_t replicates() const { return replicates_; } ///< of which it is the mean, 1 or more

    /// Under one objective, as the objective states it; minus infinity when the evaluation failed. Throws
    /// UsageError when unscored, or scored under several objectives.
    double value() const {
        need(true);
        return value_;
    }
    /// The same turned so that greater is better.
    double merit() const {
        need(true);
        return minimise_ ? -value_ : value_;
    }
    /// Under several objectives, each turned so that greater is better; empty under one, or failed.
    const Point& values() const {
        static const Point none;
        need(false);
        return detail_ ? detail_->values : none;
    }
    /// Name of the policy. Throws UsageError when unscored.
    const std::string& objective() const { return need(false), policy_.text(); }
    Name objective_name() const { return policy_; } ///< empty when unscored
    /// Why the evaluation failed; empty when it did not.
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
        if (!known() || (one && several()))
            refuse();
    }
    [[gnu::cold, gnu::noinline]] void refuse() const {
        throw UsageError(known()
                             ? "fitness under '" + policy_.text() + "' is no single number"
                             : "an individual's fitness was read before it was scored; expected score first");
    }

    double value_ = 0, violation_ = 0;
    Name policy_;
    std::shared_ptr<const Detail> detail_;
    std::uint32_t replicates_ = 1;
    bool minimise_ = false;
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

    /// Its fitness' value under one objective. Throws UsageError when unscored.
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
