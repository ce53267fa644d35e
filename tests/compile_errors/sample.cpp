// Not to be compiled: this problem cannot draw the genomes that `sample` asks of it.
#include "ga/ga.hpp"

struct Silent {
    using Genome = std::vector<double>;
    using Outcome = double;
    std::vector<ga::Objective<double>> list{{"first", [](const double& value) { return value; }}};

    double evaluate(const Genome& genome) const { return genome[0]; }
    const std::vector<ga::Objective<double>>& objectives() const { return list; }
};

int main() {
    using namespace ga;
    run(sample(5) | score(), Silent(), population<Silent::Genome>({{1.0}}), {});
}
