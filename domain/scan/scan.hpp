#pragma once

#include "domain/profile/detrend.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rough {

/// How a file is to be read.
struct ScanOptions {
    /// unit of the columns whose header names none, e.g. "um", or one for x and one for heights, "mm,um";
    /// empty: none given, mm is assumed
    std::string unit = {};
    double spacing = 0; ///< distance of a one-column file's points, in x's `unit` (mm without); 0: none given
    Detrend detrend = Detrend::line; ///< what is taken off the heights
    bool fill = false; ///< replace missing heights by linear interpolation instead of refusing them
    Index row = 0;     ///< of an areal map, the row to take, 1 the first; 0: the file is no map
    Index nodes = 0;   ///< resample to that many even nodes, >= 2; 0: as many as the file has points
    bool remove_outliers = false; ///< put what the nodes around foretell in the place of outliers
    /// cut-off of the Gaussian filter that takes off shorter waves, after the form, mm; 0: none
    double lambda_s = 0;
    double lambda_c = 0; ///< of the one that takes off longer waves, mm; 0: none
};

/// A measured profile, ready for contact, and what was read and done, in one line.
struct Scan {
    Profile profile;     ///< mm, even spacing, x growing, detrended
    std::string account; ///< points, length, height range, rms, units, resampling, filling, detrending
    std::vector<Index> outliers; ///< nodes that stand out and were kept
};

/// Reads a measured line scan: from a text file one column of heights, or x and height, or those with a
/// running index before them or a validity column (0 or 1) behind; from an instrument's own format a profile
/// or a row of a map. See domain/scan/README.md for what is understood. Throws InputError with one line that
/// names the file, the line and what was expected.
Scan read_scan(const std::filesystem::path& path, const ScanOptions& options = {});

} // namespace rough
