#pragma once

#include "ga/problem/fingerprint.hpp"
#include "ga/problem/individual.hpp"

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
    /// Tells the processor to fetch the slot of a fingerprint that will soon be looked up.
    void prefetch(const Fingerprint& print) const {
        if (!marks_.empty())
            __builtin_prefetch(&marks_[print.low & mask()]);
    }
    std::size_t size() const { return size_; } ///< number of entries
    /// Removes all entries.
    void clear() { *this = {}; }

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
            if (marks_[i] == 0 || (marks_[i] == mark(print) && entry(numbers_[i]).print == print))
                return i;
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

    std::vector<std::unique_ptr<Entry[]>> blocks_; ///< all full, except the last
    std::size_t size_ = 0;                         ///< number of entries
    std::vector<std::uint8_t> marks_;              ///< one per slot
    std::vector<std::uint32_t> numbers_;           ///< the entry in each used slot
    std::size_t room_ = 0;                         ///< number of entries at which the index must grow
};

/// Evaluations by fingerprint in bounded memory. The memory has two halves, `young` and `old`. When the young
/// half is full, the old half is removed and the young half becomes the old half. An evaluation that is read
/// in the old half becomes young again. Only the order of requests decides which evaluations are removed. A
/// removed evaluation costs time but does not affect a result, because evaluations are pure.
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
        if (!known || std::holds_alternative<Pending>(*known))
            return young.at(print);
        Evaluation<Outcome>& place = young.at(print);
        if (std::holds_alternative<Pending>(place))
            place = *known;
        return place;
    }
    /// The evaluation, or null if it is not in memory.
    const Evaluation<Outcome>* find(const Fingerprint& print) {
        for (auto* half : {&young, &old})
            if (const auto* found = half->find(print); found && !std::holds_alternative<Pending>(*found))
                return found;
        return nullptr;
    }
    /// Forgets the old half if the young one is full. Call it between batches.
    /// @param bytes_each  size of one evaluation
    void forget_old(std::size_t bytes_each) {
        constexpr std::size_t max_entries = std::size_t{1} << 31; // a slot's number has 32 bits
        if (young.size() * bytes_each <= half_ && young.size() < max_entries)
            return;
        old = std::move(young);
        young.clear();
    }

  private:
    std::size_t half_;
};

} // namespace ga
