#include "apps/python/module/optimise.hpp"

#include "ga/text/whole_vocabulary.hpp"

namespace rugosa::python {

template void optimise<std::vector<double>>(Optimisation&);
template void optimise<std::vector<bool>>(Optimisation&);
template void optimise<ga::Permutation>(Optimisation&);
template std::unique_ptr<Search> begin_search<std::vector<double>>(Optimisation);
template std::unique_ptr<Search> begin_search<std::vector<bool>>(Optimisation);
template std::unique_ptr<Search> begin_search<ga::Permutation>(Optimisation);

} // namespace rugosa::python
