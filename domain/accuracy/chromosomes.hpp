#pragma once

#include "domain/accuracy/window.hpp"
#include "domain/mwm/sampling.hpp"

namespace rough {

/// A chromosome and where it stands in its genome.
struct ChromosomePlace {
    std::size_t series;    ///< index into the genome's series
    int n;                 ///< place in that series
    double wave_length_mm; ///< lambda_n
    double amplitude_mm;   ///< |R_n G_n|
};

/// All of a genome's chromosomes, in order.
std::vector<ChromosomePlace> places(const Genome& genome);

/// Which chromosomes to model, and the window that those left out may open.
struct Selection {
    Genome genome;                        ///< with the chromosomes kept
    std::vector<ChromosomePlace> used;    ///< kept, by their places in the whole genome
    std::vector<ChromosomePlace> dropped; ///< left out, by their places in the whole genome
    Window window;                        ///< mm; 0 wide where all are kept
};

/// The whole genome, nothing left out.
Selection everything(const Genome& genome);

/// Leaves out the shortest waves, as many as the window's width allows (`widest`, mm) on the grid on which
/// `whole` is the genome's profile: they are what asks for fine grids.
Selection without_short_waves(const Genome& genome, const Grid& grid, const Profile& whole, double widest);

} // namespace rough
