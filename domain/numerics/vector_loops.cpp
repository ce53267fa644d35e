#include "domain/numerics/vector_loops.hpp"

#include <cstdlib>
#include <cstring>
#include <vector>

namespace rough {
namespace {

/// The loops that this processor can run, the widest first.
std::vector<const VectorLoops*> available() {
    std::vector<const VectorLoops*> all;
#ifdef __x86_64__
    __builtin_cpu_init();
    const bool fma = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (fma && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl"))
        all.push_back(&avx512_loops);
    if (fma) all.push_back(&avx2_loops);
#endif
    all.push_back(&baseline_loops);
    return all;
}

} // namespace

const VectorLoops* vector_loops(const char* vectors) {
    for (const VectorLoops* loops : available())
        if (std::strcmp(loops->vectors, vectors) == 0) return loops;
    return nullptr;
}

const VectorLoops& vector_loops() {
    static const VectorLoops& chosen = []() -> const VectorLoops& {
        const char* requested = std::getenv("RUGOSA_VECTORS");
        const VectorLoops* narrower = requested ? vector_loops(requested) : nullptr;
        return narrower ? *narrower : *available().front();
    }();
    return chosen;
}

Build build() { return {RUGOSA_COMPILER, RUGOSA_FLAGS, vector_loops().vectors}; }

} // namespace rough
