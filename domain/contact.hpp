#pragma once

/// @file
/// The public interface of the library rugosa::contact. A header that another one includes is not listed.
#include "domain/accuracy/resolution.hpp"
#include "domain/accuracy/respond_within.hpp"
#include "domain/contact/interface.hpp"
#include "domain/contact/kernel.hpp"
#include "domain/contact/materials.hpp"
#include "domain/errors.hpp"
#include "domain/profile/outliers.hpp"
#include "domain/profile/preparation.hpp"
#include "domain/profile/roughness.hpp"
#include "domain/profile/solid.hpp"
#include "domain/response/curve.hpp"
#include "domain/theory/theory.hpp"
