#pragma once

#include <cstddef>
#include <string>

namespace rough {

/// Rows that are eliminated together, columns that are multiplied together, in a VectorLoops.
constexpr std::ptrdiff_t panel_width = 8;

/// The storage of a Cholesky factor L as a GrowingFactor keeps it.
struct PanelFactor {
    double* const* panels;    ///< panel b: 8 (b + 1) columns of 8 rows each, 64-byte aligned
    double* inverse_diagonal; ///< 1/L_ii
    double* one;              ///< z = L^-1 1
    double* gap_image;        ///< v = L^-1 g0
};

/// cos and sin of a wave's angle at every node. The angle is the sum of two: that of a block's first node and
/// that of a node in its block.
struct WaveAngles {
    std::ptrdiff_t nodes;        ///< N
    std::ptrdiff_t block;        ///< nodes per block
    const double* start_cosines; ///< one for each block
    const double* start_sines;   ///< one for each block
    const double* fine_cosines;  ///< one for each node of a block
    const double* fine_sines;    ///< one for each node of a block
};

/// The loops that take most of the time, compiled once for each kind of vectors. Sums have the same order in
/// all kinds, which differ only in whether a product and a sum are rounded together. Pointers to doubles of
/// one call must not overlap unless stated.
struct VectorLoops {
    const char* vectors; ///< "baseline", "avx2" or "avx512"

    /// Eliminates eight rows of L, panel number `panel`, whose columns before block `first_block` are already
    /// those of L and whose others hold H. `one` and `gap` (8 each) are the rows' entries of 1 and g0.
    /// Returns the first row whose pivot is not over `min_pivot` times its diagonal of H, or 8.
    std::ptrdiff_t (*eliminate)(const PanelFactor& factor, std::ptrdiff_t panel, std::ptrdiff_t first_block,
                                const double* one, const double* gap, double min_pivot);
    /// x = L^-T x in place, 8 `panels` entries.
    void (*back_substitute)(const PanelFactor& factor, std::ptrdiff_t panels, double* x);
    /// u_i = sum_k h[i - nodes_k] p_k, i = 0..size-1; `centre` is h[0], `size` a multiple of 64.
    void (*toeplitz)(const double* centre, std::ptrdiff_t size, const int* nodes, const double* pressure,
                     std::ptrdiff_t count, double* u);
    /// The greatest approach - (gap + u) of n >= 1 nodes; sets `finite` to whether every u is finite.
    double (*deepest)(const double* gap, const double* u, std::ptrdiff_t n, double approach, bool& finite);
    /// heights += offset - amplitude cos of the wave's angle, at every node
    void (*add_wave)(const WaveAngles& angles, double offset, double amplitude, double* heights);
    /// cos and sin of the wave's angle at every node
    void (*wave)(const WaveAngles& angles, double* cosines, double* sines);
    /// product(:, c) = sum_i rows(:, i) columns(i, c), c = 0..7. Eight rows, columns first, 64-byte aligned,
    /// times eight columns that lie `stride` apart. The product is 8 x 8, columns first.
    void (*multiply)(const double* rows, std::ptrdiff_t depth, const double* columns, std::ptrdiff_t stride,
                     double* product);
};

///@{
/// The loops compiled for each kind of vectors, the last two only on x86-64.
extern const VectorLoops baseline_loops;
extern const VectorLoops avx2_loops;
extern const VectorLoops avx512_loops;
///@}

/// The loops for the widest vectors of the processor: AVX-512 (F, DQ, VL), AVX2 with FMA, or those that the
/// build assumes of every processor. RUGOSA_VECTORS=baseline|avx2|avx512 in the environment chooses narrower
/// ones, and so gives the bits of an older processor. Decided once, at the first call.
const VectorLoops& vector_loops();

/// The loops of that name, or nothing if this processor or build does not have them.
const VectorLoops* vector_loops(const char* vectors);

/// The build. Besides the input, the last bits of a result depend on it. The same build on the same kind of
/// vectors gives the same bits.
struct Build {
    std::string compiler; ///< name and version
    std::string flags;    ///< optimisation and tuning
    std::string vectors;  ///< kind of the vectors that vector_loops() has chosen
};

/// The build of this library, on this processor.
Build build();

} // namespace rough
