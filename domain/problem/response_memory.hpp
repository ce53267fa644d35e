#pragma once

#include "domain/response/response.hpp"

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace rough {

/// Responses as pressed, for problems of one model that differ in target or threshold alone and so ask for
/// the same curves again. Safe to share between threads; a pure function's values, so it changes no result.
class ResponseMemory {
  public:
    /// The responses of a problem's key, where they are known.
    std::optional<std::vector<Response>> find(const std::string& key) const {
        const std::lock_guard lock(guard_);
        const auto found = known_.find(key);
        return found == known_.end() ? std::nullopt : std::optional(found->second);
    }
    /// Keeps some; the first stay.
    void keep(const std::string& key, const std::vector<Response>& responses) {
        const std::lock_guard lock(guard_);
        known_.emplace(key, responses);
    }

  private:
    mutable std::mutex guard_;
    std::map<std::string, std::vector<Response>> known_;
};

} // namespace rough
