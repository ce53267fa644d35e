// Compiled with -mavx512f -mavx512dq -mavx512vl, and FMA.
#ifdef __x86_64__
#include "domain/numerics/vectors/loops.inc"

namespace rough {

constinit const VectorLoops avx512_loops = loops_of("avx512");

} // namespace rough
#endif
