#pragma once

#include "domain/profile/profile.hpp"

namespace rough {

/// Profile elements: a hill that rises above a tenth of the largest height and a dale that falls under a
/// tenth of the largest depth, one after the other, from one crossing of the mean line to the next but one
/// (ISO 21920-2: crossing-the-line segmentation, gone through from both ends).
struct ProfileElements {
    double RSm = 0;  ///< mean width, mm; no number where there is no whole element
    double Rc = 0;   ///< mean height, hill to dale, mm
    Index count = 0; ///< of whole elements, from both ends together
};

/// Of a profile about its mean line: heights (mm) whose mean is 0.
ProfileElements profile_elements(const Profile& profile);

} // namespace rough
