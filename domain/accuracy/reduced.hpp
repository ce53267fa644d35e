#pragma once

#include "domain/accuracy/error_bounds.hpp"
#include "domain/mwm/sampling.hpp"

/// @file
/// Reduced models: a genome without its shortest waves, one line in place of a map, and interpolated load
/// steps.

namespace rough {

/// A chromosome and its place in its genome.
struct ChromosomePlace {
    std::size_t series;    ///< index of its series in the genome
    int n;                 ///< Chromosome::n, its place in this series
    double wave_length_mm; ///< wavelength lambda_n
    double amplitude_mm;   ///< amplitude |R_n G_n| of its cosine (waves.hpp)
};

/// All chromosomes of a genome, in order.
std::vector<ChromosomePlace> places(const Genome& genome);

/// The chromosomes to model, and the window (error_bounds.hpp) due to the omitted ones.
struct Selection {
    Genome genome;                             ///< genome with only the modelled chromosomes
    std::vector<ChromosomePlace> used;         ///< modelled chromosomes; places in the whole genome
    std::vector<ChromosomePlace> dropped = {}; ///< omitted chromosomes; places in the whole genome
    Window window = {};                        ///< window, mm; its width is 0 if none is omitted
};

/// Omits the shortest waves, which need the finest grids, as long as the window on `grid` is at most `widest`
/// (mm) wide. `whole` is the genome's profile on `grid`.
Selection without_short_waves(const Genome& genome, const Grid& grid, const Profile& whole, double widest);

/// One line in place of a map: the mean of its rows or of its columns, whichever has the narrower window.
struct LineOfMap {
    Profile line;        ///< heights of the line, mm
    bool along_x = true; ///< whether the line is the mean of the rows; the grooves then run along y
    Window window;       ///< window between the map and the map that repeats the line
};
/// The line that replaces a map. Throws InputError if `map` is a line.
LineOfMap line_of_map(const Profile& map);

/// A curve with a row for each requested displacement: solved, or interpolated between solved rows. Rows
/// before the profile touches are zeros.
struct LoadRows : ContactCurve {
    /// Bound of the error of interpolated rows, relative to their exact pressure and secant.
    double error = 0;
    double area_error = 0;    ///< bound of the relative error of the contact fraction
    double tangent_error = 0; ///< bound of the relative error of the tangent stiffness
    int solved = 0;           ///< number of solved rows
};

/// Solves the contact at as few of the displacements (mm, increasing) as `accuracy` allows; 0 solves every
/// row. A profile does not touch at displacements <= 0. Between two solved rows the pressure is a cubic with
/// the tangents of these rows. It is kept within exact bounds: below the chord, above both tangents.
LoadRows solve_rows(const Profile& profile, const Body& body, const std::vector<double>& displacements,
                    const ContactOptions& options, double accuracy = 0);

} // namespace rough
