#pragma once

#include "domain/accuracy/respond.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/target/similarity.hpp"
#include "tests/domain/random_genome.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rough::testing {

/// The curves of random genomes that are in no database: one or two series, waves down to the spacing of the
/// paper's grid or to eight times it. Twenty points each, up to 1.6e-4 MPa.
inline std::vector<Target> random_targets(int count, unsigned seed) {
    constexpr double highest = 1.6e-4;
    std::vector<Target> targets;
    const Model paper;
    std::mt19937_64 random(seed);
    for (int i = 0; i < count; ++i) {
        const double shortest = paper.grid.spacing() * (i % 3 == 0 ? 1 : 8);
        const Response response =
            respond(random_genome(random, 1 + i % 2, 1, paper.grid.length, shortest), paper);
        const Curve curve = stretched(secant_stiffness(response), highest / response.pressure.tail(1)[0]);
        Target target;
        target.name = "random genome " + std::to_string(i + 1);
        target.x = Eigen::VectorXd::LinSpaced(20, highest / 20, highest);
        target.y = target.x.unaryExpr([&](double p) { return curve.at(p); });
        targets.push_back(target);
    }
    return targets;
}

/// The paper's two targets and 18 random ones.
inline std::vector<Target> twenty_targets(const std::filesystem::path& data) {
    std::vector<Target> targets{read_target(data / "target_paper.csv"),
                                read_target(data / "target_heldout.csv")};
    for (Target& target : random_targets(18, 60))
        targets.push_back(std::move(target));
    return targets;
}

} // namespace rough::testing
