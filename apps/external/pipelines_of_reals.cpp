#include "apps/external/problem.hpp"
#include "ga/text/whole_vocabulary.hpp"

GA_PIPELINES_HERE(app::OutsideProblem<std::vector<double>>)
template ga::Registry<app::OutsideProblem<std::vector<double>>> ga::whole_vocabulary();
