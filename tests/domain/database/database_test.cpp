#include "domain/errors.hpp"
#include "domain/mwm/response.hpp"
#include "domain/text/atomic_file.hpp"
#include "tests/catch.hpp"
#include "tests/domain/database/small_setup.hpp"
#include "tests/folder.hpp"

#include <SQLiteCpp/SQLiteCpp.h>

using namespace rough;
namespace fs = std::filesystem;
using rough::testing::built;
using rough::testing::read_all;
using rough::testing::small_map_setup;
using rough::testing::small_setup;
using tests::Folder;

namespace {

void check_same(const GenomeStore& one, const GenomeStore& other) {
    const StoredCurves a = one.curves(true), b = other.curves(true);
    CHECK((a.index == b.index && a.pressure == b.pressure && a.fraction == b.fraction));
}

/// Writes a value into a database's set-up, with the checksum of its lines (store.cpp).
void set_value(const fs::path& path, const std::string& name, const std::string& value) {
    SQLite::Database file(path, SQLite::OPEN_READWRITE);
    file.exec("UPDATE setup SET value = '" + value + "' WHERE name = '" + name + "'");
    const std::string text = file.execAndGet("SELECT group_concat(name || '=' || value || char(10), '') FROM "
                                             "(SELECT * FROM setup WHERE name <> 'checksum' ORDER BY name)");
    file.exec("UPDATE setup SET value = '" + std::to_string(checksum(text)) + "' WHERE name = 'checksum'");
}

} // namespace

TEST_CASE("a law's genome is valid, within the law, and depends only on its number") {
    const GenomeDistribution law{.series = 2, .ridges = 3, .shortest = 0.05};
    for (std::uint64_t index = 0; index < 50; ++index) {
        const Genome genome = drawn(law, index);
        CHECK_NOTHROW(validate(genome, "genome"));
        CHECK(genes(genome) == genes(drawn(law, index)));
        REQUIRE(genome.series.size() == 2);
        for (const Series& series : genome.series) {
            CHECK((series.H >= 0.5 && series.H <= 1.5 && series.gamma >= 1.4 && series.gamma <= 2));
            CHECK(wave_length(series, series.chromosomes.back().n) >= 0.05);
            CHECK(wave_length(series, series.chromosomes.back().n + 1) < 0.05);
        }
    }
    CHECK(genes(drawn(law, 1)) != genes(drawn(law, 2)));
    for (const auto& [bad, problem] : {std::pair(GenomeDistribution{.gamma_from = 1}, "gamma"),
                                       {{.series = 0}, "series 0 is out of range"},
                                       {{.series = 17}, "series 17 is out of range"},
                                       {{.series = 16, .ridges = 1000, .shortest = 1e-300}, "phases per genome"}})
        CHECK_THROWS_WITH(validate(bad), Catch::Contains(problem));
}

TEST_CASE("a database has the genomes of its law and their responses to the bit") {
    const Folder folder;
    for (const DatabaseSetup& setup : {small_setup(), small_map_setup()}) {
        const fs::path path = folder / (setup.model.grid.is_2d() ? "maps.db" : "lines.db");
        built(path, {.genomes = 30, .batch = 8}, setup);
        const GenomeStore store = GenomeStore::open(path);
        CHECK(store.stored() == 30);
        CHECK(named_values(store.setup()) == named_values(setup));
        for (const std::uint64_t index : {0u, 7u, 8u, 29u}) {
            const Genome genome = drawn(setup.law, index);
            CHECK(genes(store.genome(index)) == genes(genome));
            const Response computed = respond(genome, setup.model),
                           stored = store.responses(store.batches()[index / 8])[index % 8];
            CHECK((stored.range == computed.range && stored.pressure == computed.pressure));
            CHECK(stored.contact_fraction == computed.contact_fraction);
            CHECK(stored.tangent_stiffness == computed.tangent_stiffness);
        }
        CHECK_THROWS_WITH(store.genome(30), Catch::Contains("genome 30 is not stored"));
        // A stored batch is no longer taken.
        SQLite::Database file(path);
        CHECK(file.execAndGet("SELECT COUNT(*) FROM taken").getInt() == 0);
    }
}

