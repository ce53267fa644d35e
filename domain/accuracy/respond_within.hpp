#pragma once

#include "domain/accuracy/account.hpp"
#include "domain/response/model.hpp"
#include "domain/scan/source.hpp"

namespace rough {

/// A response, and what it took and how far to trust it.
struct AccountedResponse {
    Response response;             ///< at every displacement asked for
    Account account;               ///< its errors, grids and rows
    std::vector<int> last_contact; ///< nodes that touch at the last load step; empty if grids were read
};

/// The grid that counts as resolved for a genome: 64 elements to its shortest wave, at least 4096 and at most
/// 2^20.
Grid resolved_grid(const Genome& genome, double length, bool periodic);

/// The response within `accuracy` (relative, more than 0 to 1) of the one that `resolved` gives on its grid,
/// at the same displacements: those of the resolved profile. Chooses the chromosomes, the grids, the rows and
/// the solver's tolerance (never above the one given); where nothing cheaper is good enough it solves the
/// resolved model itself. Throws InputError on another accuracy, on a hardness, and what `respond` throws.
AccountedResponse respond_within(const Genome& genome, const Model& resolved, double accuracy);
/// The same for a measured profile, always on its own nodes: a scan's steps, burrs and noise are as fine as
/// its spacing, and no coarser grid can know what it misses. What is saved is load steps and the tolerance,
/// both within exact bounds. A periodic map's one line answers for it if its bound allows that
/// (line_of_map.hpp), else its own nodes do at every load step: the bounds between load steps rest on nested
/// contact sets, which are not proven for sampled maps.
AccountedResponse respond_within(const Profile& scan, const Model& resolved, double accuracy);

/// As the model asks: within its accuracy where it has one, else exactly.
AccountedResponse respond_accounted(const Genome& genome, const Model& model);
/// The same for what a file gives.
AccountedResponse respond_accounted(const Source& source, const Model& model);

/// The response of the exact model as given, with its account.
AccountedResponse respond_exactly(const Genome& genome, const Model& model);
/// The same for a measured profile.
AccountedResponse respond_exactly(const Profile& scan, const Model& model);

} // namespace rough
