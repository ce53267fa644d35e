#pragma once

#include <deque>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace rough {

/// Values by keys, for several threads. A value depends only on its key, so no result depends on the memory.
template <class Value>
class KeyedMemory {
  public:
    /// A memory of the `max_count` latest keys.
    explicit KeyedMemory(std::size_t max_count = std::numeric_limits<std::size_t>::max())
        : max_count_(max_count) {}

    /// The value of a key, or nothing.
    std::optional<Value> find(const std::string& key) const {
        const std::lock_guard lock(guard_);
        const auto found = known_.find(key);
        return found == known_.end() ? std::nullopt : std::optional(found->second);
    }
    /// Stores a value, unless the key already has one.
    void keep(const std::string& key, const Value& value) {
        const std::lock_guard lock(guard_);
        const auto [place, is_new] = known_.emplace(key, value);
        if (is_new)
            order_.push_back(place);
        if (order_.size() > max_count_) {
            known_.erase(order_.front());
            order_.pop_front();
        }
    }

  private:
    std::size_t max_count_;
    mutable std::mutex guard_;
    std::map<std::string, Value> known_;
    std::deque<typename std::map<std::string, Value>::iterator> order_; ///< oldest first
};

} // namespace rough
