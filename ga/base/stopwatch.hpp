#pragma once

#include <chrono>

namespace ga {

/// Measures the wall time since it was made.
class Stopwatch {
  public:
    /// Wall time since the object was made, s.
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace ga
