#pragma once

#include "domain/accuracy/reduced.hpp"
#include "domain/scan/scan.hpp"

namespace rough {

/// The modelled parts of a curve and its possible errors. Errors are relative to the resolved curve's
/// pressures and secant stiffnesses, and are the largest over all rows. In `light_rows` they are relative to
/// 1 % of the last pressure.
struct Account {
    double accuracy = 0;               ///< requested; 0: the exact model as given
    Index resolved_nodes = 0;          ///< nodes of the resolved grid
    std::vector<Index> grids;          ///< nodes of each solved grid, in order
    int read_grids = 1;                ///< number of last grids that give the curve; several are extrapolated
    int rows = 0;                      ///< number of load steps
    int solved_rows = 0;               ///< load steps solved on the last grid
    int resolved_rows = 0;             ///< first load steps, taken from the resolved grid
    int light_rows = 0;                ///< first load steps whose errors are relative to the last pressure
    std::vector<ChromosomePlace> used; ///< modelled chromosomes; empty for a measured profile
    std::vector<ChromosomePlace> dropped; ///< omitted chromosomes; empty for a measured profile
    Window window;                        ///< window due to the omitted chromosomes, mm
    Solver solver = Solver::automatic;    ///< on the last grid
    double tolerance = 0;                 ///< for an iterative solver
    double estimated_error = 0;           ///< from all sources together
    double grid_error = 0;                ///< estimated
    double step_error = 0;                ///< a bound
    double dropped_error = 0;             ///< a bound
    double solver_error = 0;              ///< a bound
    /// Relative errors of the contact fraction and of the tangent stiffness, the worst row; infinite or NaN
    /// if not bounded. Not part of `estimated_error`. For an exact solution on the nodes of a scan they
    /// are bounds. Otherwise they are estimates, which hold against a far finer grid too (README.md).
    double area_error = 0;
    double tangent_error = 0; ///< as area_error, of dP/dDelta
    Index held_nodes = 0;     ///< nodes whose pressure is the hardness at the last load step
    bool by_line = false;     ///< whether one line gives the curve of a map
    double aspect_ratio = std::numeric_limits<double>::quiet_NaN(); ///< Str of a periodic map
    /// Relative error of the map's line: a bound if the line gives the curve, else measured; NaN if no line
    /// was pressed.
    double line_error = std::numeric_limits<double>::quiet_NaN();
    double seconds = 0; ///< wall time

    bool extrapolated() const { return read_grids > 1; } ///< whether several grids give the curve together
};

/// The account in a few sentences.
std::string in_words(const Account& account);

/// A response with its account.
struct AccountedResponse {
    Response response; ///< at each requested displacement
    Account account;   ///< its errors, grids and rows
    std::vector<int>
        last_contact; ///< nodes that touch at the last load step; empty if grids are extrapolated
};

/// A genome's response within the model's accuracy. Throws InputError if the genome's waves are flat at the
/// grid's nodes, as a wave whose length is the node spacing is.
Response respond(const Genome& genome, const Model& model = {});
/// The grid that counts as resolved for a genome: 64 elements per shortest wavelength, at least 4096 and at
/// most 2^20.
Grid resolved_grid(const Genome& genome, double length, bool periodic);

/// A genome's response within model.accuracy (relative, 0 to 1) of the one on the model's grid, at the
/// displacements of that grid's profile. Chooses chromosomes, grids, rows and the solver's tolerance (never
/// above the given one). If nothing cheaper is accurate enough, and for accuracy 0, it solves the model as
/// given. Throws InputError on another accuracy, on an accuracy with a hardness or layers, and as respond().
AccountedResponse respond_within(const Genome& genome, const Model& model);
/// A measured profile's response within model.accuracy, always on the profile's nodes. Its steps, burrs and
/// noise are as fine as its spacing, so a coarser grid would miss some. The accuracy saves load steps and
/// tolerance, both within exact bounds. A periodic map's line gives the curve if its bound allows that
/// (reduced.hpp). Otherwise all load steps of a map are solved, because the bounds between them need nested
/// contact sets, which are not proven for sampled maps.
AccountedResponse respond_within(const Profile& scan, const Model& model);
/// The response of a file's genome or scan.
AccountedResponse respond_within(const Source& source, const Model& model);

} // namespace rough
