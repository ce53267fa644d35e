#pragma once

#include "domain/response/response.hpp"

#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace rough {

/// Responses by shape, for problems that differ in target or threshold alone and so ask for the same curves
/// again. Safe to share between threads; a pure function's values, so it changes no result.
class ResponseMemory {
  public:
    /// The response of a shape_key, where it is known.
    std::optional<Response> find(const std::string& shape) const {
        const std::lock_guard lock(guard_);
        const auto found = known_.find(shape);
        return found == known_.end() ? std::nullopt : std::optional(found->second);
    }
    /// Keeps one; the first stays.
    void keep(const std::string& shape, const Response& response) {
        const std::lock_guard lock(guard_);
        known_.emplace(shape, response);
    }

  private:
    mutable std::mutex guard_;
    std::map<std::string, Response> known_;
};

} // namespace rough
