#pragma once

#include "domain/profile/preparation.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rough {

/// Options for reading a scan or a map.
struct ScanOptions {
    /// Unit of columns whose header does not name one, e.g. "um". "mm,um" is mm for x and y, and um for
    /// heights. Empty: not given, so mm is assumed.
    std::string unit = {};
    /// Distance between the points of a row of heights. Its unit is the unit of x in `unit`; mm if `unit` is
    /// empty. 0: not given.
    double spacing = 0;
    double row_spacing = 0;          ///< distance between the rows of a matrix, as `spacing`; 0: the same
    Detrend detrend = Detrend::line; ///< form to remove from the heights
    bool fill = false;               ///< whether missing heights are filled() instead of refused
    double max_filled = 0.3;         ///< largest share of the points that may be filled, 0 to 1
    /// Whether missing points are listed, not refused. Their heights are those of `fill`, with any share.
    bool keep_missing = false;
    Index row = 0; ///< row of an areal map to take, from 1; 0: the file has a profile
    /// Numbers of evenly spaced nodes, >= 2, after resampling; one row for a line. 0: as many as the file has
    /// points. Heights are linear between points. A map keeps its area, and its heights continue straight to its
    /// edges. Along a side with fewer cells than points, a height is the mean over its cell.
    Extent nodes = {};
    bool remove_outliers = false; ///< whether outliers are replaced as missing points are filled
    /// Cut-off wavelength of a Gaussian filter, mm; 0: no filter. It is applied after the form is removed,
    /// and removes shorter wavelengths.
    double lambda_s = 0;
    /// Cut-off wavelength of a Gaussian filter that removes longer wavelengths, mm; 0: no filter.
    double lambda_c = 0;
};

/// A measured line or map from a file. Lengths in mm.
struct Scan {
    std::string name;                 ///< path of the file
    Profile measured = {};            ///< heights at evenly spaced nodes, x growing
    std::string account = {};         ///< how the scan was read and changed, in one line
    std::vector<Index> outliers = {}; ///< outliers that were kept
    MissingPoints missing = {};       ///< points that were not measured; their heights are filled

    /// The scan's points, stretched to the grid's length if it differs. Throws InputError if the grid and the
    /// scan have different numbers of nodes.
    Profile on(const Grid& grid) const;
};

/// Reads a measured line scan, or one row of a map (README.md lists the formats). Throws InputError with one
/// line that names the file, the line and the fault.
Scan open_scan(const std::filesystem::path& file, const ScanOptions& options = {});

/// Whether open_scan() refuses a file only because it has a map, and no row of it is requested.
bool holds_map(const std::filesystem::path& file, const ScanOptions& options = {});

/// Reads a map. Each line of a text matrix is a row along x; y grows from line to line. A table of three
/// columns whose first two make a grid is read as x, y and height of its nodes, in any order. X3P, SDF, SUR,
/// GSF, GWY and other formats have units and spacings. The option of a row is not used.
///
/// Throws InputError with one line that names the file and the place. Faults are fewer than 2 x 2 heights,
/// rows of different lengths, missing points, and a spacing or unit that contradicts the file's.
Scan read_map(const std::filesystem::path& path, const ScanOptions& options);

} // namespace rough
