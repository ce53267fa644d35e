#include "domain/accuracy/respond.hpp"
#include "domain/database/store.hpp"
#include "domain/mwm/genome_json.hpp"
#include "domain/response/curve.hpp"
#include "domain/target/similarity.hpp"
#include "tests/apps/program.hpp"

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

TEST_CASE(
    "a query names the nearest stored genomes and writes the best, whose similarity can be computed again") {
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
    double similarity = 0, finer = 0;
    REQUIRE(std::sscanf(answer.out.c_str() + row, " 1 %ld %lf %lf", &genome, &similarity, &finer) == 3);
    const rough::Model model;
    const auto response = respond(rough::read_genome(folder / "best.json"), model);
    CHECK(response.pressure[19] == Approx(1.6e-4));
    CHECK(rough::similarity(rough::read_target(target), rough::secant_stiffness(response)) ==
          Approx(similarity).margin(1e-6));
    CHECK(std::abs(finer - similarity) < 0.1);
    CHECK(rugosa("database query g.db --target " + target + " --out best.json", folder.path()).code == 2);
}
