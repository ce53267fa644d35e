#pragma once

#include "domain/mwm/genome.hpp"
#include "domain/profile/preparation.hpp"

#include <optional>

namespace rough {

/// Options for reading a scan.
struct ScanOptions {
    /// Unit of columns whose header does not name one, e.g. "um". "mm,um" is mm for x and um for heights.
    /// Empty: not given, so mm is assumed.
    std::string unit = {};
    /// Distance between the points of a file with one column. Its unit is the unit of x in `unit`; mm if
    /// `unit` is empty. 0: not given.
    double spacing = 0;
    Detrend detrend = Detrend::line; ///< form to remove from the heights
    bool fill = false;               ///< whether missing heights are interpolated linearly instead of refused
    Index row = 0;                   ///< row of an areal map to take, from 1; 0: the file has a profile
    /// Number of evenly spaced nodes to which heights are resampled, >= 2; 0: as many as the file has points.
    Index nodes = 0;
    bool remove_outliers = false; ///< whether outliers are replaced by linear interpolation
    /// Cut-off wavelength of a Gaussian filter, mm; 0: no filter. It is applied after the form is removed,
    /// and removes shorter wavelengths.
    double lambda_s = 0;
    /// Cut-off wavelength of a Gaussian filter that removes longer wavelengths, mm; 0: no filter.
    double lambda_c = 0;
};

/// A line profile from a file: a genome, which has a height at every x, or a measured scan. Lengths in mm.
struct Source {
    std::string name;                 ///< path of the file
    std::optional<Genome> genome;     ///< the genome; nothing for a scan
    double length = standard_length;  ///< length L of a genome's profile; not used for a scan
    Profile measured = {};            ///< a scan at evenly spaced nodes, x growing; empty for a genome
    std::string account = {};         ///< how a scan was read and changed, in one line
    std::vector<Index> outliers = {}; ///< outliers of a scan that were kept

    /// The grid of the file: the nodes of a scan, or 512 nodes for a genome. `periodic` is for the periodic
    /// kernel.
    Grid grid(bool periodic = false) const;

    /// Heights on a grid: a genome's waves, or a scan's points, stretched to the grid's length if it differs.
    /// Throws InputError if the grid and the scan have different numbers of nodes.
    Profile on(const Grid& grid) const;
};

/// Opens a genome file (JSON). Throws InputError as read_genome_file.
Source open_genome(const std::filesystem::path& file);

/// Reads a measured line scan, or one row of a map (README.md lists the formats). Throws InputError with one
/// line that names the file, the line and the fault.
Source open_scan(const std::filesystem::path& file, const ScanOptions& options = {});

} // namespace rough
