#include "apps/python/module/optimise.hpp"

namespace rugosa::python {

void optimise_real(Optimisation& asked) { optimise<std::vector<double>>(asked); }

} // namespace rugosa::python
