#include "domain/accuracy/respond.hpp"
#include "domain/database/build.hpp"
#include "domain/database/codec.hpp"
#include "domain/database/sqlite.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/waves.hpp"
#include "tests/domain/database/small_setup.hpp"
#include "tests/folder.hpp"

#include <catch2/catch.hpp>

using namespace rough;
namespace fs = std::filesystem;
using rough::testing::small_setup;
using tests::Folder;

namespace {

void check_same(const GenomeStore& one, const GenomeStore& other) {
    const StoredCurves a = one.curves(true), b = other.curves(true);
    CHECK(a.index == b.index);
    CHECK(a.pressure == b.pressure);
    CHECK(a.fraction == b.fraction);
}

} // namespace

TEST_CASE("a law's genome depends on its number alone, is valid and keeps to the law") {
    GenomeDistribution law;
    law.series = 2;
    law.ridges = 3;
    law.shortest = 0.05;
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
    law.gamma_from = 1;
    CHECK_THROWS_WITH(validate(law), Catch::Contains("gamma"));
}

TEST_CASE("genomes survive packing to the bit") {
    GenomeDistribution law;
    law.ridges = 2;
    std::vector<Genome> genomes;
    for (std::uint64_t i = 0; i < 7; ++i)
        genomes.push_back(drawn(law, i));
    const auto back = genomes_from(unpacked(packed(numbers(genomes))));
    REQUIRE(back.size() == 7);
    for (std::size_t i = 0; i < 7; ++i) {
        CHECK(genes(back[i]) == genes(genomes[i]));
        CHECK(back[i].series[0].chromosomes.back().n == genomes[i].series[0].chromosomes.back().n);
    }
    const Genome bare{1, {{1, 0.8, 1.5, 1, {{1, {}}, {2, {0.5}}}}}}; // a chromosome may have no ridge
    CHECK(shape_key(genomes_from(numbers({bare, genomes[0]}))[0]) == shape_key(bare));
    auto cut = numbers(genomes);
    cut.pop_back();
    CHECK_THROWS_AS(genomes_from(cut), InputError);
}

TEST_CASE("a set-up survives being written as text, for every kernel") {
    for (const Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip}) {
        DatabaseSetup setup = small_setup();
        setup.model.body.kernel = kernel;
        setup.model.body.datum = 1.0 / 3;
        setup.model.body.strip_width = 0.1;
        setup.law.seed = ~0ULL;
        CHECK(fields(setup_from(fields(setup), "text")) == fields(setup));
    }
}

TEST_CASE("a database holds the genomes of its law and their responses to the bit") {
    const Folder folder;
    const DatabaseSetup setup = small_setup();
    GenomeStore store = GenomeStore::create(folder / "genomes.db", setup);
    build(store, {.genomes = 30, .batch = 8});
    CHECK(store.stored() == 30);
    for (const std::uint64_t index : {0, 7, 8, 29}) {
        const Genome genome = drawn(setup.law, index);
        CHECK(genes(store.genome(index)) == genes(genome));
        const Response computed = respond(genome, setup.model), stored = store.response(index);
        CHECK(stored.range == computed.range);
        CHECK(stored.displacement == computed.displacement);
        CHECK(stored.pressure == computed.pressure);
        CHECK(stored.contact_fraction == computed.contact_fraction);
        CHECK(stored.tangent_stiffness == computed.tangent_stiffness);
    }
    CHECK_THROWS_WITH(store.genome(30), Catch::Contains("genome 30 is not stored"));
    // What is done is no builder's any more.
    CHECK(Sqlite(folder / "genomes.db", Sqlite::Access::existing).number("SELECT COUNT(*) FROM taken") == 0);
}

TEST_CASE("a build that was stopped goes on where it ended, in any pieces, to the same database") {
    const Folder folder;
    const DatabaseSetup setup = small_setup();
    GenomeStore whole = GenomeStore::create(folder / "whole.db", setup);
    build(whole, {.genomes = 50, .batch = 10});
    {
        GenomeStore pieces = GenomeStore::create(folder / "pieces.db", setup);
        build(pieces, {.genomes = 25, .batch = 10});
        int batches = 0;
        build(pieces, {.genomes = 50, .batch = 10, .go_on = [&](std::uint64_t) { return ++batches < 2; }});
        CHECK(pieces.stored() == 40);
        CHECK(pieces.take({0, 50}, 10)); // a builder that dies with its batch
    }
    GenomeStore pieces = GenomeStore::open(folder / "pieces.db");
    build(pieces, {.genomes = 50, .batch = 10});
    CHECK(pieces.stored() == 50);
    check_same(pieces, whole);
}

TEST_CASE("two builders of one file share the work and store each genome once") {
    const Folder folder;
    const DatabaseSetup setup = small_setup();
    GenomeStore one = GenomeStore::create(folder / "genomes.db", setup);
    GenomeStore two = GenomeStore::create(folder / "genomes.db", setup);
    const auto first = one.take({0, 40}, 10), second = two.take({0, 40}, 10);
    REQUIRE((first && second));
    CHECK(first->first == 0);
    CHECK(second->first == 10);
    std::uint64_t other = 0;
    build(one, {.genomes = 40, .batch = 10, .go_on = [&](std::uint64_t) {
                    if (other++ == 0)
                        build(two, {.genomes = 40, .batch = 10});
                    return true;
                }});
    CHECK(one.stored() == 40);
    CHECK(other <= 2); // the second did the rest, with what the takers above never delivered
    const auto index = two.curves().index;
    for (std::size_t i = 0; i < index.size(); ++i)
        CHECK(index[i] == i);
}

