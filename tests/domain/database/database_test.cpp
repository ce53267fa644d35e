#include "domain/database/build.hpp"
#include "domain/database/codec.hpp"
#include "domain/database/merge.hpp"
#include "domain/database/screen.hpp"
#include "domain/database/sqlite.hpp"
#include "domain/database/starts.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/waves.hpp"
#include "domain/response/curve.hpp"
#include "domain/target/similarity.hpp"
#include "domain/text/atomic_file.hpp"
#include "tests/folder.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>

using namespace rough;
namespace fs = std::filesystem;
using tests::Folder;

namespace {

DatabaseSetup small_setup() {
    DatabaseSetup setup;
    setup.model.grid.nodes = 64;
    setup.model.loading.steps = 8;
    setup.law.series = 2;
    setup.law.shortest = 0.1;
    return setup;
}

/// Five points of the curve that a response gives at an amplitude, up to a part of its reach.
Target goal_of(const Response& response, double factor, double reach,
               Quantity quantity = Quantity::stiffness) {
    const Curve curve = curve_of(quantity, scaled(response, factor));
    Target target;
    target.quantity = quantity;
    target.name = "a stored genome";
    target.x = Eigen::VectorXd::LinSpaced(5, 0.2, 1) * (reach * curve.to);
    target.y = target.x.unaryExpr([&](double x) { return curve.at(x); });
    return target;
}

} // namespace

