#include "apps/python/module/optimise.hpp"

namespace rugosa::python {

template void optimise<std::vector<bool>>(Optimisation&);
template std::unique_ptr<AskTell> ask_tell<std::vector<bool>>(Optimisation&);

} // namespace rugosa::python
