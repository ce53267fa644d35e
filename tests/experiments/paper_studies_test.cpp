#include "experiments/paper/paper.hpp"
#include "tests/catch.hpp"

using namespace app;

TEST_CASE("condition (10) holds always, Eq. 8 for half of all phases, and a lost pair costs what an integral "
          "says") {
    // For M = 2 the lost pair leaves |cos a + cos b| <= sqrt(2); the share by the midpoint rule.
    constexpr int cells = 1000;
    int held = 0;
    for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j)
            held += std::abs(std::cos(2 * M_PI * (i + 0.5) / cells) + std::cos(2 * M_PI * (j + 0.5) / cells)) <=
                    std::sqrt(2.0);
    const double share = held / double(cells * cells);
    constexpr int sets = 20000;
    for (const RidgeCount& count : ridge_study({2, 3, 17, 200}, sets, 4)) {
        CHECK(count.as_printed == 1);
        CHECK(count.right_phase == Approx(0.5).margin(4 * 0.5 / std::sqrt(sets)));
        if (count.ridges == 2)
            CHECK(count.last_missing == Approx(share).margin(4 * 0.5 / std::sqrt(sets)));
        else
            CHECK(count.last_missing < 1);
    }
}

TEST_CASE("a genome's curves change without half of its waves, and no node loses contact") {
    PaperRun run;
    run.model.grid.nodes = 64;
    run.model.loading.steps = 8;
    run.model = completed(run.model);
    run.max_pressure = 1e-4;
    run.database = answered({rough::Genome{1, {{1, 0.8, 2, run.model.grid.length, {{1, {0.3}}, {2, {1}}}}}}}, run.model,
                            run.max_pressure, 1);
    const Studies studies = studies_of(run);
    const GenomeStudy& study = studies.genomes.at(0);
    for (const Removal& removal : {study.without_coarse, study.without_fine}) {
        CHECK(removal.stiffness > 0);
        CHECK(removal.area > 0);
    }
    CHECK(study.without_coarse.stiffness > study.without_fine.stiffness);
    double nodes = 0; // summed over all steps except the last
    for (int j = 0; j < 7; ++j) nodes += 64 * run.database[0].response.contact_fraction[j];
    CHECK(study.contacts.nodes == Approx(nodes));
    CHECK(study.contacts.lost == 0);
}
