#pragma once

#include "ga/base/budget.hpp"
#include "ga/base/parallel.hpp"
#include "ga/problem/individual.hpp"
#include "ga/problem/problem.hpp"

#include <span>
#include <variant>

namespace ga {

/// An evaluation that was requested and has not been made.
struct Pending {
    bool queued = false; ///< whether the evaluation is among the calls to be made
    Reason why = {};     ///< why the problem itself stopped the evaluation, if it did
};

/// An evaluation: pending, its outcome, or the reason of its failure.
template <class Outcome>
using Evaluation = std::variant<Pending, Outcome, Reason>;

/// One call of `evaluate`: a genome, and the place for the outcome or the reason of a failure.
template <Problem P>
struct EvaluationCall {
    const typename P::Genome* genome;        ///< genome to evaluate
    Evaluation<typename P::Outcome>* answer; ///< place for the result; unchanged if the run must end first
    std::uint64_t replicate = 0;             ///< number of the replicate of a noisy evaluation
    Level level = {};                        ///< level of the evaluation
    /// Generation of each enclosing `repeat` of the stage that asks, outermost first, from 0.
    std::span<const std::size_t> generation = {};
};

/// One request for a derivative: of residuals (for a problem with `sensitivity`) or of the fitness (with
/// `gradient`). The answer is one of the last three members.
template <Problem P>
struct Slope {
    typename P::Genome genome;                           ///< genome at which the derivative is computed
    Name objective;                                      ///< name of the objective
    Level level = {};                                    ///< level of evaluation that the objective reads
    bool of_residuals = true;                            ///< true: of the residuals; false: of the fitness
    std::shared_ptr<const Sensitivity> sensitivity = {}; ///< residuals and their derivatives
    std::vector<double> gradient = {};                   ///< derivative of the fitness, one per gene
    Reason failure = {};                                 ///< why the derivative is missing
};

/// The outcome of `evaluate`, or the reason of its failure; pending if the problem threw Stopped.
template <Problem P>
Evaluation<typename P::Outcome> evaluated(const P& problem, const typename P::Genome& genome,
                                          std::uint64_t replicate = 0, Level level = {}) {
    try {
        if constexpr (Levelled<P>)
            if (level != Level{}) return problem.evaluate(genome, level);
        if constexpr (Noisy<P>)
            if (replicate > 0) return problem.evaluate(genome, replicate);
        return problem.evaluate(genome);
    } catch (const Stopped& stop) {
        return Pending{.why = reason(stop.reason)};
    } catch (...) {
        return reason_caught();
    }
}
/// Answers a request for a derivative by the problem's member. Derivatives of a wrong number or that are not
/// finite are a failure.
template <Problem P>
void differentiate(const P& problem, Slope<P>& slope) {
    try {
        if constexpr (Sensitive<P>)
            if (slope.of_residuals) {
                auto found = problem.sensitivity(slope.genome, slope.objective.text());
                const auto& r = found.residuals;
                const auto& j = found.jacobian;
                const auto genes = static_cast<std::ptrdiff_t>(genes_of(problem, slope.genome).size());
                if (r.size() == 0 || j.rows() != r.size() || j.cols() != genes)
                    slope.failure =
                        reason("a matrix of " + std::to_string(j.rows()) + " x " + std::to_string(j.cols()) + " for " +
                               std::to_string(r.size()) + " residuals of " + std::to_string(genes) + " genes");
                else if (!r.allFinite() || !j.allFinite())
                    slope.failure = reason("a residual or derivative is not finite");
                else
                    slope.sensitivity = std::make_shared<const decltype(found)>(std::move(found));
            }
        if constexpr (Differentiable<P>)
            if (!slope.of_residuals) {
                auto found = problem.gradient(slope.genome, slope.objective.text());
                const std::size_t genes = genes_of(problem, slope.genome).size();
                if (found.size() != genes)
                    slope.failure =
                        reason(std::to_string(found.size()) + " derivatives for " + std::to_string(genes) + " genes");
                else if (!std::ranges::all_of(found, [](double each) { return std::isfinite(each); }))
                    slope.failure = reason("a derivative is not finite");
                else
                    slope.gradient = std::move(found);
            }
    } catch (const Stopped& stop) {
        slope.failure = reason(stop.reason);
    } catch (...) {
        slope.failure = reason_caught();
    }
}

/// Makes the calls that are not answered from memory. Derive from this class to evaluate in other processes,
/// on other machines or with a surrogate. The engine calls it from one thread at a time. Answers must not
/// depend on the order of the calls.
template <Problem P>
class Evaluator {
  public:
    virtual ~Evaluator() = default;
    /// Answers the calls that begin before the watch expires.
    virtual void outcomes(const P& problem, std::span<EvaluationCall<P>> calls, const Watch& watch) = 0;
    /// Answers requests for derivatives.
    virtual void slopes(const P& problem, std::span<Slope<P>* const> slopes, const Watch&) {
        for (Slope<P>* slope : slopes) differentiate(problem, *slope);
    }
    virtual int threads() const { return 1; } ///< number of threads for work other than evaluations
};

/// Distributes the calls over threads, each of which takes the next calls. The calling thread alone makes the
/// calls of a short batch if this was faster before. Measured times do not affect an answer.
template <Problem P>
class OnThreads : public Evaluator<P> {
  public:
    /// @param threads  number of threads; 0 for OpenMP's default
    explicit OnThreads(int threads) : threads_(thread_count(threads)) {}

