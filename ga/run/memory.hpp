#pragma once

#include "ga/problem/fingerprint.hpp"
#include "ga/problem/individual.hpp"

#include <memory>
#include <variant>

namespace ga {

/// An evaluation that was asked for and has not been made.
struct Pending {
    bool queued = false; ///< whether it is among the calls to be made
    Reason why = {};     ///< what the problem itself ended it with, where it did
};

/// What is known of an evaluation: nothing yet, its outcome, or why it failed.
template <class Outcome>
using Evaluation = std::variant<Pending, Outcome, Reason>;

/// Values by fingerprint: entries in the order they came, in blocks that never move, and an open-addressed
/// index whose slots are a byte each to look at, so that a look-up for what is not there touches little
/// memory. A std::unordered_map beside a
/// std::deque more than doubled the time of a cheap evaluation.
template <class Value>
class Table {
  public:
    /// Null when there is none.
    Value* find(const Fingerprint& print) {
        const std::size_t slot = marks_.empty() ? 0 : slot_of(print);
        return marks_.empty() || marks_[slot] == 0 ? nullptr : &entry(numbers_[slot]).value;
    }
    /// The value of a fingerprint, made where there is none.
    Value& at(const Fingerprint& print) {
        if (size_ == room_)
            grow();
        const std::size_t slot = slot_of(print);
        if (marks_[slot] != 0)
            return entry(numbers_[slot]).value;
        if (size_ % per_block == 0)
            blocks_.push_back(std::make_unique<Entry[]>(per_block));
        marks_[slot] = mark(print);
        numbers_[slot] = static_cast<std::uint32_t>(size_);
        Entry& added = entry(size_++);
        added.print = print;
        return added.value;
    }
    /// Lets the processor fetch where a fingerprint will be looked up soon.
    void prefetch(const Fingerprint& print) const {
        if (!marks_.empty())
            __builtin_prefetch(&marks_[print.low & mask()]);
    }
    std::size_t size() const { return size_; } ///< entries
    /// Forgets all.
    void clear() { *this = {}; }

    /// A fingerprint and what is kept under it.
    struct Entry {
        Fingerprint print; ///< of the genome
        Value value;       ///< what is known
    };
    /// The i-th that came.
    const Entry& entry(std::size_t i) const { return blocks_[i / per_block][i % per_block]; }

  private:
    static constexpr std::size_t per_block = 16;

    Entry& entry(std::size_t i) { return blocks_[i / per_block][i % per_block]; }
    /// Of a slot that is taken; 0 is that of a free one.
    static std::uint8_t mark(const Fingerprint& print) { return static_cast<std::uint8_t>(print.high | 1); }
    std::size_t mask() const { return marks_.size() - 1; }
    /// Where a fingerprint is, or the free slot where it would be.
    std::size_t slot_of(const Fingerprint& print) const {
        for (std::size_t i = print.low & mask();; i = (i + 1) & mask())
            if (marks_[i] == 0 || (marks_[i] == mark(print) && entry(numbers_[i]).print == print))
                return i;
    }
    /// To four times the slots, of which at most half are taken.
    void grow() {
        marks_.assign(std::max<std::size_t>(64, 4 * marks_.size()), 0);
        numbers_.resize(marks_.size());
        room_ = marks_.size() / 2;
        for (std::uint32_t number = 0; number < size_; ++number) {
            const Fingerprint& print = entry(number).print;
            std::size_t i = print.low & mask();
            while (marks_[i] != 0)
                i = (i + 1) & mask();
            marks_[i] = mark(print);
            numbers_[i] = number;
        }
    }

    std::vector<std::unique_ptr<Entry[]>> blocks_; ///< all full but the last
    std::size_t size_ = 0;                         ///< entries
    std::vector<std::uint8_t> marks_;              ///< of the slots
    std::vector<std::uint32_t> numbers_;           ///< of the entries in them
    std::size_t room_ = 0;                         ///< entries before the index must grow
};

/// Evaluations by fingerprint in bounded memory. Two halves: when the young half is full, the old half is
/// forgotten and the young becomes old; what is read in the old half turns young again. What is forgotten
/// depends only on the order of requests, and evaluations are pure, so forgetting costs time and never
/// changes a result.
template <class Outcome>
class Memory {
  public:
    /// @param bytes  at most this much is kept, but for the batch in hand
    explicit Memory(std::size_t bytes) : half_(bytes / 2) {}
    std::size_t bytes() const { return 2 * half_; } ///< as given, or one less

    /// The place of a genome's evaluation; stays valid until `forget_old`.
    Evaluation<Outcome>& at(const Fingerprint& print) {
        Evaluation<Outcome>* known = old_.find(print);
        if (!known || std::holds_alternative<Pending>(*known))
            return young_.at(print);
        Evaluation<Outcome>& place = young_.at(print);
        if (std::holds_alternative<Pending>(place))
            place = *known;
        return place;
    }
    /// Lets the processor fetch where a fingerprint will be looked up soon.
    void prefetch(const Fingerprint& print) const { young_.prefetch(print); }
    /// Null when it is not remembered.
    const Evaluation<Outcome>* find(const Fingerprint& print) {
        for (auto* half : {&young_, &old_})
            if (const auto* found = half->find(print); found && !std::holds_alternative<Pending>(*found))
                return found;
        return nullptr;
    }
    /// To be called between batches. @param bytes_each  what one evaluation takes
    void forget_old(std::size_t bytes_each) {
        if (young_.size() * bytes_each <= half_ && young_.size() < most)
            return;
        old_ = std::move(young_);
        young_.clear();
    }
    std::size_t size() const { return young_.size() + old_.size(); } ///< evaluations remembered

    /// One of the two halves.
    using Half = Table<Evaluation<Outcome>>;
    /// The half that grows, to read.
    const Half& young() const { return young_; }
    /// The half that is forgotten next, to read.
    const Half& old() const { return old_; }
    /// The half that grows.
    Half& young() { return young_; }
    /// The half that is forgotten next.
    Half& old() { return old_; }

  private:
    static constexpr std::size_t most = std::size_t{1}
                                        << 31; ///< entries that a slot can number, with room to spare
    std::size_t half_;
    Half young_, old_;
};

} // namespace ga
