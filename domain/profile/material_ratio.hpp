#pragma once

#include "domain/profile/profile.hpp"

namespace rough {

/// Rmr(c): the share of the length on which the profile, straight between its nodes, is higher than `level`
/// (mm, from where the heights are counted). Smr(c) of an area: the share of its nodes.
double material_ratio(const Profile& profile, double level);

/// Smc(mr) of an area (ISO 25178-2): the height (mm, from where the heights are counted) that a share `ratio`
/// of the nodes, 0 to 1, exceeds, straight between them: the inverse of Smr(c).
double material_height(const Eigen::VectorXd& heights, double ratio);

/// Parameters of the material ratio curve (ISO 21920-2; ISO 13565-2): the line of least squares through the
/// flattest 40 % of the curve parts peaks, core and valleys. Of several equally flat regions the first.
struct CoreHeights {
    double Rk = 0;  ///< core height, mm
    double Rpk = 0; ///< reduced peak height, mm: of a triangle as large as the peaks above the core
    double Rvk = 0; ///< reduced valley depth, mm
    double Mr1 = 0; ///< share of material at the core's upper limit, 0 to 1
    double Mr2 = 0; ///< at its lower limit
};

/// From the heights at even nodes, five or more.
CoreHeights core_heights(const Eigen::VectorXd& heights);

} // namespace rough
