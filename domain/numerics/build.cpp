#include "domain/numerics/build.hpp"

#include "domain/numerics/vector_loops.hpp"

namespace rough {

Build build() { return {RUGOSA_COMPILER, RUGOSA_FLAGS, vector_loops().vectors}; }

} // namespace rough
