#include "tests/ga/problems.hpp"

#include "tests/catch.hpp"
#include "tests/folder.hpp"

using namespace ga;

GA_PIPELINES_HERE(Reals)
template class ga::Checkpoints<Reals>;

const Registry<Reals>& registry() {
    static const Registry<Reals> registry = [] {
        auto all = whole_vocabulary<Reals>();
        all.add({"mean",
                 [](const Individual<Vector>& a, const Individual<Vector>& b) -> std::optional<Vector> {
                     if (a.identity == b.identity) return std::nullopt;
                     Vector child = a.genome;
                     for (std::size_t i = 0; i < child.size(); ++i) child[i] = (a.genome[i] + b.genome[i]) / 2;
                     return child;
                 }},
                "the parents' mean");
        all.add({"none", [](const auto&, const auto&) { return std::optional<Vector>(); }}, "no child");
        return all;
    }();
    return registry;
}
Pipeline<Reals> reals(const std::string& pipeline) { return Parser<Reals>(registry()).parse(pipeline); }

Result<Vector> run(const std::string& pipeline, const Reals& problem, const Population<Vector>& start,
                   const RunOptions& options, const Observers& observers, Checkpointer<Reals>* keeper) {
    return run(reals(pipeline), problem, start, options, observers, keeper);
}

Result<Vector> in_pieces(const std::string& pipeline, const Reals& problem, long step, const RunOptions& given,
                         const Observers& observers, const std::function<void(Checkpoints<Reals>&)>& prepare) {
    const tests::Folder folder;
    for (int piece = 0;; ++piece) {
        REQUIRE(piece < 1000);
        std::atomic<bool> stop = false;
        std::atomic<long> left = step;
        Reals stopping = problem;
        stopping.f = [&](const Vector& x) {
            if (--left == 0) stop = true;
            return problem.f(x);
        };
        RunOptions options = given;
        options.threads = 1 + piece % 3;
        options.budget.stop = &stop;
        Checkpoints<Reals> checkpoints(folder / "run", "", true, piece % 2 ? 1000 : 0);
        if (prepare) prepare(checkpoints);
        auto part = run(pipeline, stopping, {}, options, observers, &checkpoints);
        if (part.stopped != "stop requested") {
            CHECK(piece > 0);
            return part;
        }
    }
}

std::string bits_of(const Result<Vector>& result) {
    return json({result.population, result.best ? json(*result.best) : json(), result.counters, result.notes}).dump();
}
