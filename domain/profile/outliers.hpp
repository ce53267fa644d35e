#pragma once

#include "domain/profile/profile.hpp"

namespace rough {

/// The indices of outliers of a measured profile or map, in increasing order, by the method of scan/README.md,
/// step 3. Particles of up to four nodes are found together with their flanks. Much wider particles count as
/// surface. Lines, rows and columns of under 16 nodes are not tested. The heights are finite.
std::vector<Index> outliers(const Profile& surface);

} // namespace rough