TEST_CASE("a law's genome depends on its number alone, is valid and keeps to the law") {
    GenomeLaw law;
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
    GenomeLaw law;
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
    CHECK(pieces.curves().pressure == whole.curves().pressure);
    CHECK(pieces.curves().index == whole.curves().index);
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
    CHECK(other.curves(true).index == whole.curves(true).index);
    CHECK(other.curves(true).pressure == whole.curves(true).pressure);
    CHECK(other.curves(true).fraction == whole.curves(true).fraction);
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
    CHECK(merged.curves(true).index == whole.curves(true).index);
    CHECK(merged.curves(true).pressure == whole.curves(true).pressure);
    CHECK(merged.curves(true).fraction == whole.curves(true).fraction);
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

TEST_CASE("a database of another set-up is refused with the difference named, and stays as it was") {
    const Folder folder;
    const fs::path file = folder / "genomes.db";
    GenomeStore::create(file, small_setup());
    const std::string before = read_whole(file);
    DatabaseSetup other = small_setup();
    other.model.body.datum = 2;
    CHECK_THROWS_WITH(GenomeStore::create(file, other),
                      Catch::Contains("datum_mm is 0.8494") && Catch::Contains("not 2"));
    other = small_setup();
    other.model.body.kernel = Kernel::strip;
    CHECK_THROWS_WITH(GenomeStore::create(file, other), Catch::Contains("kernel is free, not strip"));
    other = small_setup();
    other.law.seed = 2;
    CHECK_THROWS_WITH(GenomeStore::create(file, other), Catch::Contains("seed is 1, not 2"));
    CHECK(read_whole(file) == before);
    CHECK_NOTHROW(GenomeStore::create(file, small_setup()));
}

TEST_CASE("what is no genome database is refused") {
    const Folder folder;
    CHECK_THROWS_WITH(GenomeStore::open(folder / "none.db"), Catch::Contains("none.db"));
    write_atomically(folder / "text.db", std::string(5000, 'x'));
    CHECK_THROWS_WITH(GenomeStore::open(folder / "text.db"), Catch::Contains("no genome database"));
    Sqlite(folder / "other.db", Sqlite::Access::create).run("CREATE TABLE t(a)");
    CHECK_THROWS_WITH(GenomeStore::open(folder / "other.db"), Catch::Contains("no genome database"));
    CHECK_THROWS_WITH(GenomeStore::create(folder / "other.db", small_setup()),
                      Catch::Contains("no genome database"));
    write_atomically(folder / "empty.db", "");
    CHECK_FALSE(GenomeStore::begun(folder / "empty.db"));
    CHECK_FALSE(GenomeStore::begun(folder / "none.db"));
    CHECK_NOTHROW(GenomeStore::create(folder / "empty.db", small_setup()));
    CHECK(GenomeStore::begun(folder / "empty.db"));
    CHECK_THROWS_AS(GenomeStore::create(folder / "missing" / "a.db", small_setup()), InputError);
}

TEST_CASE("screening by Eq. 11 finds the genomes that similarity ranks first, on any number of threads") {
    const Folder folder;
    const DatabaseSetup setup = small_setup();
    GenomeStore store = GenomeStore::create(folder / "genomes.db", setup);
    build(store, {.genomes = 200});
    const double max_pressure = 1.6e-4;
    const auto factor = [&](std::uint64_t g) { return max_pressure / store.response(g).pressure[7]; };
    std::vector<Target> targets{goal_of(store.response(123), factor(123), 0.9),
                                goal_of(store.response(123), factor(123), 0.9, Quantity::area_at_pressure)};
    targets[1].weight = 0.5;
    targets[0].lower = 0.98 * targets[0].y, targets[0].upper = 1.01 * targets[0].y;
    std::vector<std::pair<double, std::uint64_t>> expected;
    for (std::uint64_t g = 0; g < 200; ++g) {
        const Response response = scaled(store.response(g), factor(g));
        double worst = 1;
        for (const Target& target : targets)
            worst = std::min(worst, similarity(target, curve_of(target.quantity, response)));
        expected.emplace_back(-worst, g);
    }
    std::sort(expected.begin(), expected.end());
    for (const int threads : {1, 2, 5}) {
        const auto matches = screen(store.curves(true), setup.model, targets,
                                    {.max_pressure = max_pressure, .best = 20, .threads = threads});
        REQUIRE(matches.size() == 20);
        CHECK(matches[0].index == 123);
        CHECK(matches[0].similarity == Approx(1).epsilon(1e-12));
        for (std::size_t i = 0; i < 20; ++i) {
            CHECK(matches[i].index == expected[i].second);
            CHECK(matches[i].similarity == Approx(-expected[i].first).epsilon(1e-12));
            CHECK(matches[i].scale == Approx(factor(matches[i].index)));
        }
    }
    CHECK_THROWS_WITH(screen(store.curves(true), setup.model, targets, {.max_pressure = 1e-5}),
                      Catch::Contains("reaches"));
    CHECK_THROWS_WITH(screen(store.curves(), setup.model, targets, {}), Catch::Contains("fractions"));
    CHECK_THROWS_AS(screen({}, setup.model, targets, {}), InputError);
    CHECK_THROWS_AS(screen(store.curves(), setup.model, {}, {}), InputError);
}

TEST_CASE("screening with free amplitude finds a stored genome at the amplitude that its curve was given") {
    const Folder folder;
    const DatabaseSetup setup = small_setup();
    GenomeStore store = GenomeStore::create(folder / "genomes.db", setup);
    build(store, {.genomes = 200});
    const StoredCurves curves = store.curves(true);
    for (const auto quantity : {Quantity::stiffness, Quantity::area_at_displacement,
                                Quantity::load_at_displacement, Quantity::interface_stiffness})
        for (const double reach : {0.95, 0.4, 0.3}) {
            if (quantity == Quantity::area_at_displacement && reach < 0.9)
                continue; // a handful of touching nodes is many genomes' answer
            const Target target = goal_of(store.response(77), 0.037, reach, quantity);
            const auto matches = screen(curves, setup.model, {target}, {.best = 3});
            INFO(int(quantity) << " " << reach);
            CHECK(matches[0].index == 77);
            CHECK(matches[0].scale == Approx(0.037).epsilon(1e-3));
            CHECK(matches[0].similarity > 0.999);
            for (const Match& match : matches) {
                const Response response = scaled(store.response(match.index), match.scale);
                CHECK(match.similarity ==
                      Approx(similarity(target, curve_of(quantity, response))).epsilon(1e-9));
            }
        }
}

TEST_CASE("a genome without a response, or one whose curve ends before the target, matches nothing") {
    const Folder folder;
    const DatabaseSetup setup = small_setup();
    GenomeStore store = GenomeStore::create(folder / "genomes.db", setup);
    build(store, {.genomes = 20});
    const double max_pressure = store.response(7).pressure[7];
    for (const Quantity quantity :
         {Quantity::stiffness, Quantity::area_at_pressure, Quantity::area_at_displacement}) {
        const Target target = goal_of(store.response(7), 1, 0.9, quantity);
        for (const ScreenOptions& options : {ScreenOptions{}, ScreenOptions{.max_pressure = max_pressure}}) {
            StoredCurves curves = store.curves(true);
            CHECK(screen(curves, setup.model, {target}, options)[0].index == 7);
            ScreenOptions two = options;
            two.best = 2;
            CHECK(screen(curves, setup.model, {target}, two).size() == 2);
            for (const std::size_t lost : {7u, 12u}) {
                curves.range[lost] = std::nan("");
                for (std::size_t j = 8 * lost; j < 8 * lost + 8; ++j)
                    curves.pressure[j] = curves.fraction[j] = std::nan("");
            }
            ScreenOptions every = options;
            every.best = 20;
            const auto matches = screen(curves, setup.model, {target}, every);
            CHECK(!matches.empty());
            CHECK(matches.size() <= 18);
            for (const Match& match : matches) {
                CHECK(match.index != 7);
                CHECK(match.index != 12);
                CHECK(match.similarity < 1);
            }
        }
    }
    Target none = goal_of(store.response(7), 1, 0.9);
    none.y[2] = 0;
    CHECK_THROWS_AS(screen(store.curves(), setup.model, {none}, {}), InputError);
    // Eq. 11 fixes the amplitude: a displacement that no genome reaches then leaves none.
    Target far = goal_of(store.response(7), 1, 0.9, Quantity::load_at_displacement);
    far.x *= 1e6;
    CHECK(screen(store.curves(), setup.model, {far}, {.max_pressure = max_pressure}).empty());
}

TEST_CASE("stored starts meet a design's targets at their amplitude, and another model's are refused") {
    const Folder folder;
    const DatabaseSetup setup = small_setup();
    GenomeStore store = GenomeStore::create(folder / "genomes.db", setup);
    build(store, {.genomes = 100});
    DesignSetup design;
    design.model = setup.model;
    design.targets = {goal_of(store.response(5), 0.02, 0.9)};
    const auto starts = stored_starts(store, design, 4);
    REQUIRE(starts.size() == 4);
    const Response response = respond(starts[0], setup.model);
    CHECK(similarity(design.targets[0], curve_of(Quantity::stiffness, response)) > 0.999);
    design.max_pressure = store.response(5).pressure[7] * 0.02;
    CHECK(respond(stored_starts(store, design, 1)[0], setup.model).pressure[7] ==
          Approx(*design.max_pressure));
    design.model.loading.steps = 9;
    CHECK_THROWS_WITH(stored_starts(store, design, 4), Catch::Contains("steps is 8, not 9"));
}

TEST_CASE("a database answers for every length and modulus, exactly as the drawn-out genomes do") {
    const Folder folder;
    for (const Kernel kernel : {Kernel::free, Kernel::strip, Kernel::periodic}) {
        DatabaseSetup setup = small_setup();
        setup.model.body.kernel = kernel;
        setup.model = completed(setup.model);
        GenomeStore store =
            GenomeStore::create(folder / (std::to_string(static_cast<int>(kernel)) + ".db"), setup);
        build(store, {.genomes = 40});
        DesignSetup design;
        design.model.body.kernel = kernel;
        design.model.body.effective_modulus = 210;
        design.model.grid = {64, 2.5, kernel == Kernel::periodic};
        if (kernel == Kernel::strip)
            design.model.body.strip_width = setup.model.body.strip_width * 2.5 / setup.model.grid.length;
        design.model.loading.steps = 8;
        design.model = completed(design.model);
        const Response own = respond(drawn_out(store.genome(7), 2.5 / setup.model.grid.length), design.model);
        const double scale = scale_to(store, design.model).pressure;
        CHECK(scale == Approx(210 * setup.model.grid.length / 2.5));
        for (Index j = 0; j < 8; ++j) {
            CHECK(own.pressure[j] == Approx(scale * store.response(7).pressure[j]).epsilon(1e-9));
            CHECK(own.contact_fraction[j] == store.response(7).contact_fraction[j]);
        }
        design.targets = {goal_of(own, 0.02, 0.9), goal_of(own, 0.02, 0.9, Quantity::area_at_pressure)};
        const auto starts = stored_starts(store, design, 1);
        REQUIRE(starts.size() == 1);
        for (const Target& target : design.targets)
            CHECK(similarity(target, curve_of(target.quantity, respond(starts[0], design.model))) > 0.999);
        design.max_pressure = 0.02 * own.pressure[7];
        CHECK(respond(stored_starts(store, design, 1)[0], design.model).pressure[7] ==
              Approx(*design.max_pressure));
        if (kernel == Kernel::free) {
            design.model.body.datum *= 2;
            CHECK_THROWS_WITH(stored_starts(store, design, 1), Catch::Contains("datum_mm"));
        }
    }
}

namespace {

/// Everything that a database is asked for.
void use(const fs::path& file) {
    const GenomeStore store = GenomeStore::open(file);
    const StoredCurves curves = store.curves(true);
    for (const std::uint64_t index : curves.index) {
        store.genome(index);
        store.response(index);
    }
}

} // namespace

TEST_CASE("a database in which anything was altered is refused, never read as something else") {
    const Folder folder;
    const fs::path good = folder / "good.db";
    {
        GenomeStore store = GenomeStore::create(good, small_setup());
        build(store, {.genomes = 12, .batch = 4});
    }
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

TEST_CASE("a view that bears a table's name is not run") {
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

TEST_CASE("names that SQLite takes for a place in memory are no database files") {
    for (const char* name : {":memory:", "file:x?mode=memory", ""})
        CHECK_THROWS_WITH(GenomeStore::create(name, small_setup()), Catch::Contains("names no file"));
}

TEST_CASE("a law of genomes that no memory holds is refused") {
    GenomeLaw law;
    law.series = 16, law.ridges = 1000, law.shortest = 1e-300;
    CHECK_THROWS_WITH(validate(law), Catch::Contains("phases a genome"));
}

TEST_CASE("genomes from a database are checked part by part") {
    CHECK(genomes_from(numbers({Genome{}})).size() == 1);
    for (const double parts : {1e300, -1., 0.5, std::nan(""), 2.})
        CHECK_THROWS_AS(genomes_from({1, 1, 0.8, 1.5, 1, parts}), InputError);
    CHECK_THROWS_AS(unpacked("1234567"), InputError);
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