    void outcomes(const P& problem, std::span<EvaluationCall<P>> calls, const Watch& watch) override {
        const auto make = [&](const EvaluationCall<P>& call) {
            if (!watch.expired()) *call.answer = evaluated(problem, *call.genome, call.replicate, call.level);
        };
        const auto n = static_cast<double>(calls.size());
        const double limit = std::max(5e-3, 2 * n * one_call_); // s, for calls by this thread alone
        const bool tries_other = ++batches_ % 1024 == 0;
        std::size_t alone = 0;
        const Stopwatch clock;
        if (threads_ == 1 || (n * one_call_ < long_batch && (by_one_ <= by_all_) != tries_other))
            while (alone < calls.size() &&
                   (threads_ == 1 || (alone % 16 != 0 && !std::has_single_bit(alone)) || clock.seconds() <= limit))
                make(calls[alone++]);
        if (alone > 0) {
            one_call_ = clock.seconds() / static_cast<double>(alone);
            if (alone == calls.size()) add(by_one_, one_call_);
        }
        const auto others = calls.subspan(alone);
        const double in_five_us = std::clamp(5e-6 / one_call_, 1.0, 1 + n / (8 * threads_));
        parallel_for(
            others.size(), threads_,
            [&](std::size_t i) {
                const Stopwatch one;
                make(others[i]);
                if (i == 0) one_call_ = one.seconds();
            },
            static_cast<std::size_t>(in_five_us));
        if (alone == 0 && !others.empty()) add(by_all_, clock.seconds() / n);
    }
    void slopes(const P& problem, std::span<Slope<P>* const> slopes, const Watch&) override {
        parallel_for(slopes.size(), threads_, [&](std::size_t i) { differentiate(problem, *slopes[i]); });
    }
    int threads() const override { return threads_; }

  private:
    /// Adds a time to a running mean, because other programs make single times long.
    static void add(double& mean, double seconds) {
        mean = mean > 0 && mean < HUGE_VAL ? mean + (seconds - mean) / 16 : seconds;
    }

    int threads_;
    static constexpr double long_batch = 1e-2; ///< time after which all threads are used, s
    double one_call_ = HUGE_VAL;               ///< time of one call in the last batch, s
    double by_all_ = HUGE_VAL;                 ///< mean time per call if all threads are used, s
    double by_one_ = 0;                        ///< mean time per call if one thread is used, s
    std::size_t batches_ = 0;
};

} // namespace ga
