#include "domain/problem/verification.hpp"
#include "tests/apps/results.hpp"

using namespace app::testing;

TEST_CASE("an interrupted build reports its genomes, exits with 130 and leaves whole batches") {
    const Folder folder;
    const std::string build = "database build g.db --genomes 1000000 --batch 10 --nodes 256 --threads 1";
    const Ended stopped = rugosa_stopped(0.2, "g.db", build, folder.path());
    CHECK(stopped.code == 130);
    CHECK_THAT(stopped.out, Catch::Contains("genomes stored"));
    const std::string info = done(folder, "database info g.db").out;
    CHECK(std::stol(info.substr(info.find("genomes ") + 8)) % 10 == 0);
}

TEST_CASE("a query lists the nearest genomes with similarities that can be recomputed") {
    const Folder folder;
    const std::string target = RUGOSA_SOURCE "/experiments/targets/heldout.csv";
    done(folder, "database build g.db --genomes 300");
    const Ended answer =
        done(folder, "database query g.db --target " + target + " --max-pressure 1.6e-4 --best 3 --out best.json");
    CHECK_THAT(answer.out, Catch::Contains("300 curves screened"));
    double similarity = 0, worst = 0;
    const char* row = std::strstr(answer.out.c_str(), "\n   1 ");
    REQUIRE((row && std::sscanf(row, " 1 %*d %lf %lf", &similarity, &worst) == 2));
    const rough::DesignSetup setup{.targets = {rough::read_target(target)}, .max_pressure = 1.6e-4};
    const rough::Genome best = rough::read_genome(folder / "best.json");
    CHECK(respond(best, setup.model).pressure[19] == Approx(1.6e-4));
    const rough::Verification again = rough::Verifier(setup).of(best);
    CHECK(again.similarity == Approx(similarity).margin(1e-6));
    CHECK(again.worst == Approx(worst).margin(1e-6));
    CHECK(rugosa("database query g.db --target " + target + " --out best.json", folder.path()).code == 2);
}

TEST_CASE("a query verifies a genome whose stored load steps are too few for the target") {
    const Folder folder; // K grows from 0.1 % of the stored curves' last load
    std::string target = "pressure_MPa,stiffness_MPa_per_mm\n", pressures;
    std::vector<double> wanted;
    for (int p = 5; p <= 100; p += 5) {
        wanted.push_back(20000 + 600 * p);
        target += std::to_string(p) + "," + std::to_string(wanted.back()) + "\n";
        pressures += (pressures.empty() ? "" : ",") + std::to_string(p);
    }
    rough::write_atomically(folder / "T.csv", target);
    const std::string body = " --modulus 210000 --poisson 0.3 --length 2";
    done(folder, "database build g.db --genomes 2000");
    const Ended answer = done(folder, "database query g.db --target T.csv --best 1 --out near.json" + body);
    double worst = 0;
    REQUIRE(std::sscanf(answer.out.c_str() + answer.out.find("\n   1 "), " 1 %*d %*f %lf", &worst) == 1);
    done(folder, "contact --genome near.json --out curve.csv --pressures " + pressures + body);
    const auto rows = rows_of(folder / "curve.csv");
    REQUIRE(rows.size() == wanted.size());
    double misfit = 0; // misfit of tangents
    for (std::size_t i = 0; i < rows.size(); ++i) misfit = std::max(misfit, std::abs(rows[i][3] / wanted[i] - 1));
    CHECK(worst < 1 - misfit + 0.05);
}
