#include "apps/external/problem.hpp"
#include "ga/text/whole_vocabulary.hpp"

GA_PIPELINES_HERE(app::OutsideProblem<std::vector<bool>>)
GA_PIPELINES_HERE(app::OutsideProblem<ga::Permutation>)
template ga::Registry<app::OutsideProblem<std::vector<bool>>> ga::whole_vocabulary();
template ga::Registry<app::OutsideProblem<ga::Permutation>> ga::whole_vocabulary();
