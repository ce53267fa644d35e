#pragma once

namespace rough {

/// Which elastic body the profile is pressed on.
enum class Kernel {
    free,     ///< non-periodic half-plane (Flamant), constant pressure on each element
    periodic, ///< periodic half-plane, nodal samples
    strip,    ///< one row of patches on a half-space (Love)
};

/// A frictionless elastic half-space; lengths in mm, modulus in MPa.
struct Body {
    Kernel kernel = Kernel::free; ///< which influence matrix
    double effective_modulus = 1; ///< E* = E/(1 - nu^2), MPa
    double datum = 0.84942;       ///< d, mm: where the free half-plane's displacement is zero (free only)
    double strip_width = 0;       ///< W, mm (strip only)
};

} // namespace rough
