#include "apps/python/module/optimise.hpp"

namespace rugosa::python {

template void optimise<std::vector<bool>>(Optimisation&);
template std::unique_ptr<Search> begin_search<std::vector<bool>>(Optimisation);

} // namespace rugosa::python
