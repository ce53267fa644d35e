#pragma once

/// @file
/// The whole public interface: the headers included here, directly or indirectly, are installed. A header
/// that another one includes is not listed.
#include "domain/asperities/caps.hpp"
#include "domain/contact/interface.hpp"
#include "domain/contact/kernel.hpp"
#include "domain/contact/materials.hpp"
#include "domain/database/build.hpp"
#include "domain/database/screen.hpp"
#include "domain/design/morph.hpp"
#include "domain/design/starts.hpp"
#include "domain/design/tolerance.hpp"
#include "domain/design/trust.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/sobol.hpp"
#include "domain/mwm/test_surfaces.hpp"
#include "domain/paper/variants.hpp"
#include "domain/profile/roughness.hpp"
#include "domain/profile/solid.hpp"
#include "domain/scan/map.hpp"
#include "domain/theory/theory.hpp"

/// Rough profiles, their contact, and the design of profiles with a given contact behaviour.
namespace rough {}
