#pragma once

#include "apps/external/problem.hpp"
#include "apps/python/module/python.hpp"
#include "apps/report/history.hpp"

#include <pybind11/numpy.h>

namespace rugosa::python {

/// A search on a problem that Python evaluates, and its result.
struct Optimisation : app::OutsideSearch {
    py::object problem;
    std::vector<py::object> operators, observers;
    std::vector<bool> minimise;

    app::BestKnown record; ///< the best of all answers
    std::shared_ptr<app::History> history = std::make_shared<app::History>();
    py::array population; ///< genes of the pipeline's last population, individuals x genes
    bool interrupted = false;
    std::exception_ptr first_error = {}; ///< the first exception of an evaluation
};

/// A search whose evaluations the caller makes in a loop.
class Search {
  public:
    virtual ~Search() = default;
    virtual py::array ask() = 0;                         ///< genomes x genes; no rows after the end of the search
    virtual std::vector<std::string> levels() const = 0; ///< level of each row; "" if there is one
    virtual void tell(const py::object& answers) = 0;    ///< one per row of ask(), in its order
    virtual Optimisation result() = 0;                   ///< ends it
};

/// Runs a search by the problem's evaluations and stores its result.
void optimise(Optimisation& search);
std::unique_ptr<Search> begin_search(Optimisation search);

} // namespace rugosa::python
