#include "domain/database/sqlite.hpp"
#include "domain/errors.hpp"
#include "domain/text/atomic_file.hpp"
#include "tests/domain/database/small_setup.hpp"
#include "tests/folder.hpp"

#include <catch2/catch.hpp>

using namespace rough;
namespace fs = std::filesystem;
using rough::testing::built;
using rough::testing::small_setup;
using tests::Folder;

namespace {

/// Reads everything from a database.
void use(const fs::path& file) {
    const GenomeStore store = GenomeStore::open(file);
    const StoredCurves curves = store.curves(true);
    for (const std::uint64_t index : curves.index) {
        store.genome(index);
        store.response(index);
    }
}

} // namespace

TEST_CASE("a database of another set-up is refused with the difference and stays unchanged") {
    const Folder folder;
    const fs::path file = folder / "genomes.db";
    GenomeStore::create(file, small_setup());
    const std::string before = read_whole(file);
    DatabaseSetup datum = small_setup(), strip = datum, seed = datum;
    datum.model.body.datum = 2;
    strip.model.body.kernel = Kernel::strip;
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
    Sqlite(folder / "other.db", Sqlite::Access::create).run("CREATE TABLE t(a)");
    refuses(folder / "other.db", "not a genome database");
    CHECK_THROWS_AS(GenomeStore::create(folder / "other.db", small_setup()), InputError);
    CHECK_THROWS_AS(GenomeStore::create(folder / "missing" / "a.db", small_setup()), InputError);
    for (const char* name : {":memory:", "file:x?mode=memory", ""}) // places in memory for SQLite
        CHECK_THROWS_WITH(GenomeStore::create(name, small_setup()),
                          Catch::Contains("is not the name of a file"));
    const fs::path empty = folder.write("empty.db", "");
    CHECK_FALSE(GenomeStore::begun(empty));
    CHECK_FALSE(GenomeStore::begun(folder / "none.db"));
    CHECK_NOTHROW(GenomeStore::create(empty, small_setup()));
    CHECK(GenomeStore::begun(empty));
}

TEST_CASE("a database with any alteration is refused") {
    const Folder folder;
    const fs::path good = folder / "good.db";
    built(good, {.genomes = 12, .batch = 4});
    CHECK_NOTHROW(use(good));
    for (const char* change :
         {"UPDATE genome SET numbers = substr(numbers, 1, 100) WHERE first = 4",
          "UPDATE pressure SET numbers = substr(numbers, 1, 15)",
          "UPDATE contact SET numbers = zeroblob(length(numbers)) WHERE first = 8",
          "UPDATE batch SET count = 3 WHERE first = 4", "UPDATE batch SET count = -4 WHERE first = 4",
          "UPDATE batch SET count = 4000000000", "UPDATE pressure SET first = 100 WHERE first = 4",
          "UPDATE setup SET value = '65' WHERE name = 'nodes'",
          "UPDATE setup SET value = '-1' WHERE name = 'steps'", "DELETE FROM pressure WHERE first = 8",
          "DELETE FROM setup WHERE name = 'checksum'", "CREATE VIEW v AS SELECT 1",
          "CREATE TRIGGER t AFTER INSERT ON batch BEGIN DELETE FROM genome; END",
          "PRAGMA user_version = 1"}) {
        INFO(change);
        const fs::path bad = folder / "bad.db";
        fs::copy_file(good, bad, fs::copy_options::overwrite_existing);
        Sqlite(bad, Sqlite::Access::existing).run(change);
        CHECK_THROWS_AS(use(bad), InputError);
    }
}

TEST_CASE("databases of different program versions are not merged") {
    const Folder folder;
    built(folder / "a.db", {.genomes = 4, .batch = 4});
    built(folder / "b.db", {.genomes = 4, .first = 4, .batch = 4});
    CHECK(merge({folder / "a.db", folder / "b.db"}, folder / "both.db") == 8);
    {
        Sqlite b(folder / "b.db", Sqlite::Access::existing);
        b.run("UPDATE setup SET value = '0.0.1' WHERE name = 'version'");
        std::string text; // the checksum is that of the lines (store.cpp)
        Statement rows(b, "SELECT name, value FROM setup WHERE name <> 'checksum' ORDER BY name");
        while (rows.step())
            text += std::string(rows.bytes(0)) + "=" + std::string(rows.bytes(1)) + "\n";
        b.run("UPDATE setup SET value = '" + std::to_string(checksum(text)) + "' WHERE name = 'checksum'");
    }
    CHECK_NOTHROW(use(folder / "b.db"));
    CHECK_THROWS_WITH(merge({folder / "a.db", folder / "b.db"}, folder / "c.db"),
                      Catch::Contains("b.db: made by version 0.0.1, but "));
    CHECK_FALSE(fs::exists(folder / "c.db"));
}

TEST_CASE("a view with a table's name is not run") {
    const Folder folder;
    const fs::path file = folder / "view.db";
    {
        Sqlite sqlite(file, Sqlite::Access::create);
        sqlite.run("PRAGMA application_id = " + std::to_string(0x52554741));
        sqlite.run("PRAGMA user_version = 2");
        sqlite.run(
            "CREATE VIEW batch AS WITH RECURSIVE n(first) AS (SELECT 1 UNION ALL SELECT first + 1 FROM n) "
            "SELECT first, 1 AS count FROM n"); // has no end
    }
    CHECK_THROWS_WITH(GenomeStore::open(file), Catch::Contains("other tables"));
}
