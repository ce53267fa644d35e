// Fits the cost model of domain/contact/choice.cpp, and verifies the choices made by it. The first argument
// seeds the profiles.

#include "domain/response/response.hpp"
#include "tests/benchmarks/measure.hpp"
#include "tests/domain/random_genome.hpp"

#include <Eigen/QR>

#include <cstdio>

using namespace rough;

namespace {

struct Measured {
    double nodes, steps, contact;         ///< contact: nodes at the last step
    double nested, active_set, automatic; ///< s; nested is 0 if it would take too long

    double transforms() const { return steps * nodes * std::log2(2 * nodes); }
    double faster() const { return nested > 0 ? std::min(nested, active_set) : active_set; }
    bool is_near_crossing() const { return nested > 0 && std::abs(std::log(nested / active_set)) < std::log(7.0); }
};

Profile random_profile(std::mt19937_64& random, Index nodes, double shortest, bool periodic) {
    const double length = 0.84942;
    const auto uniform = [&](double from, double to) { return testing::uniform(random, from, to); };
    return sample(testing::random_genome(uniform, 1, 1, length, shortest * length, {.A_from = 1, .A_to = 1}),
                  {nodes, length, periodic});
}

Measured measured(const Profile& profile, Kernel kernel, int steps, double reach) {
    constexpr double most_contact = 5000;
    Body body;
    body.kernel = kernel;
    body.datum = 0.84942, body.strip_width = 0.84942 / 511;
    const auto displacements = step_displacements(profile, body, {.steps = steps, .reach = reach});
    Measured m{static_cast<double>(profile.nodes()), static_cast<double>(steps), 0, 0, 0, 0};
    ContactCurve curve;
    const auto seconds = [&](Solver solver) {
        ContactOptions options;
        options.solver = solver;
        return testing::least_seconds([&] { curve = solve_contact(profile, body, displacements, options); }, 3);
    };
    m.active_set = seconds(Solver::active_set);
    m.contact = static_cast<double>(curve.steps.back().contact_nodes);
    if (m.contact <= most_contact) m.nested = seconds(Solver::nested);
    m.automatic = seconds(Solver::automatic);
    return m;
}

/// Fits the time of each term, ns, with least relative error over the curves near the crossing.
template <typename Terms>
void print_fit(const char* what, const std::vector<Measured>& runs, double Measured::*seconds, Terms terms) {
    std::vector<Eigen::VectorXd> rows;
    for (const Measured& run : runs)
        if (run.is_near_crossing()) rows.push_back(terms(run) / (run.*seconds * 1e9));
    Eigen::MatrixXd matrix(static_cast<Index>(rows.size()), rows.front().size());
    for (std::size_t k = 0; k < rows.size(); ++k) matrix.row(static_cast<Index>(k)) = rows[k];
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(matrix.rows());
    const Eigen::VectorXd found = matrix.colPivHouseholderQr().solve(ones);
    std::printf("%s:", what);
    for (const double value : found) std::printf(" %.3g", value);
    std::printf(" ns; off by %.2g (root mean square of %ld curves)\n",
                std::sqrt((matrix * found - ones).squaredNorm() / static_cast<double>(matrix.rows())),
                static_cast<long>(matrix.rows()));
}

void print_choices(const std::vector<Measured>& runs, double nodes) {
    double sum = 0, worst = 0, count = 0;
    for (const Measured& run : runs)
        if (run.nodes == nodes) {
            const double loss = run.automatic / run.faster();
            sum += std::log(loss);
            worst = std::max(worst, loss);
            ++count;
        }
    std::printf("N = %g: auto takes %.3g times as long as the faster (geometric mean), at most %.3g, %g curves\n",
                nodes, std::exp(sum / count), worst, count);
}

} // namespace

int main(int count, char** words) {
    std::mt19937_64 random(count > 1 ? std::stoul(words[1]) : 1);
    const std::vector<Index> grids{512, 768, 1024, 2048, 4096, 8192, 16384, 65536};
    std::vector<Measured> runs;
    for (const Index nodes : grids)
        for (const double shortest : {1.0, 1 / 8.0, 1 / 64.0, 1 / 511.0})
            for (const Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip})
                for (const double reach : {0.1, 0.4, 0.9}) {
                    const int steps = std::array{5, 20, 80}[runs.size() % 7 % 3];
                    const Profile profile = random_profile(random, nodes, shortest, kernel == Kernel::periodic);
                    runs.push_back(measured(profile, kernel, steps, reach));
                }
    print_fit("nested, of steps N log2 2N, steps m^2, m^3/6", runs, &Measured::nested, [](const Measured& run) {
        const double m = run.contact;
        return Eigen::VectorXd(Eigen::Vector3d(run.transforms(), run.steps * m * m, m * m * m / 6));
    });
    print_fit("active set, of steps N log2 2N", runs, &Measured::active_set,
              [](const Measured& run) { return Eigen::VectorXd(Eigen::VectorXd::Constant(1, run.transforms())); });
    for (const Index nodes : grids) print_choices(runs, static_cast<double>(nodes));
}
