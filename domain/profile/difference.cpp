#include "domain/profile/difference.hpp"

#include <algorithm>

namespace rough {

double difference(const Profile& left, const Profile& right) {
    const Eigen::VectorXd a = left.heights.array() - left.heights.mean();
    const Eigen::VectorXd b = right.heights.array() - right.heights.mean();
    const double both = a.norm() * b.norm();
    return both > 0 ? 1 - std::max(a.dot(b), a.dot(b.reverse())) / both : 0;
}

} // namespace rough
