#include "domain/contact/materials.hpp"

namespace rough {

namespace {

constexpr const char* kaye_laby = "Kaye & Laby, Tables of Physical and Chemical Constants (1995), 2.2.2";
constexpr const char* samsonov =
    "Samsonov, Handbook of the Physicochemical Properties of the Elements (1968)";
constexpr const char* iso_18265 = "ISO 18265:2013, table A.1";
constexpr const char* coorstek = "CoorsTek, data sheet of AD-995";
constexpr const char* roehm = "Evonik Röhm, data sheet of Plexiglas GS (ISO 527, ISO 2039-1)";
constexpr const char* heraeus = "Heraeus Quarzglas, Quartz Glass for Optics: Data and Properties";
constexpr const char* asm_titanium = "Boyer, Welsch & Collings, Titanium Alloys, ASM (1994)";

} // namespace

const std::vector<Material>& materials() {
    static const std::vector<Material> all{
        {"alumina", 370000, 0.22, 14100, "sintered Al2O3, 99.5 %", coorstek, coorstek},
        {"aluminium", 70300, 0.345, 167, "pure, annealed", kaye_laby, samsonov},
        {"copper", 129800, 0.343, 369, "pure, annealed", kaye_laby, samsonov},
        {"fused-silica", 72500, 0.17, 6000, "SiO2", heraeus, heraeus},
        {"glass", 70000, 0.2, 6000, "soda-lime glass", "EN 572-1:2012", "EN 572-1:2012"},
        {"gold", 78000, 0.44, 216, "pure, annealed", kaye_laby, samsonov},
        {"hardened-steel", 201400, 0.296, 6840, "60 HRC, 697 HV", kaye_laby, "ASTM E140, table 1"},
        {"iron", 211400, 0.293, 608, "soft iron", kaye_laby, samsonov},
        {"nickel", 199500, 0.312, 638, "pure, soft", kaye_laby, samsonov},
        {"pmma", 3300, 0.37, 175, "cast acrylic glass", roehm, roehm},
        {"silicon-nitride", 300000, 0.26, 14500, "bearing balls, 1480 HV", "ASTM F2094, middle of its range",
         "ASTM F2094, class I, least"},
        {"silver", 82700, 0.367, 251, "pure, annealed", kaye_laby, samsonov},
        {"steel", 210000, 0.3, 1180, "structural steel S235, 120 HV", "EN 1993-1-1:2005, 3.2.6", iso_18265},
        {"titanium-alloy", 113800, 0.342, 3420, "Ti-6Al-4V, annealed, 349 HV", asm_titanium, asm_titanium},
        {"tungsten", 411000, 0.28, 3430, "pure", kaye_laby, samsonov},
    };
    return all;
}

std::vector<std::string> material_names() {
    std::vector<std::string> names;
    for (const Material& material : materials())
        names.push_back(material.name);
    return names;
}

} // namespace rough
