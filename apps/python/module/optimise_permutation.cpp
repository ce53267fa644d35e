#include "apps/python/module/optimise.hpp"

namespace rugosa::python {

void optimise_permutation(Optimisation& asked) { optimise<ga::Permutation>(asked); }

} // namespace rugosa::python
