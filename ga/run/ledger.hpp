#pragma once

#include "ga/run/evaluator.hpp"

namespace ga {

/// A hash table of values by fingerprint. Entries stay in the order they were added, in blocks that never
/// move. The index is open-addressed with one byte per slot, so that a search without success reads little
/// memory. With std::unordered_map and std::deque a cheap evaluation took more than twice as long.
template <class Value>
class Table {
  public:
    /// The value of a fingerprint, or null if it is not in the table.
    Value* find(const Fingerprint& print) {
        const std::size_t slot = marks_.empty() ? 0 : slot_of(print);
        return marks_.empty() || marks_[slot] == 0 ? nullptr : &entry(numbers_[slot]).value;
    }
    /// The value of a fingerprint, added if it is missing.
    Value& at(const Fingerprint& print) {
        if (size_ == room_) grow();
        const std::size_t slot = slot_of(print);
        if (marks_[slot] != 0) return entry(numbers_[slot]).value;
        if (size_ == per_block * blocks_.size()) blocks_.push_back(std::make_unique<Entry[]>(per_block));
        marks_[slot] = mark(print);
        numbers_[slot] = static_cast<std::uint32_t>(size_);
        Entry& added = entry(size_++);
        added.print = print;
        added.value = {};
        return added.value;
    }
    /// Tells the processor to fetch the slot of a fingerprint that will soon be looked up.
    void prefetch(const Fingerprint& print) const {
        if (!marks_.empty()) __builtin_prefetch(&marks_[print.low & mask()]);
    }
    std::size_t size() const { return size_; } ///< number of entries
    /// Removes all entries. Their blocks are kept and filled again.
    void clear() {
        size_ = 0;
        std::ranges::fill(marks_, std::uint8_t{0});
    }

    /// A fingerprint and its value.
    struct Entry {
        Fingerprint print; ///< fingerprint of a genome
        Value value;       ///< value of the fingerprint
    };
    /// The i-th entry that was added.
    const Entry& entry(std::size_t i) const { return blocks_[i / per_block][i % per_block]; }

  private:
    static constexpr std::size_t per_block = 16;

    Entry& entry(std::size_t i) { return blocks_[i / per_block][i % per_block]; }
    /// The mark of a used slot; a free slot has the mark 0.
    static std::uint8_t mark(const Fingerprint& print) { return static_cast<std::uint8_t>(print.high | 1); }
    std::size_t mask() const { return marks_.size() - 1; }
    /// The slot of a fingerprint, or the free slot for it.
    std::size_t slot_of(const Fingerprint& print) const {
        for (std::size_t i = print.low & mask();; i = (i + 1) & mask())
            if (marks_[i] == 0 || (marks_[i] == mark(print) && entry(numbers_[i]).print == print)) return i;
    }
    /// Makes four times as many slots, of which at most half are used.
    void grow() {
        marks_.assign(std::max<std::size_t>(64, 4 * marks_.size()), 0);
        numbers_.resize(marks_.size());
        room_ = marks_.size() / 2;
        for (std::uint32_t number = 0; number < size_; ++number) {
            const std::size_t slot = slot_of(entry(number).print);
            marks_[slot] = mark(entry(number).print);
            numbers_[slot] = number;
        }
    }

    std::vector<std::unique_ptr<Entry[]>> blocks_; ///< filled in their order
    std::size_t size_ = 0;                         ///< number of entries
    std::vector<std::uint8_t> marks_;              ///< one per slot
    std::vector<std::uint32_t> numbers_;           ///< the entry in each used slot
    std::size_t room_ = 0;                         ///< number of entries at which the index must grow
};

/// Evaluations by fingerprint in bounded memory. When the young half is full, the old half is removed and the
/// young half becomes the old half. An evaluation that is read in the old half becomes young again. Only the
/// order of requests decides which evaluations are removed, and no result depends on it.
///
/// A large memory slows cheap evaluations down, so it grows only if it saves some: a half has room for 16,384
/// evaluations at first. The next half has twice the room if one in 1,024 was read in the old half, otherwise
/// half the room.
template <class Outcome>
class Memory {
  public:
    /// An empty memory.
    /// @param bytes  bound on the size, which only the current batch may exceed
    explicit Memory(std::size_t bytes) : half_(bytes / 2) {}
    std::size_t bytes() const { return 2 * half_; } ///< bound that was given, or one byte less

