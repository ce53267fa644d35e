#pragma once

#include "domain/mwm/genome_json.hpp"
#include "domain/scan/scan.hpp"

#include <optional>

namespace rough {

/// A line profile as a file gives it: a genome, with a height everywhere, or a measured scan. Lengths in mm.
struct Source {
    std::string name;                 ///< of the file
    std::optional<Genome> genome;     ///< nothing for a scan
    double length = standard_length;  ///< L of a genome; a scan has that of its points
    Profile measured = {};            ///< a scan's even nodes; empty for a genome
    std::string account = {};         ///< what was read of a scan and done to it, in one line
    std::vector<Index> outliers = {}; ///< nodes of a scan that stand out and were kept

    /// The grid that it brings along: a scan's own points, 512 nodes for a genome. `periodic` for the
    /// periodic kernel.
    Grid grid(bool periodic = false) const;

    /// Its heights on a grid: a genome's waves, or a scan's points, drawn out to the grid's length where that
    /// is not their own. Throws InputError where the grid has not as many nodes as the scan.
    Profile on(const Grid& grid) const;
};

/// Opens a genome file (JSON). Throws InputError as read_genome_file does.
Source open_genome(const std::filesystem::path& file);

/// Opens a measured scan (text). Throws InputError as read_scan does.
Source open_scan(const std::filesystem::path& file, const ScanOptions& options = {});

} // namespace rough
