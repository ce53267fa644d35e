#pragma once

#include "apps/report/plot.hpp"

#include <catch2/catch.hpp>

namespace app::testing {

/// Pictures that must all be drawn.
inline std::vector<std::string> svg(const std::vector<Plot>& plots) {
    const Drawing drawing = draw(plots);
    INFO(drawing.missing);
    REQUIRE(drawing.missing.empty());
    return drawing.pictures;
}

} // namespace app::testing
