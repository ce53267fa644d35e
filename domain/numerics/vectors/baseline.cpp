// What the build assumes of every processor it is for.
#include "domain/numerics/vectors/loops.inc"

namespace rough {

constinit const VectorLoops baseline_loops = loops_of("baseline");

} // namespace rough
