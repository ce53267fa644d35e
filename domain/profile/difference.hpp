#pragma once

#include "domain/profile/profile.hpp"

namespace rough {

/// How much two profiles differ: 1 less the correlation coefficient of their heights, the better one of as
/// they are and one of them mirrored end to end. 0 to 2; answers differ from `different` on.
double difference(const Profile& left, const Profile& right);
constexpr double different = 0.05; ///< see above

} // namespace rough
