#pragma once

#include "domain/accuracy/reduced.hpp"

#include <functional>

namespace rough {

/// A wave of a surface that is a sum of waves, and its place in this sum.
struct PlacedWave {
    std::size_t series;    ///< index of its series
    int n;                 ///< place in the series, from 1
    double wave_length_mm; ///< wavelength
    double amplitude_mm;   ///< amplitude
};

/// A surface that is a sum of waves, or only its longer ones.
struct SumOfWaves {
    std::function<Profile(const Grid&)> on; ///< samples it on a grid
    std::vector<PlacedWave> used;           ///< waves of the sum
    std::vector<PlacedWave> dropped = {};   ///< waves of the surface that were omitted
    Window window = {};                     ///< window due to the omitted waves, mm; without any its width is 0
};

/// A report on how a curve was computed, and on its possible errors. A row is a load step. Errors are
/// relative to the pressures and secant stiffnesses of the resolved curve, and are the largest over all rows.
/// In the first `light_rows` rows they are relative to 1 % of the last pressure.
struct AccuracyReport {
    double accuracy = 0;               ///< requested accuracy; 0: the exact model as given
    Index resolved_nodes = 0;          ///< nodes of the resolved grid
    std::vector<Index> grids;          ///< nodes of each solved grid, in order
    int read_grids = 1;                ///< number of last grids whose curves are used; several: extrapolated
    int rows = 0;                      ///< number of load steps
    int solved_rows = 0;               ///< load steps solved on the last grid
    int resolved_rows = 0;             ///< load steps taken from the resolved grid: the first ones, or all
    int light_rows = 0;                ///< first load steps whose errors are relative to the last pressure
    std::vector<PlacedWave> used;      ///< modelled waves; empty for a measured profile
    std::vector<PlacedWave> dropped;   ///< omitted waves; empty for a measured profile
    Window window;                     ///< window due to the omitted waves, mm
    Solver solver = Solver::automatic; ///< solver on the last grid
    double tolerance = 0;              ///< tolerance of an iterative solver
    double estimated_error = 0;        ///< error from all sources together
    double grid_error = 0;             ///< estimated error due to the grid
    double step_error = 0;             ///< bound of the error due to interpolated load steps
    double dropped_error = 0;          ///< bound of the error due to omitted waves
    double solver_error = 0;           ///< bound of the error due to the solver's tolerance
    /// Largest relative error of the contact fraction, not part of `estimated_error`; infinite or NaN if it is not
    /// bounded. A bound for an exact solution on the nodes of a scan, otherwise an estimate (README.md).
    double area_error = 0;
    double tangent_error = 0; ///< largest relative error of the tangent stiffness; see `area_error`
    Index held_nodes = 0;     ///< nodes whose pressure is the hardness at the last load step
    bool by_line = false;     ///< whether one line gives the curve of a map
    double aspect_ratio = std::numeric_limits<double>::quiet_NaN(); ///< Str (ISO 25178) of a periodic map
    /// Relative error of the curve of the map's line: a bound if the line gives the curve, otherwise
    /// measured; NaN if no line was pressed.
    double line_error = std::numeric_limits<double>::quiet_NaN();
    double seconds = 0; ///< wall time

    bool extrapolated() const { return read_grids > 1; } ///< whether several grids give the curve together
};

/// The account in a few sentences.
std::string in_words(const AccuracyReport& account);

/// A response with its account.
struct ReportedResponse {
    Response response;             ///< response at each requested displacement
    AccuracyReport account;        ///< errors, grids and rows of the response
    std::vector<int> last_contact; ///< nodes that touch at the last load step; empty if grids are extrapolated
};

/// A measured surface's response within model.accuracy on its nodes, or on a line for a periodic map (README.md).
ReportedResponse respond_within(const Profile& scan, const Model& model);
/// The response of a sum of waves within model.accuracy (relative, 0 to 1) of the response on the model's
/// grid. Displacements are those of that grid's profile, `whole`. Solves the model as given if `accuracy` is
/// 0 or no cheaper choice of waves, grids, rows and tolerance is accurate enough. Throws InputError on an
/// accuracy out of range, and on an accuracy with a hardness or layers. Also throws what respond() throws.
/// @param without_short_waves  the surface without its shortest waves, as long as the window is at most this
///                             wide, mm
ReportedResponse respond_within(const Profile& whole, const SumOfWaves& surface,
                                const std::function<SumOfWaves(double widest)>& without_short_waves,
                                const Model& model);

} // namespace rough