    /// One of the two halves.
    using Half = Table<Evaluation<Outcome>>;
    Half young; ///< the half that grows
    Half old;   ///< the half that is forgotten next

    /// The place of a genome's evaluation. It stays valid until `forget_old`.
    Evaluation<Outcome>& at(const Fingerprint& print) {
        Evaluation<Outcome>* known = old.find(print);
        if (!known || std::holds_alternative<Pending>(*known)) return young.at(print);
        Evaluation<Outcome>& place = young.at(print);
        if (std::holds_alternative<Pending>(place)) {
            place = *known;
            ++read_in_old_;
        }
        return place;
    }
    /// The evaluation, or null if it is not in memory.
    const Evaluation<Outcome>* find(const Fingerprint& print) {
        for (auto* half : {&young, &old})
            if (const auto* found = half->find(print); found && !std::holds_alternative<Pending>(*found)) return found;
        return nullptr;
    }
    /// Forgets the old half if the young one is full. Call it between batches.
    /// @param bytes_each  size of one evaluation
    void forget_old(std::size_t bytes_each) {
        if (young.size() * bytes_each <= half_ && young.size() < room_) return;
        constexpr std::size_t max_entries = std::size_t{1} << 31; // a slot's number has 32 bits
        const bool saves = 1024 * std::exchange(read_in_old_, 0) >= young.size();
        room_ = std::clamp(saves ? 2 * room_ : room_ / 2, first_room, max_entries);
        std::swap(old, young);
        young.clear();
    }

    std::size_t room() const { return room_; } ///< number of evaluations at which the young half is full
    /// Restores the room, and the reads in the old half from the content of both halves.
    void resume(std::size_t room) {
        room_ = std::clamp(room, first_room, std::size_t{1} << 31);
        for (std::size_t i = 0; i < young.size(); ++i)
            read_in_old_ += old.find(std::as_const(young).entry(i).print) != nullptr;
    }

  private:
    static constexpr std::size_t first_room = 1 << 14;

    std::size_t half_, room_ = first_room;
    std::size_t read_in_old_ = 0; ///< number of evaluations of the young half that were read in the old half
};

/// The individuals of a problem.
template <Problem P>
using PopulationOf = Population<typename P::Genome>;

/// Whether a stop request takes effect at once or after the current request.
enum class StopMode { at_once, after_request };

/// Outcomes of genomes and derivatives that are requested together.
template <Problem P>
struct EvaluationRequest {
    using Genome = typename P::Genome;   ///< genome of the problem
    using Outcome = typename P::Outcome; ///< outcome of an evaluation

    /// One requested outcome.
    struct OutcomeRequest {
        const Genome* genome;        ///< genome to evaluate; must outlive the answer
        bool counts = true;          ///< whether the request counts against the budget
        std::uint64_t replicate = 0; ///< number of the replicate of a noisy evaluation
        Level level = {};            ///< level of the evaluation
        Fingerprint print = {};      ///< fingerprint of the genome, set by the queue
        /// The answer, set by the queue; null or pending if the run had to end.
        const Evaluation<Outcome>* answer = nullptr;
        /// Whether there is an answer that is not pending.
        bool is_answered() const { return answer && !std::holds_alternative<Pending>(*answer); }
    };

