#pragma once

#include "domain/contact/solve.hpp"

namespace rough {

/// What a profile and the body do to each other along the profile at one load step.
struct Interface {
    Eigen::VectorXd pressure; ///< at every node, MPa; 0 off contact
    Eigen::VectorXd gap;      ///< between the deformed body and the profile, mm; about 0 in contact
    Index spots = 0;          ///< runs of neighbouring contact nodes; periodic bodies join the ends
    double widest = 0;        ///< spot, mm: its nodes times their spacing
};

/// The interface at a load step that solve_contact gave of the profile on this body, with its state: the
/// pressures, and the gap u - (Delta - g0) by an FFT of them. The body is completed for the profile's length.
Interface interface_at(const Profile& profile, const Body& body, const LoadStep& step,
                       const ContactState& state);

} // namespace rough
