#pragma once

/// @file
/// The public interface of the library rugosa::domain. The headers included here, directly or indirectly, are
/// installed. A header that another one includes is not listed.
#include "domain/asperities/caps.hpp"
#include "domain/contact.hpp"
#include "domain/database/build.hpp"
#include "domain/database/screen.hpp"
#include "domain/design/morph.hpp"
#include "domain/design/starts.hpp"
#include "domain/design/tolerance.hpp"
#include "domain/design/trust.hpp"
#include "domain/mwm/sobol.hpp"
#include "domain/mwm/test_surfaces.hpp"
#include "domain/paper/variants.hpp"

/// Rough profiles, their contact, and the design of profiles with a given contact behaviour.
namespace rough {}
