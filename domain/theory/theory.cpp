#include "domain/theory/theory.hpp"

#include "domain/errors.hpp"

namespace rough {

const std::vector<std::string>& theory_names() {
    static const std::vector<std::string> names{"greenwood-williamson", "bush-gibson-thomas", "persson"};
    return names;
}

const std::string& name_of(Theory theory) { return theory_names()[static_cast<std::size_t>(theory)]; }

bool holds_for(Theory theory, bool is_area) { return is_area || theory == Theory::persson; }

TheoryCurve foretold_curve(Theory theory, const RandomSurface& surface, double effective_modulus,
                           const Eigen::VectorXd& pressures) {
    if (!holds_for(theory, surface.is_area))
        refuse(name_of(theory), ": given a profile, expected an area: asperities are no ridges");
    if (!(effective_modulus > 0) || !(pressures.array() > 0).all())
        refuse(name_of(theory), ": expected a modulus and mean pressures above 0");
    switch (theory) {
    case Theory::greenwood_williamson:
        return greenwood_williamson(spectral_moments(surface), effective_modulus, pressures);
    case Theory::bush_gibson_thomas:
        return bush_gibson_thomas(spectral_moments(surface), effective_modulus, pressures);
    default:
        return persson(surface, effective_modulus, pressures);
    }
}

} // namespace rough
