#include "apps/experiments/compare/benchmarks.hpp"
#include "apps/experiments/compare/pagmo.hpp"

namespace app {

const std::map<std::string, Contestants>& usual_contestants() {
    static const std::map<std::string, Contestants> all = [] {
        const std::string on = "repeat 1000000000 { ";
        const std::string vary = "tournament 2 | cross sbx rate=0.9 | mutate 1/n polynomial | ";
        const std::string converged = "until stagnation 1000 converged 1e-12 ";
        std::map<std::string, Contestants> all{
            {"real",
             {{"ga", "sample 40 | score | " + on + vary + "score | elite 2 } | best 1"},
              {"blend",
               "sample 40 | score | " + on +
                   "tournament 2 | cross blend | mutate 1/n gaussian 0.02 | score | plus } | best 1"},
              {"bobyqa", "sample 1 | score | refine nlopt LN_BOBYQA 2000"},
              {"bipop-cma-es", "sample 10 | score | best 1 | " + on + "cma-es | score } | best 1"},
              {"rand-1-bin", "sample 20 | score | " + converged + "{ de F=0.8 | score | duel } | best 1"},
              {"rand-1-exp",
               "sample 20 | score | " + converged + "{ de F=0.8 crossing=exp | score | duel } | best 1"},
              {"lshade", "sample 18n | score | " + on + "l-shade | score | duel } | best 1"}}},
            {"fronts",
             {{"nsga2",
               "sample 100 | pareto objectives | " + on + vary + "pareto objectives | plus 100 } | front"},
              {"random", "sample 1000 | pareto objectives | front"}}},
            {"bits",
             {{"ga", "sample 40 | score | " + on +
                         "tournament 2 | cross uniform rate=0.9 | mutate 1/n | score | elite 2 } | best 1"},
              {"one-plus-one", "sample 1 | score | " + on + "mutate 1/n | score | plus 1 } | best 1"}}},
            {"tours",
             {{"ga",
               "sample 40 | score | " + on +
                   "tournament 2 | cross order rate=0.9 | mutate 1/n reverse | score | elite 2 } | best 1"},
              {"one-plus-one",
               "sample 1 | score | " + on + "mutate 1/n reverse | score | plus 1 } | best 1"}}},
            {"surfaces",
             {{"default", "default"},
              {"multistart", "multistart"},
              {"plain", "plain"},
              {"lm", "restarts 1000 { sample 1 | score | refine lm 40 } | best 1"},
              {"memetic",
               "shape 24 | score | best 8 | " + on +
                   "tournament 2 | cross uniform | mutate 0.1 | score | refine lm 4 | elite 2 } | best 1"},
              {"cma-es", "shape 1 | score | " + on + "cma-es | score } | best 1"},
              {"lshade", "sample 200 | score | " + on + "l-shade | score | duel } | best 1"}}},
        };
        for (const std::string& name : pagmo_variants())
            all["real"].emplace_back(name, name);
        return all;
    }();
    return all;
}

} // namespace app
