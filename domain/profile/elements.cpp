#include "domain/profile/elements.hpp"

#include <cmath>
#include <limits>

namespace rough {
namespace {

/// A stretch that is a hill or a dale: where it begins on the mean line, in spacings, and its extreme height.
struct Stretch {
    double start;
    double extreme;
};

/// From left to right: a hill or dale begins where the mean line was crossed last before it counts.
std::vector<Stretch> stretches(const Eigen::VectorXd& z) {
    const double hill = z.maxCoeff() / 10, dale = z.minCoeff() / 10;
    std::vector<Stretch> found;
    double crossed = 0;
    int side = 0; // of the last stretch
    for (Index i = 0; i < z.size(); ++i) {
        if (i > 0 && (z[i] > 0) != (z[i - 1] > 0))
            crossed = static_cast<double>(i - 1) + z[i - 1] / (z[i - 1] - z[i]);
        const int now = z[i] > hill ? 1 : z[i] < dale ? -1 : 0;
        if (now != 0 && now != side) {
            found.push_back({crossed, z[i]});
            side = now;
        } else if (side * z[i] > 0 && std::abs(z[i]) > std::abs(found.back().extreme)) {
            found.back().extreme = z[i];
        }
    }
    return found;
}

} // namespace

ProfileElements profile_elements(const Profile& profile) {
    ProfileElements all;
    for (const bool backwards : {false, true}) {
        const auto found = stretches(backwards ? profile.heights.reverse().eval() : profile.heights);
        // The first may have begun before the profile does, the last may go on after it.
        for (std::size_t i = 1; i + 2 < found.size(); i += 2) {
            all.RSm += (found[i + 2].start - found[i].start) * profile.spacing;
            all.Rc += std::abs(found[i].extreme - found[i + 1].extreme);
            ++all.count;
        }
    }
    const double count =
        all.count > 0 ? static_cast<double>(all.count) : std::numeric_limits<double>::quiet_NaN();
    all.RSm /= count, all.Rc /= count;
    return all;
}

} // namespace rough
