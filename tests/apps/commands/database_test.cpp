#include "domain/database/store.hpp"
#include "domain/mwm/genome_json.hpp"
#include "domain/problem/verification.hpp"
#include "domain/response/curve.hpp"
#include "domain/text/atomic_file.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>

using namespace app::testing;

namespace {

/// The stored pressures by genome, one row each.
std::map<std::uint64_t, std::vector<double>> pressures(const std::filesystem::path& file) {
    const rough::GenomeStore store = rough::GenomeStore::open(file);
    const auto steps = static_cast<std::size_t>(store.setup().model.loading.steps);
    const rough::StoredCurves curves = store.curves();
    std::map<std::uint64_t, std::vector<double>> rows;
    for (std::size_t i = 0; i < curves.index.size(); ++i) {
        const auto row = curves.pressure.begin() + static_cast<std::ptrdiff_t>(i * steps);
        rows[curves.index[i]] = {row, row + static_cast<std::ptrdiff_t>(steps)};
    }
    REQUIRE(rows.size() == curves.index.size());
    return rows;
}

} // namespace

TEST_CASE("two programs building one database at once make the same file as one") {
    const Folder folder;
    const std::string flags = " --genomes 600 --batch 10 --nodes 128 --threads 1";
    const std::string build = "'" RUGOSA_PROGRAM "' database build both.db" + flags + " >>log 2>&1";
    REQUIRE(rugosa("database build one.db" + flags, folder.path()).code == 0);
    const std::string both = "cd '" + folder.path().string() + "' && { " + build + " & " + build +
                             "; a=$?; wait $!; exit $((a + $?)); }";
    CHECK(std::system(("bash -c \"" + both + "\"").c_str()) == 0);
    CHECK(pressures(folder / "both.db") == pressures(folder / "one.db"));
}

TEST_CASE("an interrupted build says how far it came, exits with 130 and goes on later") {
    const Folder folder;
    const std::string flags = " --genomes 1000000 --batch 10 --nodes 256 --threads 1";
    CHECK(rugosa_stopped(0.2, "g.db", "database build g.db" + flags, folder.path()) == 130);
    CHECK_THAT(rough::read_whole(folder / "log"), Catch::Contains("genomes stored"));
    CHECK(pressures(folder / "g.db").size() % 10 == 0);
    CHECK(rugosa("database info g.db", folder.path()).code == 0);
}

TEST_CASE("a query names the nearest stored genomes, and every similarity can be computed again") {
    const Folder folder;
    const std::string target = RUGOSA_TEST_DATA "/target_heldout.csv";
    REQUIRE(rugosa("database build g.db --genomes 300", folder.path()).code == 0);
    const auto answer =
        rugosa("database query g.db --target " + target + " --max-pressure 1.6e-4 --best 3 --out best.json",
               folder.path());
    INFO(answer.out << answer.err);
    REQUIRE(answer.code == 0);
    CHECK_THAT(answer.out, Catch::Contains("300 curves screened"));
    const auto row = answer.out.find("\n   1 ");
    REQUIRE(row != std::string::npos);
    long genome = 0;
    double similarity = 0, worst = 0;
    REQUIRE(std::sscanf(answer.out.c_str() + row, " 1 %ld %lf %lf", &genome, &similarity, &worst) == 3);
    rough::DesignSetup setup;
    setup.targets = {rough::read_target(target)};
    setup.max_pressure = 1.6e-4;
    const rough::Genome best = rough::read_genome(folder / "best.json");
    CHECK(respond(best, completed(setup).model).pressure[19] == Approx(1.6e-4));
    const rough::Verification again = rough::Verifier(completed(setup)).of(best);
    CHECK(again.similarity == Approx(similarity).margin(1e-6));
    CHECK(again.worst() == Approx(worst).margin(1e-6));
    CHECK(rugosa("database query g.db --target " + target + " --out best.json", folder.path()).code == 2);
}

TEST_CASE("a query does not believe stored load steps that are too few for its target") {
    const Folder folder; // K grows with the load from a tenth of a per cent of the stored curves' on
    std::string target = "pressure_MPa,stiffness_MPa_per_mm\n", pressures;
    std::vector<double> wanted;
    for (int p = 5; p <= 100; p += 5) {
        wanted.push_back(20000 + 600 * p);
        target += std::to_string(p) + "," + std::to_string(wanted.back()) + "\n";
        pressures += (pressures.empty() ? "" : ",") + std::to_string(p);
    }
    rough::write_atomically(folder / "T.csv", target);
    const std::string body = " --modulus 210000 --poisson 0.3 --length 2";
    REQUIRE(rugosa("database build g.db --genomes 2000", folder.path()).code == 0);
    const auto answer =
        rugosa("database query g.db --target T.csv --best 1 --out near.json" + body, folder.path());
    INFO(answer.out << answer.err);
    REQUIRE(answer.code == 0);
    double worst = 0;
    REQUIRE(std::sscanf(answer.out.c_str() + answer.out.find("\n   1 "), " 1 %*d %*f %lf", &worst) == 1);
    REQUIRE(
        rugosa("contact --genome near.json --out curve.csv --pressures " + pressures + body, folder.path())
            .code == 0);
    const auto rows = rows_of(folder / "curve.csv");
    REQUIRE(rows.size() == wanted.size());
    double misfit = 0; // of tangents
    for (std::size_t i = 0; i < rows.size(); ++i)
        misfit = std::max(misfit, std::abs(rows[i][3] / wanted[i] - 1));
    CHECK(worst < 1 - misfit + 0.05);
}