TEST_CASE("a stopped build resumes to the same database, whatever the pieces") {
    const Folder folder;
    {
        GenomeStore pieces = built(folder / "pieces.db", {.genomes = 25, .batch = 10});
        int batches = 0;
        build(pieces,
              {.genomes = 50, .batch = 10, .threads = 1, .go_on = [&](std::uint64_t) { return ++batches < 2; }});
        CHECK(pieces.stored() == 40);
        Span wanted{0, 50};
        CHECK(pieces.take(wanted, 10)); // a builder that is killed with its batch
        CHECK(wanted.first == 40);
    }
    GenomeStore pieces = GenomeStore::open(folder / "pieces.db");
    build(pieces, {.genomes = 50, .batch = 10});
    CHECK(pieces.stored() == 50);
    check_same(pieces, built(folder / "whole.db", {.genomes = 50, .batch = 10}));
}

TEST_CASE("a batch with more than 100 MB in a cell is refused, and nothing of it is stored") {
    const Folder folder;
    GenomeStore store = GenomeStore::create(folder / "genomes.db", small_setup());
    std::vector<Response> responses(1);
    responses[0].pressure.setZero(12'500'000); // 100 MB, before which the height range is stored
    CHECK_THROWS_WITH(store.add({0, 1}, responses), Catch::Contains("genomes.db: string or blob too big"));
    CHECK(store.stored() == 0);
}

TEST_CASE("two builders of one file share the work and store each genome once") {
    const Folder folder;
    GenomeStore one = GenomeStore::create(folder / "genomes.db", small_setup());
    GenomeStore two = GenomeStore::create(folder / "genomes.db", small_setup());
    Span wanted{0, 40};
    const auto first = one.take(wanted, 10), second = two.take(wanted, 10);
    REQUIRE((first && second));
    CHECK((first->first == 0 && second->first == 10));
    std::uint64_t other = 0;
    build(one, {.genomes = 40, .batch = 10, .go_on = [&](std::uint64_t) {
                    if (other++ == 0) build(two, {.genomes = 40, .batch = 10});
                    return true;
                }});
    CHECK(one.stored() == 40);
    CHECK(other <= 2); // the second builder computed all other batches, with those taken above
    const auto index = two.curves().index;
    for (std::size_t i = 0; i < index.size(); ++i) CHECK(index[i] == i);
    const std::vector<Response> more{response_for(small_setup(), 40)};
    CHECK((one.add({40, 1}, more) && !two.add({40, 1}, more))); // only the first stores it
}

TEST_CASE("responses computed elsewhere in any order give the same database") {
    const Folder folder;
    const auto backwards = [&](const DatabaseSetup& of, const Orders& orders) {
        CHECK(orders.count == 45);
        std::vector<std::uint64_t> all;
        while (const auto next = orders.next()) all.push_back(*next);
        for (auto i = all.rbegin(); i != all.rend(); ++i) orders.take(*i, response_for(of, *i));
    };
    check_same(built(folder / "other.db", {.genomes = 45, .batch = 10, .computing = backwards}),
               built(folder / "whole.db", {.genomes = 45, .batch = 10}));
}

TEST_CASE("merged databases hold each genome once, and others are refused with the difference") {
    const Folder folder;
    const GenomeStore whole = built(folder / "whole.db", {.genomes = 60, .batch = 10});
    built(folder / "a.db", {.genomes = 25, .batch = 7});
    built(folder / "b.db", {.genomes = 40, .first = 20, .batch = 9}); // 20 to 24 are in both
    CHECK(merge({folder / "b.db", folder / "a.db"}, folder / "c.db") == 60);
    const GenomeStore merged = GenomeStore::open(folder / "c.db");
    check_same(merged, whole);
    CHECK(shape_key(merged.genome(59)) == shape_key(whole.genome(59)));

    DatabaseSetup other = small_setup();
    other.law.seed = 2;
    built(folder / "d.db", {.genomes = 5}, other);
    built(folder / "forged.db", {.genomes = 5});
    SQLite::Database forged(folder / "forged.db", SQLite::OPEN_READWRITE);
    forged.exec("ATTACH '" + (folder / "d.db").string() + "' AS d");
    forged.exec("UPDATE genome SET (numbers, checksum) = (SELECT numbers, checksum FROM d.genome)");
    built(folder / "old.db", {.genomes = 5});
    set_value(folder / "old.db", "version", "0.0.1");
    CHECK_NOTHROW(read_all(folder / "old.db"));
    for (const auto& [file, problem] : {std::pair("d.db", "d.db: its seed is 2, not 1"),
                                        {"old.db", "old.db: made by version 0.0.1, but "},
                                        {"none.db", "none.db: does not exist"},
                                        {"forged.db", "forged.db: genome 0 is not its law's"}})
        CHECK_THROWS_WITH(merge({folder / "a.db", folder / file}, folder / "e.db"), Catch::Contains(problem));
    for (const std::string& name : folder.names()) CHECK((name != "e.db" && name.find("tmp") == std::string::npos));
}

