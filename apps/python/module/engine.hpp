#pragma once

#include "apps/commands/optimise/outside_problem.hpp"
#include "apps/python/module/python.hpp"

namespace rugosa::python {

/// A search on a problem that Python evaluates, and what came of it.
struct Optimisation {
    app::Genes genes;
    std::vector<double> lower, upper; ///< of real genes, one each
    py::object problem;
    std::vector<py::object> operators, observers;
    std::vector<bool> minimise;
    std::string variant, pipeline;
    std::uint64_t seed = 1;
    long evaluations = 0;
    double seconds = 0;

    app::BestKnown record; ///< of every answer
    py::array population;  ///< genes of the pipeline's answer, individuals x genes
    long spent = 0;
    std::string searched, stopped;
    std::vector<std::string> notes;
    bool interrupted = false;
};

///@{
/// Carries it out for one kind of genome; each is compiled by itself.
void optimise_real(Optimisation& asked);
void optimise_bits(Optimisation& asked);
void optimise_permutation(Optimisation& asked);
///@}

} // namespace rugosa::python
