#pragma once

#include "domain/mwm/genome_json.hpp"
#include "domain/scan/scan.hpp"

#include <optional>

namespace rough {

/// A line profile from a file: a genome, which has a height at every x, or a measured scan. Lengths in mm.
struct Source {
    std::string name;                 ///< path of the file
    std::optional<Genome> genome;     ///< nothing for a scan
    double length = standard_length;  ///< L of a genome; not used for a scan
    Profile measured = {};            ///< a scan at evenly spaced nodes; empty for a genome
    std::string account = {};         ///< one line on how a scan was read and changed
    std::vector<Index> outliers = {}; ///< outliers of a scan that were kept

    /// The file's grid: a scan's points, 512 nodes for a genome. `periodic` for the periodic kernel.
    Grid grid(bool periodic = false) const;

    /// Heights on a grid: a genome's waves, or a scan's points, stretched to the grid's length if it differs.
    /// Throws InputError if the grid and the scan have different numbers of nodes.
    Profile on(const Grid& grid) const;
};

/// Opens a genome file (JSON). Throws InputError as read_genome_file.
Source open_genome(const std::filesystem::path& file);

/// Opens a measured scan (text). Throws InputError as read_scan.
Source open_scan(const std::filesystem::path& file, const ScanOptions& options = {});

} // namespace rough
