#include "apps/python/module/optimise.hpp"

namespace rugosa::python {

template void optimise<ga::Permutation>(Optimisation&);
template std::unique_ptr<AskTell> ask_tell<ga::Permutation>(Optimisation&);

} // namespace rugosa::python
