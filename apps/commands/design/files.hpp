#pragma once

#include "apps/commands/design/run.hpp"

#include <filesystem>

namespace app {

/// Writes result.json, and tolerance.csv if the tolerance is known.
void write_design_result(const DesignRun& run, const std::filesystem::path& folder);

/// Writes answer.csv, the answer's own curve, and genome.json.
void write_design_tables(const DesignRun& run, const std::filesystem::path& folder);

/// Writes the tables that the page's figures draw: curves.csv, points.csv, heights-drawn.csv or map.csv, and
/// front.csv or made.csv.
void write_design_drawings(const DesignRun& run, const std::filesystem::path& folder);

} // namespace app
