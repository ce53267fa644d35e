#pragma once

#include "domain/theory/spectral_moments.hpp"

#include <string>

namespace rough {

/// Theories of the contact of a rigid, random, Gaussian surface with an elastic half-space, repeated without
/// end: what `periodic` solves. The cheapest models of all: no surface is drawn and nothing is solved.
enum class Theory { greenwood_williamson, bush_gibson_thomas, persson };

/// greenwood-williamson, bush-gibson-thomas and persson, in the order of Theory.
const std::vector<std::string>& theory_names();
/// One of them.
const std::string& name_of(Theory theory);

/// What a theory says at some mean pressures; no number (NaN) where it says nothing.
struct TheoryCurve {
    Eigen::VectorXd pressure;         ///< P, MPa
    Eigen::VectorXd contact_fraction; ///< A/A0
    Eigen::VectorXd stiffness;        ///< K = -dP/du, MPa/mm; periodic, so K = K_i
    Eigen::VectorXd separation;       ///< u, mm, between the mean planes of the surface and the body
};

/// Whether a theory is one of profiles, too. Asperity theories are of areas: ridges touch along lines.
bool holds_for(Theory theory, bool is_area);

/// The curve of a theory. `effective_modulus` is E*, MPa; pressures are > 0, in any order, MPa. Throws
/// InputError on moments that no Gaussian surface has and on a profile for a theory of areas.
TheoryCurve foretold_curve(Theory theory, const RandomSurface& surface, double effective_modulus,
                           const Eigen::VectorXd& pressures);

} // namespace rough