TEST_CASE("a database of another set-up is refused with the difference and stays unchanged") {
    const Folder folder;
    const fs::path file = folder / "genomes.db";
    GenomeStore::create(file, small_setup());
    const std::string before = read_whole(file);
    DatabaseSetup datum = small_setup(), strip = datum, seed = datum;
    datum.model.body.datum = 2;
    strip.model.body.kernel = Kernel::strip;
    strip.model = completed(strip.model);
    seed.law.seed = 2;
    CHECK_THROWS_WITH(GenomeStore::create(file, datum),
                      Catch::Contains("datum_mm is 0.8494") && Catch::Contains("not 2"));
    CHECK_THROWS_WITH(GenomeStore::create(file, strip), Catch::Contains("kernel is free, not strip"));
    CHECK_THROWS_WITH(GenomeStore::create(file, seed), Catch::Contains("seed is 1, not 2"));
    CHECK(read_whole(file) == before);
    CHECK_NOTHROW(GenomeStore::create(file, small_setup()));
}

TEST_CASE("a file that is not a genome database is refused") {
    const Folder folder;
    const auto refuses = [](const fs::path& file, const char* problem) {
        CHECK_THROWS_WITH(GenomeStore::open(file), Catch::Contains(problem));
    };
    refuses(folder / "none.db", "none.db");
    refuses(folder.write("text.db", std::string(5000, 'x')), "not a genome database");
    SQLite::Database(folder / "other.db", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE).exec("CREATE TABLE t(a)");
    refuses(folder / "other.db", "not a genome database");
    CHECK_THROWS_AS(GenomeStore::create(folder / "other.db", small_setup()), InputError);
    CHECK_THROWS_AS(GenomeStore::create(folder / "missing" / "a.db", small_setup()), InputError);
    for (const char* name : {":memory:", "file:x?mode=memory", ""}) // places in memory for SQLite
        CHECK_THROWS_WITH(GenomeStore::create(name, small_setup()), Catch::Contains("is not the name of a file"));
    const fs::path empty = folder.write("empty.db", "");
    CHECK_FALSE((GenomeStore::begun(empty) || GenomeStore::begun(folder / "none.db")));
    CHECK_NOTHROW(GenomeStore::create(empty, small_setup()));
    CHECK(GenomeStore::begun(empty));
}

TEST_CASE("a database with any alteration is refused") {
    const Folder folder;
    const fs::path good = folder / "good.db";
    built(good, {.genomes = 12, .batch = 4});
    CHECK_NOTHROW(read_all(good));
    for (const char* change :
         {"UPDATE genome SET numbers = substr(numbers, 1, 100) WHERE first = 4",
          "UPDATE pressure SET numbers = substr(numbers, 1, 15)",
          "UPDATE contact SET numbers = zeroblob(length(numbers)) WHERE first = 8",
          "UPDATE batch SET count = 3 WHERE first = 4", "UPDATE batch SET count = -4 WHERE first = 4",
          "UPDATE batch SET count = 4000000000", "UPDATE pressure SET first = 100 WHERE first = 4",
          "UPDATE setup SET value = '65' WHERE name = 'nodes'", "UPDATE setup SET value = '-1' WHERE name = 'steps'",
          "DELETE FROM pressure WHERE first = 8", "DELETE FROM setup WHERE name = 'checksum'",
          "CREATE VIEW v AS SELECT 1", "CREATE TRIGGER t AFTER INSERT ON batch BEGIN DELETE FROM genome; END",
          "PRAGMA user_version = 1"}) {
        INFO(change);
        const fs::path bad = folder / "bad.db";
        fs::copy_file(good, bad, fs::copy_options::overwrite_existing);
        SQLite::Database(bad, SQLite::OPEN_READWRITE).exec(change);
        CHECK_THROWS_AS(read_all(bad), InputError);
    }
    set_value(good, "ridges", "0");
    CHECK_THROWS_WITH(GenomeStore::open(good), Catch::Contains("genome law: ridges 0 is out of range"));
}

TEST_CASE("a view with a table's name is not run") {
    const Folder folder;
    SQLite::Database(folder / "view.db", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
        .exec("PRAGMA application_id = 0x52554741; PRAGMA user_version = 2; CREATE VIEW batch AS WITH "
              "RECURSIVE n(first) AS (SELECT 1 UNION ALL SELECT first + 1 FROM n) " // has no end
              "SELECT first, 1 AS count FROM n");
    CHECK_THROWS_WITH(GenomeStore::open(folder / "view.db"), Catch::Contains("other tables"));
}
