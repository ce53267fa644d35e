#pragma once

#include "apps/external/problem.hpp"
#include "apps/python/module/python.hpp"

#include <pybind11/numpy.h>

namespace rugosa::python {

/// A search on a problem that Python evaluates, and what came of it.
struct Optimisation : app::OutsideSearch {
    py::object problem;
    std::vector<py::object> operators, observers;
    std::vector<bool> minimise;

    app::BestKnown record; ///< of every answer
    py::array population;  ///< genes of the pipeline's answer, individuals x genes
    bool interrupted = false;
};

/// A search whose evaluations are made in a loop of the caller's.
class Asking {
  public:
    virtual ~Asking() = default;
    virtual py::array ask() = 0;                    ///< genomes x genes; no rows when the search has ended
    virtual void tell(const py::list& answers) = 0; ///< of what ask() gave, in its order
    virtual void end() = 0;                         ///< ends it and fills in the Optimisation
};

///@{
/// One kind of genome; each is compiled by itself.
template <class G>
void optimise(Optimisation& asked);
template <class G>
std::unique_ptr<Asking> asking(Optimisation& asked); ///< `asked` stays where it is until the end
///@}

} // namespace rugosa::python
