#include "domain/numerics/vectors/kinds.hpp"

#include <cstdlib>
#include <cstring>
#include <vector>

namespace rough {

namespace {

/// Those that this processor can run, the widest first.
std::vector<const VectorLoops*> available() {
    std::vector<const VectorLoops*> all;
#ifdef __x86_64__
    __builtin_cpu_init();
    const bool fma = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (fma && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl"))
        all.push_back(&avx512_loops);
    if (fma)
        all.push_back(&avx2_loops);
#endif
    all.push_back(&baseline_loops);
    return all;
}

const VectorLoops& chosen() {
    const auto all = available();
    const char* asked = std::getenv("RUGOSA_VECTORS");
    const VectorLoops* least_wide = asked ? vector_loops(asked) : nullptr;
    return least_wide ? *least_wide : *all.front();
}

} // namespace

const VectorLoops* vector_loops(const char* vectors) {
    for (const VectorLoops* loops : available())
        if (std::strcmp(loops->vectors, vectors) == 0)
            return loops;
    return nullptr;
}

const VectorLoops& vector_loops() {
    static const VectorLoops& loops = chosen();
    return loops;
}

} // namespace rough
