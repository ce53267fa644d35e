#pragma once

#include "domain/economy/window.hpp"
#include "domain/fitness/model.hpp"

namespace rough {

/// A chromosome and where it stands in its genome.
struct ChromosomePlace {
    std::size_t series;    ///< index into the genome's series
    int n;                 ///< place in that series
    double wave_length_mm; ///< lambda_n
    double amplitude_mm;   ///< |R_n G_n|
};

/// What was modelled to answer a question, and how wrong the answer may be. Errors are relative, the worst
/// over the rows in pressure and secant stiffness, against the resolved answer.
struct Account {
    double accuracy = 0;           ///< asked for; 0: the exact model as given
    Index resolved_nodes = 0;      ///< nodes of the grid that counts as resolved
    std::vector<Index> grids;      ///< nodes of every grid solved, in order
    bool extrapolated = false;     ///< the answer is read off several grids; else it is the last grid's
    int rows = 0, solved_rows = 0; ///< load steps asked for, and solved on the last grid
    std::vector<ChromosomePlace> used, dropped;
    Window window; ///< of the chromosomes dropped, mm
    Solver solver = Solver::automatic;
    double tolerance = 0;     ///< of an iterative solver
    double grid_error = 0;    ///< estimated
    double step_error = 0;    ///< bounded
    double dropped_error = 0; ///< bounded
    double solver_error = 0;  ///< bounded
    double seconds = 0;

    double estimated_error() const { return grid_error + step_error + dropped_error + solver_error; }
};

struct EconomicResponse {
    Response response;
    Account account;
};

/// The grid that counts as resolved for a genome: 64 elements to its shortest wave, at least 4096 and at most
/// 2^20.
Grid resolved_grid(const Genome& genome, double length, bool wraps);

/// The genome's response within `accuracy` (relative, > 0) of the one that `resolved` gives on its grid, at
/// the same displacements: those of the resolved profile. Chooses the chromosomes, the grids, the rows and
/// the solver's tolerance; where nothing cheaper is good enough it solves the resolved model itself.
EconomicResponse respond_within(const Genome& genome, const Model& resolved, double accuracy);

/// The response of the exact model as given, with its account.
EconomicResponse respond_exactly(const Genome& genome, const Model& model);

} // namespace rough
