// Compiled with -mavx2 -mfma.
#ifdef __x86_64__
#include "domain/numerics/vectors/loops.inc"

namespace rough {

constinit const VectorLoops avx2_loops = loops_of("avx2");

} // namespace rough
#endif
