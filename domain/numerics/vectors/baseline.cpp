// Compiled with the flags of the build, for every processor that it supports.
#include "domain/numerics/vectors/loops.inc"

namespace rough {

constinit const VectorLoops baseline_loops = loops_of("baseline");

} // namespace rough
