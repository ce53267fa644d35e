// Not to be compiled: this problem's `bounds` takes no genome, so it would be passed over.
#include "ga/ga.hpp"

struct Misfit {
    using Genome = std::vector<double>;
    using Outcome = double;
    std::vector<ga::Objective<double>> list{{"first", [](const double& value) { return value; }}};

    double evaluate(const Genome& genome) const { return genome[0]; }
    const std::vector<ga::Objective<double>>& objectives() const { return list; }
    std::vector<ga::Variable> bounds() const { return {{0, -1, 1}}; }
};

int main() {
    using namespace ga;
    run(score(), Misfit(), population<Misfit::Genome>({{1.0}}), {});
}