    std::vector<std::size_t> generation;    ///< see EvaluationCall
    std::vector<OutcomeRequest> outcomes;   ///< requested outcomes, which are counted in this order
    std::vector<Slope<P>*> slopes;          ///< requests for derivatives
    double work = 0;                        ///< price of Work that is done, which always counts
    StopMode stop_mode = StopMode::at_once; ///< whether a stop request waits for the answers
    /// Reads the answers, which are valid until it returns. It is called on the queue's thread. It calls
    /// `fail` for each failure that it finds.
    std::function<void()> use = {};
    bool spent = false;            ///< whether the budget was too small for all outcomes; set by the queue
    std::exception_ptr error = {}; ///< Stopped, or the exception of `use`; set by the queue
    long failures = 0;             ///< counted evaluations that failed; set by `fail`
    std::string first_failure;     ///< reason of the first one; set by `fail`

    /// Records that an individual failed, for which `count` counted evaluations were requested.
    void fail(const Fitness& fitness, long count) {
        if (failures == 0) first_failure = fitness.reason();
        failures += count;
    }
};

/// Receives all requests for evaluations. The ledger is such a queue. A block that runs several threads puts
/// another queue before the ledger.
template <Problem P>
class EvaluationQueue {
  public:
    virtual ~EvaluationQueue() = default;
    /// Answers several requests together, in their order.
    virtual void serve(std::span<EvaluationRequest<P>* const> requests) = 0;
    /// Answers one request and throws its error.
    void serve(EvaluationRequest<P>& request) {
        EvaluationRequest<P>* const one[] = {&request};
        serve(std::span<EvaluationRequest<P>* const>(one));
        if (request.error) std::rethrow_exception(std::exchange(request.error, nullptr));
    }
};

/// Manages memory, budget and counts for an evaluator. Known outcomes are not evaluated again, and budgets
/// are exact to one call. Requests are answered in their order, whatever the number of threads.
template <Problem P>
class Ledger : public EvaluationQueue<P> {
  public:
    using Genome = typename P::Genome;   ///< genome of the problem
    using Outcome = typename P::Outcome; ///< the outcome of its evaluations
    using EvaluationQueue<P>::serve;

    /// The ledger of a run. The problem, the evaluator and the budget must outlive it. `memory_bytes` limits
    /// the memory and does not affect a result.
    Ledger(const P& problem, Evaluator<P>& evaluator, std::size_t memory_bytes, const Budget& budget)
        : memory(memory_bytes), problem_(problem), evaluator_(evaluator), budget_(budget), watch_(budget) {}

    void serve(std::span<EvaluationRequest<P>* const> requests) override {
        calls_.clear();
        slopes_.clear();
        for (EvaluationRequest<P>* request : requests) look_up(*request);
        evaluate(
            std::ranges::any_of(requests, [](const auto* each) { return each->stop_mode == StopMode::after_request; }));
        const bool cut_short = book();
        for (EvaluationRequest<P>* request : requests) answer(*request, cut_short);
        if (const long made = made_of_requested();
            made >= 200 && static_cast<double>(counters.failures) > budget_.max_failures * double(made))
            for (EvaluationRequest<P>* request : requests)
                if (!request->error) request->error = std::make_exception_ptr(Stopped{failure_text(), true});
    }

    /// The budget left after this further price, in evaluations of level 0; 0 or less if it is spent.
    double left_after(double price) const {
        return static_cast<double>(budget_.evaluations) - counters.requested_price - price;
    }

    const P& problem() const { return problem_; }          ///< the problem to evaluate
    Evaluator<P>& evaluator() const { return evaluator_; } ///< makes the calls
    const Budget& budget() const { return budget_; }       ///< limits of the run
    const Watch& watch() const { return watch_; }          ///< the time since the ledger was made
    /// The budget for a ledger that continues with this one's counters.
    Budget left() const {
        return {budget_.evaluations, budget_.seconds - watch_.seconds(), budget_.stop, budget_.max_failures};
    }

