// Compiled where Eigen's and NLopt's headers are errors.
#include "ga/checkpoint/checkpoint.hpp"
#include "ga/observers/hall_of_fame.hpp"
#include "ga/observers/log.hpp"
#include "ga/pipeline/ask_tell.hpp"
#include "ga/text/compiled_once.hpp"
#include "ga/text/listing.hpp"

struct Ones {
    using Genome = std::vector<bool>;
    using Outcome = double;
    std::vector<ga::Objective<double>> list{{"ones", [](const double& value) { return value; }}};

    double evaluate(const Genome& bits) const {
        return static_cast<double>(std::count(bits.begin(), bits.end(), true));
    }
    const std::vector<ga::Objective<double>>& objectives() const { return list; }
};
GA_PIPELINES_ELSEWHERE(Ones)

double most_ones(const Ones& problem) {
    const auto stage = ga::Parser<Ones>(ga::vocabulary<Ones>()).parse("score | best 1");
    return ga::run(stage, problem, ga::population<Ones::Genome>({{true, false}})).best->value();
}
