// Not to be compiled: these members' signatures are others than ga asks for, so they would be passed over.
#include "ga/ga.hpp"

struct Misfit {
    using Genome = std::vector<double>;
    using Outcome = double;
    std::vector<ga::Objective<double>> list{{"first", [](const double& value) { return value; }}};

    double evaluate(const Genome& genome) const { return genome[0]; }
    const std::vector<ga::Objective<double>>& objectives() const { return list; }
    std::vector<ga::Variable> bounds() const { return {{0, -1, 1}}; }
    int valid(const Genome&) const { return 1; }
    bool valid_outcome() const { return true; }
    bool mutate(Genome&, ga::Stream&) const { return false; }
    void cross_uniform(Genome&, Genome&) const {}
    void cross_points(Genome&, Genome&, ga::Stream&) const {}
    double distance(const Genome&) const { return 0; }
    double violations(const Outcome&) const { return 0; }
    std::vector<ga::Descriptor<Genome>> descriptors() const { return {}; }
};

int main() {
    using namespace ga;
    run(score(), Misfit(), population<Misfit::Genome>({{1.0}}), {});
}
