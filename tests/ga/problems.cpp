#include "tests/ga/problems.hpp"

using namespace ga;

GA_PIPELINES_HERE(Reals)
template class ga::Checkpoints<Reals>;

const Registry<Reals>& registry() {
    static const Registry<Reals> registry = [] {
        auto all = whole_vocabulary<Reals>();
        all.add({"mean",
                 [](const Individual<Vector>& a, const Individual<Vector>& b) -> std::optional<Vector> {
                     if (a.identity == b.identity)
                         return std::nullopt;
                     Vector child = a.genome;
                     for (std::size_t i = 0; i < child.size(); ++i)
                         child[i] = (a.genome[i] + b.genome[i]) / 2;
                     return child;
                 }},
                "the parents' mean");
        all.add({"none", [](const auto&, const auto&) { return std::optional<Vector>(); }}, "no child");
        return all;
    }();
    return registry;
}
Stage<Reals> reals(const std::string& pipeline) { return Parser<Reals>(registry()).parse(pipeline); }

Result<Vector> run(const std::string& pipeline, const Reals& problem, const Population<Vector>& start,
                   const RunOptions& options, const Observers& observers, Checkpointer<Reals>* keeper) {
    return run(reals(pipeline), problem, start, options, observers, keeper);
}

std::string bits_of(const Result<Vector>& result) {
    return json({result.population, result.best ? json(*result.best) : json(), result.counters, result.notes})
        .dump();
}
