#include "domain/numerics/team.hpp"

#include "ga/base/parallel.hpp"

namespace rough {

Team::Team(int threads) : size_(omp_in_parallel() ? 1 : std::max(threads, 1)) {
    try {
        ga::expect_threads(size_);
    } catch (const std::system_error&) {
        size_ = 1;
    }
}

Team& Team::alone() {
    static Team team(1);
    return team;
}

} // namespace rough
