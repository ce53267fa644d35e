#include "apps/python/module/optimise.hpp"

namespace rugosa::python {

void optimise_bits(Optimisation& asked) { optimise<std::vector<bool>>(asked); }

} // namespace rugosa::python
