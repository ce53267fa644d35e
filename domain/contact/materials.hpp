#pragma once

#include <string>
#include <vector>

namespace rough {

/// A common material: its elasticity, and the pressure from which it yields.
struct Material {
    std::string name;     ///< its name for --material
    double modulus;       ///< Young's modulus E, MPa
    double poissons;      ///< Poisson's ratio nu
    double hardness;      ///< indentation hardness, MPa: about the largest local pressure
    std::string of;       ///< grade of the material, in a few words
    std::string elastic;  ///< source of E and nu
    std::string indented; ///< source of the hardness
};

/// The known materials, in the order of their names. Values are for room temperature. A heat treatment may
/// change a hardness severalfold.
const std::vector<Material>& materials();

/// Limit on the largest local pressure divided by E*, for a material of unknown hardness. The highest ratios
/// of hardness and E* are 0.06 to 0.09, for glass, silicon and diamond.
constexpr double largest_elastic_pressure = 0.1;

} // namespace rough