    Counters counters;             ///< evaluations that the run has spent so far
    Memory<Outcome> memory;        ///< known evaluations
    bool evaluator_failed = false; ///< whether the evaluator threw an exception

    /// Restores the size of the largest outcome of an earlier ledger.
    void resume(std::size_t heaviest) { heaviest_ = std::max(heaviest_, heaviest); }

    /// Keeps the memory within its bound. Called only between two stages: an interrupted stage is repeated,
    /// so its evaluations must stay distinct from earlier ones.
    void forget_old() { memory.forget_old(heaviest_ + bookkeeping); }
    std::size_t heaviest() const { return heaviest_; } ///< bytes of the largest outcome or failure message

    /// Whether every requested evaluation failed, and there was at least one.
    bool all_failed() const { return counters.failures > 0 && counters.failures >= made_of_requested(); }
    /// How many evaluations failed, and the reason of the first one in this process.
    std::string failure_text() const {
        const std::string made = std::to_string(made_of_requested());
        return (all_failed() ? "every one of " + made : std::to_string(counters.failures) + " of " + made) +
               " evaluations failed" + (first_failure_.empty() ? "" : "; the first: " + first_failure_);
    }

    /// Adds an evaluation that was made in a stage whose counts were lost. It is counted when it is requested.
    void prepay(const Fingerprint& print, Evaluation<Outcome> evaluation) {
        prepaid_.at(print) = std::move(evaluation);
    }

  private:
    static constexpr std::size_t bookkeeping = sizeof(Evaluation<Outcome>) + sizeof(Fingerprint) + 5 * sizeof(void*);

    /// Number of requested evaluations without derivatives.
    long made_of_requested() const { return counters.requested - counters.gradients; }

    /// Counts the requests, and adds a call for each unknown answer.
    void look_up(EvaluationRequest<P>& request) {
        std::size_t within = 0;
        const auto pay = [&](double price) {
            request.spent |= left_after(price) < 0;
            if (!request.spent) {
                ++counters.requested;
                counters.requested_price += price;
            }
            return !request.spent;
        };
        request.spent = false;
        request.failures = 0;
        counters.requested_price += request.work;
        counters.price += request.work;
        for (auto& wanted : request.outcomes) {
            if (wanted.counts && !pay(price_of(problem_, wanted.level).evaluation)) break;
            wanted.print = identify(problem_, *wanted.genome);
            if (wanted.replicate > 0)
                wanted.print = {fold(wanted.print.high, wanted.replicate), fold(wanted.print.low, wanted.replicate)};
            if (wanted.level != Level{}) {
                const auto level = ~static_cast<std::uint64_t>(wanted.level); // no number of a replicate
                wanted.print = {fold(wanted.print.high, level), fold(wanted.print.low, level)};
            }
            memory.young.prefetch(wanted.print);
            ++within;
        }
        for (std::size_t i = 0; i < within; ++i) {
            auto& wanted = request.outcomes[i];
            Evaluation<Outcome>& place = memory.at(wanted.print);
            wanted.answer = &place;
            auto* const pending = std::get_if<Pending>(&place);
            if (!pending || pending->queued) {
                ++counters.remembered;
            } else if (!take_prepaid(wanted.print, place, wanted.level)) {
                pending->queued = true;
                calls_.push_back({wanted.genome, &place, wanted.replicate, wanted.level, request.generation});
            }
        }
        for (Slope<P>* slope : request.slopes) {
            const double price = price_of(problem_, slope->level).gradient;
            if (!pay(price)) break;
            ++counters.gradients;
            counters.price += price;
            slopes_.push_back(slope);
        }
    }

    void evaluate(bool to_the_end) {
        static const Budget endless;
        static const Watch never(endless);
        try {
            if (!calls_.empty()) evaluator_.outcomes(problem_, calls_, to_the_end ? never : watch_);
            if (!slopes_.empty()) evaluator_.slopes(problem_, slopes_, watch_);
        } catch (...) {
            evaluator_failed = true;
            throw;
        }
    }