TEST_CASE("a builder is never given what it is at, and looks no further than the first gap that is free") {
    const Folder folder;
    GenomeStore store = GenomeStore::create(folder / "genomes.db", small_setup());
    const auto none = [](std::uint64_t) { return false; };
    const auto all = [](std::uint64_t) { return true; };
    CHECK(store.take({5, 20}, 10, all)->first == 5);
    CHECK(store.take({5, 20}, 10, all)->first == 10);
    CHECK(store.take({5, 20}, 10, all)->count == 5); // 20 to 24
    CHECK_FALSE(store.take({5, 20}, 10, all));
    CHECK(store.take({5, 20}, 10, none)->first == 20); // somebody else's, from the end
    build(store, {.genomes = 20, .first = 5, .batch = 10});
    CHECK(store.stored() == 20);
    CHECK(store.batches().front().first == 5);
    CHECK(store.gaps({0, 30}).size() == 2);
    CHECK(store.gaps({7, 11}).empty());
    build(store, {.genomes = 30, .batch = 10});
    CHECK(store.stored() == 30);
    CHECK(store.gaps({0, 30}).empty());
}

TEST_CASE("responses that come in any order, from elsewhere, make the same database") {
    const Folder folder;
    const DatabaseSetup setup = small_setup();
    GenomeStore whole = GenomeStore::create(folder / "whole.db", setup);
    build(whole, {.genomes = 45, .batch = 10});
    GenomeStore other = GenomeStore::create(folder / "other.db", setup);
    const auto backwards = [&](const DatabaseSetup& of, const Orders& orders) {
        CHECK(orders.count == 45);
        std::vector<std::uint64_t> all;
        while (const auto next = orders.next())
            all.push_back(*next);
        CHECK_FALSE(orders.next());
        for (auto i = all.rbegin(); i != all.rend(); ++i)
            orders.take(*i, response_for(of, *i));
    };
    build(other, {.genomes = 45, .batch = 10, .computing = backwards});
    CHECK(other.stored() == 45);
    check_same(other, whole);
}

TEST_CASE(
    "databases of one law are merged, each genome once, and others are refused with the difference named") {
    const Folder folder;
    const DatabaseSetup setup = small_setup();
    GenomeStore whole = GenomeStore::create(folder / "whole.db", setup);
    build(whole, {.genomes = 60, .batch = 10});
    {
        GenomeStore a = GenomeStore::create(folder / "a.db", setup);
        build(a, {.genomes = 25, .batch = 7});
        GenomeStore b = GenomeStore::create(folder / "b.db", setup);
        build(b, {.genomes = 40, .first = 20, .batch = 9}); // 20 to 24 are in both
    }
    CHECK(merge({folder / "b.db", folder / "a.db"}, folder / "c.db") == 60);
    const GenomeStore merged = GenomeStore::open(folder / "c.db");
    check_same(merged, whole);
    CHECK(merged.response(24).tangent_stiffness == whole.response(24).tangent_stiffness);
    CHECK(shape_key(merged.genome(59)) == shape_key(whole.genome(59)));

    DatabaseSetup other = setup;
    other.law.seed = 2;
    {
        GenomeStore d = GenomeStore::create(folder / "d.db", other);
        build(d, {.genomes = 5});
    }
    CHECK_THROWS_WITH(merge({folder / "a.db", folder / "d.db"}, folder / "e.db"),
                      Catch::Contains("d.db: its seed is 2, not 1"));
    CHECK_THROWS_WITH(merge({folder / "a.db", folder / "none.db"}, folder / "e.db"),
                      Catch::Contains("none.db"));
    CHECK_FALSE(fs::exists(folder / "e.db"));
    const auto names = folder.names();
    CHECK(std::none_of(names.begin(), names.end(),
                       [](const std::string& name) { return name.find("tmp") != std::string::npos; }));
}

TEST_CASE("a genome that is not its law's is not merged") {
    const Folder folder;
    const DatabaseSetup setup = small_setup();
    {
        GenomeStore a = GenomeStore::create(folder / "a.db", setup);
        build(a, {.genomes = 5});
        GenomeStore forged = GenomeStore::create(folder / "forged.db", setup);
        forged.add({5, 1}, {drawn(setup.law, 6)}, {response_for(setup, 6)});
    }
    CHECK_THROWS_WITH(merge({folder / "a.db", folder / "forged.db"}, folder / "c.db"),
                      Catch::Contains("forged.db: genome 5 is not its law's"));
    CHECK_FALSE(fs::exists(folder / "c.db"));
}

TEST_CASE("a checksum changes with any byte, with the length and with its seed") {
    const std::string bytes = "height and slope";
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        std::string other = bytes;
        other[i] = static_cast<char>(other[i] ^ 1);
        CHECK(checksum(other) != checksum(bytes));
    }
    CHECK(checksum(bytes + std::string(1, '\0')) != checksum(bytes));
    CHECK(checksum(bytes, 1) != checksum(bytes));
}
