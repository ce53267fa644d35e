#pragma once

#include "domain/numerics/vector_loops.hpp"

namespace rough {

///@{
/// The loops as a file of their own was compiled for each kind of vectors; the last two on x86-64 only.
extern const VectorLoops baseline_loops, avx2_loops, avx512_loops;
///@}

} // namespace rough
