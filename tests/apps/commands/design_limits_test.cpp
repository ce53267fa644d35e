#include "domain/mwm/genome_json.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/mwm/waves.hpp"
#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

using namespace app::testing;
using nlohmann::json;

TEST_CASE("every variant's answer holds every limit, on a grid four times finer too") {
    const Folder folder;
    const double slope = 6e-4, height = 2e-4, radius = 5, wave = 0.04;
    const std::vector<std::string> all{"default", "multistart", "plain", "sog", "gco", "cco"};
    const std::vector<std::string> few{"default", "sog", "gco"}; // Eq. 11 leaves amplitude no freedom
    for (const std::string mode : {"", " --max-pressure 1.6e-4"})
        for (const std::string& variant : mode.empty() ? all : few) {
            const std::string words = "design --target '" RUGOSA_TEST_DATA "/target_paper.csv' --nodes 128 "
                                      "--pictures off --max-slope 6e-4 --max-height 2e-4 "
                                      "--min-radius 5 --shortest-wave 0.04 --force --out r --variant " +
                                      variant + mode;
            const Ended ended = rugosa(words, folder.path());
            INFO(variant << mode << ": " << ended.out << ended.err);
            REQUIRE(ended.code != 2);
            const json answer = result_in(folder / "r")["variants"][variant];
            CHECK(answer["within_limits"] == true);
            for (const json& margin : answer["margins"])
                CHECK(margin["margin"].get<double>() >= 0);
            for (const json& alternative : answer["alternatives"]) {
                const rough::Genome genome = rough::genome_from_json(alternative["genome"], "genome");
                const rough::Profile fine = sample(genome, rough::refined({128, 0.84942, false}, 4));
                const rough::Index n = fine.nodes();
                const Eigen::VectorXd steep =
                    (fine.heights.tail(n - 1) - fine.heights.head(n - 1)) / fine.spacing;
                const Eigen::VectorXd bend = (steep.tail(n - 2) - steep.head(n - 2)) / fine.spacing;
                CHECK(steep.cwiseAbs().maxCoeff() <= slope);
                CHECK(fine.heights.maxCoeff() - fine.heights.minCoeff() <= height);
                CHECK(bend.cwiseAbs().maxCoeff() <= 1 / radius);
                for (const rough::Series& series : genome.series)
                    for (const rough::Chromosome& chromosome : series.chromosomes)
                        CHECK(wave_length(series, chromosome.n) >= wave * (1 - 1e-9));
            }
        }
}

TEST_CASE("a design's genes keep to the bounds that were given") {
    const Folder folder;
    const Ended ended =
        rugosa("design --target '" RUGOSA_TEST_DATA "/target_paper.csv' --nodes 64 --shortest-wave 0.1 "
               "--pictures off --pipeline 'sample 8 | score | refine lm 3 | best 1' --hurst-from 0.6 "
               "--hurst-to 0.65 "
               "--gamma-from 1.75 --gamma-to 1.8 --lambda-from 0.5 --lambda-to 0.6 --out r",
               folder.path());
    INFO(ended.err << ended.out);
    REQUIRE(ended.code != 2);
    const json all = result_in(folder / "r")["variants"]["pipeline"]["genome"]["series"];
    REQUIRE_FALSE(all.empty());
    for (const json& series : all)
        for (const auto& [gene, from, to] :
             {std::tuple("H", 0.6, 0.65), std::tuple("gamma", 1.75, 1.8), std::tuple("lambda", 0.5, 0.6)}) {
            CHECK(series[gene].get<double>() >= from);
            CHECK(series[gene].get<double>() <= to);
        }
}