    /// Counts the evaluations that were made and resets pending ones; true if any is pending.
    bool book() {
        bool interrupted = false;
        for (const EvaluationCall<P>& call : calls_)
            if (Pending* pending = std::get_if<Pending>(call.answer)) {
                if (pending->why && !stop_reason_) stop_reason_ = *pending->why;
                *pending = Pending{};
                interrupted = true;
            } else {
                count(*call.answer, call.level);
            }
        return interrupted;
    }

    void answer(EvaluationRequest<P>& request, bool cut_short) {
        const bool open = cut_short && std::ranges::any_of(request.outcomes, [](const auto& wanted) {
                              return wanted.answer && !wanted.is_answered();
                          });
        try {
            if (request.use) request.use();
            if (open) throw Stopped{stop_reason_.value_or(watch_.reason())};
            if (request.spent) throw Stopped{"evaluation budget spent"};
        } catch (...) {
            request.error = std::current_exception();
        }
        if (first_failure_.empty() && request.failures > 0) first_failure_ = request.first_failure;
        counters.failures += request.failures;
    }

    bool take_prepaid(const Fingerprint& print, Evaluation<Outcome>& place, Level level) {
        Evaluation<Outcome>* paid = prepaid_.size() > 0 ? prepaid_.find(print) : nullptr;
        if (!paid || std::holds_alternative<Pending>(*paid)) return false;
        place = std::exchange(*paid, Pending{});
        count(place, level);
        return true;
    }
    void count(const Evaluation<Outcome>& evaluation, Level level) {
        ++counters.evaluations;
        counters.price += price_of(problem_, level).evaluation;
        const Outcome* outcome = std::get_if<Outcome>(&evaluation);
        heaviest_ = std::max(heaviest_, outcome ? weight(*outcome) : std::get<Reason>(evaluation)->size());
    }
    std::size_t weight(const Outcome& outcome) const {
        if constexpr (Weighed<P>)
            return problem_.bytes(outcome);
        else if constexpr (std::ranges::sized_range<Outcome>)
            return std::size_t(std::ranges::size(outcome)) * sizeof(std::ranges::range_value_t<Outcome>);
        else
            return 0;
    }

    const P& problem_;
    Evaluator<P>& evaluator_;
    Budget budget_;
    Watch watch_;
    Table<Evaluation<Outcome>> prepaid_;
    std::vector<EvaluationCall<P>> calls_;
    std::vector<Slope<P>*> slopes_;
    std::size_t heaviest_ = 0;
    std::optional<std::string> stop_reason_; ///< the reason with which the problem threw Stopped
    std::string first_failure_;
};

/// The fitness that an objective reads from an evaluation; failed if it is not finite or the evaluation failed.
template <Problem P>
Fitness fitness_of(const P& problem, const Evaluation<typename P::Outcome>& evaluation,
                   const Objective<typename P::Outcome>& objective, Name name) {
    if (const Reason* why = std::get_if<Reason>(&evaluation)) return Fitness::failed(name, *why);
    const auto& outcome = std::get<typename P::Outcome>(evaluation);
    try {
        const double value = objective.fitness(outcome);
        if (!std::isfinite(value))
            return Fitness::failed(name, reason("fitness " + objective.name + " is " + std::to_string(value)));
        const Fitness fitness(name, value, objective.minimise);
        if constexpr (!Constrained<P>) {
            return fitness;
        } else {
            std::vector<double> violations = violations_of(problem, outcome);
            for (const double each : violations)
                if (!(each < HUGE_VAL)) // minus infinity holds
                    return Fitness::failed(name, reason("a violation is " + std::to_string(each)));
            return fitness.constrained(std::move(violations));
        }
    } catch (...) {
        return Fitness::failed(name, reason_caught());
    }
}

} // namespace ga
