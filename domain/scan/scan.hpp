#pragma once

#include "domain/mwm/genome.hpp"
#include "domain/profile/preparation.hpp"

#include <optional>

namespace rough {

/// Options for reading a scan.
struct ScanOptions {
    /// unit of columns whose header does not name one, e.g. "um", or one for x and one for heights, "mm,um";
    /// empty: not given, so mm is assumed
    std::string unit = {};
    double spacing = 0; ///< distance of a one-column file's points, in x's `unit` (else mm); 0: not given
    Detrend detrend = Detrend::line; ///< form to remove from the heights
    bool fill = false; ///< replace missing heights by linear interpolation instead of refusing them
    Index row = 0;     ///< row of an areal map to take, from 1; 0: the file has a profile
    Index nodes = 0;   ///< number of even nodes to resample to, >= 2; 0: as many as the file has points
    bool remove_outliers = false; ///< replace outliers by linear interpolation
    /// cut-off of the Gaussian filter that removes shorter wavelengths, after the form, mm; 0: none
    double lambda_s = 0;
    double lambda_c = 0; ///< cut-off of the filter that removes longer wavelengths, mm; 0: none
};

/// A measured profile, ready for contact.
struct Scan {
    Profile profile; ///< mm, even spacing, x growing, detrended
    std::string
        account; ///< one line: points, length, height range, rms, units, resampling, filling, detrending
    std::vector<Index> outliers; ///< outliers that were kept
};

/// Reads a measured line scan (README.md lists the formats). A text file has one column of heights, or x and
/// height. A running index before them and a validity column (0 or 1) after them are optional. From an
/// instrument's format it takes a profile or a row of a map. Throws InputError with one line that names the
/// file, the line and the fault.
Scan read_scan(const std::filesystem::path& path, const ScanOptions& options = {});

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
