#pragma once

#include "domain/profile/preparation.hpp"

#include <filesystem>
#include <string>
#include <vector>

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

/// A measured line profile from a file. Lengths in mm.
struct Scan {
    std::string name;                 ///< path of the file
    Profile measured = {};            ///< profile at evenly spaced nodes, x growing
    std::string account = {};         ///< how the scan was read and changed, in one line
    std::vector<Index> outliers = {}; ///< outliers that were kept

    /// The grid of the scan's nodes. `periodic` is for the periodic kernel.
    Grid grid(bool periodic = false) const;

    /// The scan's points, stretched to the grid's length if it differs. Throws InputError if the grid and the
    /// scan have different numbers of nodes.
    Profile on(const Grid& grid) const;
};

/// Reads a measured line scan, or one row of a map (README.md lists the formats). Throws InputError with one
/// line that names the file, the line and the fault.
Scan open_scan(const std::filesystem::path& file, const ScanOptions& options = {});

} // namespace rough
