#include "apps/python/module/optimise.hpp"

namespace rugosa::python {

template void optimise<ga::Permutation>(Optimisation&);
template std::unique_ptr<Search> begin_search<ga::Permutation>(Optimisation);

} // namespace rugosa::python
