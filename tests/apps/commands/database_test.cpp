#include "domain/accuracy/respond.hpp"
#include "domain/database/sqlite.hpp"
#include "domain/database/store.hpp"
#include "domain/mwm/genome_json.hpp"
#include "domain/response/curve.hpp"
#include "domain/target/similarity.hpp"
#include "tests/apps/program.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <random>

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

/// Kills builds of one file without warning until `kills` have hit, then finishes it: nothing may be lost.
void kill_and_resume(int kills) {
    const Folder folder;
    const std::string flags = " --genomes 1500 --batch 20 --nodes 256 --threads 1";
    const Ended unbroken = rugosa("database build whole.db" + flags, folder.path());
    REQUIRE(unbroken.code == 0);
    const auto whole = pressures(folder / "whole.db");
    std::mt19937_64 random(1);
    std::size_t stored = 0;
    int files = 0;
    std::string file = "0.db";
    for (int hit = 0; hit < kills;) {
        const double share = std::uniform_real_distribution<double>(0.1, 0.6)(random);
        const Ended ended =
            rugosa_killed(share * unbroken.seconds, "database build " + file + flags, folder.path());
        if (ended.code == 0) { // done before it was hit: begin another file
            REQUIRE(++files < 10 * kills);
            file = std::to_string(files) + ".db";
            stored = 0;
            continue;
        }
        ++hit;
        if (!rough::GenomeStore::begun(folder / file))
            continue; // killed before the file was made
        const auto left = pressures(folder / file);
        CHECK(left.size() >= stored);
        CHECK(left.size() % 20 == 0);
        for (const auto& [index, row] : left)
            REQUIRE(row == whole.at(index));
        stored = left.size();
    }
    REQUIRE(rugosa("database build " + file + flags, folder.path()).code == 0);
    CHECK(pressures(folder / file) == whole);
    rough::Sqlite finished(folder / file, rough::Sqlite::Access::existing);
    rough::Statement check(finished, "PRAGMA integrity_check");
    REQUIRE(check.step());
    CHECK(check.bytes(0) == "ok");
}

} // namespace

TEST_CASE("a database build that is killed without warning loses nothing that was stored") {
    kill_and_resume(3);
}

TEST_CASE("20 kills without warning lose nothing that was stored", "[long]") { kill_and_resume(20); }

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

TEST_CASE("a database of another model is refused in one line that names the difference") {
    const Folder folder;
    REQUIRE(rugosa("database build g.db --genomes 10 --nodes 64", folder.path()).code == 0);
    const std::string target = RUGOSA_TEST_DATA "/target_paper.csv";
    for (const auto& [words, difference] : std::vector<std::pair<std::string, std::string>>{
             {"build g.db --genomes 20 --nodes 128", "nodes is 64, not 128"},
             {"build g.db --genomes 20 --nodes 64 --kernel strip", "kernel is free, not strip"},
             {"build g.db --genomes 20 --nodes 64 --seed 9", "seed is 1, not 9"},
             {"query g.db --target " + target + " --nodes 64 --steps 10", "steps is 20, not 10"},
             {"query g.db --target " + target + " --nodes 64 --datum 2", "datum_mm is 0.84941"}}) {
        const auto refused = rugosa("database " + words, folder.path());
        check_refused(refused, difference);
    }
    CHECK(rugosa("database build g.db --genomes 20", folder.path()).code == 0); // as the file is
    CHECK(pressures(folder / "g.db").size() == 20);
}

TEST_CASE("wrong use of the database is refused in one line, and no file is left") {
    const Folder folder;
    folder.write("text.db", "no database");
    for (const std::string words :
         {"build", "build x.db --genomes 0", "build x.db --datum 0.1", "build x.db --gamma-from 1",
          "build none/x.db", "build text.db", "info none.db", "info text.db", "query text.db",
          "query none.db --target t.csv", "bild x.db", "build x.db --shortest 5"}) {
        const auto refused = rugosa("database " + words, folder.path());
        INFO(words << ": " << refused.err);
        CHECK(refused.code == 2);
        CHECK(refused.error_lines() == 1);
    }
    CHECK(folder.names() == std::vector<std::string>{"text.db"});
}

TEST_CASE(
    "databases of two machines are merged into a new file, and none that is read or there is written over") {
    const Folder folder;
    const std::string flags = " --nodes 64 --seed 3 --threads 1 --genomes ";
    REQUIRE(rugosa("database build a.db" + flags + "30", folder.path()).code == 0);
    REQUIRE(rugosa("database build b.db" + flags + "30 --first 20", folder.path()).code == 0);
    REQUIRE(rugosa("database build whole.db" + flags + "50", folder.path()).code == 0);
    const Ended merged = rugosa("database merge a.db b.db --out c.db", folder.path());
    INFO(merged.err);
    REQUIRE(merged.code == 0);
    CHECK_THAT(merged.out, Catch::Contains("c.db: 50 genomes of 2 files"));
    CHECK(pressures(folder / "c.db") == pressures(folder / "whole.db"));
    for (const auto& [words, why] : {std::pair("a.db b.db --out c.db", "exists"),
                                     {"a.db b.db --out a.db --force", "is read here"},
                                     {"a.db --out d.db", "two genome databases"},
                                     {"a.db none.db --out d.db", "none.db"}}) {
        check_refused(rugosa(std::string("database merge ") + words, folder.path()), why);
    }
    CHECK_FALSE(std::filesystem::exists(folder / "d.db"));
    CHECK(rugosa("database merge a.db b.db --out c.db --force", folder.path()).code == 0);
}
