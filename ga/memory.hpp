#pragma once

#include "ga/fingerprint.hpp"
#include "ga/individual.hpp"

#include <unordered_map>
#include <variant>

namespace ga {

/// An evaluation that was asked for and has not been made.
struct Pending {
    bool queued = false;
};

/// What is known of an evaluation: nothing yet, its outcome, or why it failed.
template <class Outcome>
using Evaluation = std::variant<Pending, Outcome, Reason>;

/// Evaluations by fingerprint in bounded memory. Two halves: when the young half is full, the old half is
/// forgotten and the young becomes old; what is read in the old half turns young again. What is forgotten
/// depends only on the order of requests, and evaluations are pure, so forgetting costs time and never
/// changes a result.
template <class Outcome>
class Memory {
  public:
    /// @param bytes  at most this much is kept, but for the batch in hand
    explicit Memory(std::size_t bytes) : half_(bytes / 2) {}

    /// The place of a genome's evaluation; stays valid until `forget_old` or `erase`.
    Evaluation<Outcome>& at(const Fingerprint& print) {
        if (!old_.empty())
            if (auto node = old_.extract(print))
                return young_.insert(std::move(node)).position->second;
        return young_[print];
    }
    const Evaluation<Outcome>* find(const Fingerprint& print) const {
        for (const auto* half : {&young_, &old_})
            if (const auto found = half->find(print); found != half->end())
                return &found->second;
        return nullptr;
    }
    void erase(const Fingerprint& print) { young_.erase(print); }
    /// To be called between batches. @param bytes_each  what one evaluation takes
    void forget_old(std::size_t bytes_each) {
        if (young_.size() * bytes_each <= half_)
            return;
        old_ = std::move(young_);
        young_.clear();
    }
    std::size_t size() const { return young_.size() + old_.size(); }

  private:
    struct Hash {
        std::size_t operator()(const Fingerprint& print) const { return print.low; }
    };
    using Half = std::unordered_map<Fingerprint, Evaluation<Outcome>, Hash>;
    std::size_t half_;
    Half young_, old_;
};

} // namespace ga
