#pragma once

#include "apps/experiments/compare/problems/instance.hpp"

#include <string>

namespace app {

/// Test problems of several objectives whose front is known: zdt1 to zdt4 and zdt6 of two (Zitzler, Deb and
/// Thiele 2000), dtlz1, dtlz2 and dtlz7 of three (Deb, Thiele, Laumanns and Zitzler 2005), with as many genes
/// as there.
const std::vector<std::string>& front_problems();

/// One of them by name.
RealInstance front_instance(const std::string& name);

} // namespace app
