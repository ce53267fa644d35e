#include "domain/database/screen.hpp"
#include "domain/errors.hpp"
#include "tests/catch.hpp"
#include "tests/domain/database/small_setup.hpp"
#include "tests/folder.hpp"

using namespace rough;
using rough::testing::built;
using rough::testing::small_map_setup;
using rough::testing::small_setup;
using tests::Folder;

namespace {

/// Five points of the curve of a response times `factor`, up to the share `reach` of its end.
Target goal_of(const Response& response, double factor, double reach, Quantity quantity = Quantity::stiffness) {
    const Curve curve = curve_of(quantity, scaled(response, factor));
    return target_at(quantity, "a stored genome", PointPlacement{5}.up_to(reach * curve.to),
                     [&](double x) { return curve.at(x); });
}

} // namespace

TEST_CASE("screening by Eq. 11 ranks genomes by similarity, on any number of threads") {
    const Folder folder;
    const DatabaseSetup setup = small_setup();
    const GenomeStore store = built(folder / "genomes.db", {.genomes = 200});
    const double max_pressure = 1.6e-4;
    const auto factor = [&](std::uint64_t g) { return max_pressure / response_for(setup, g).pressure[7]; };
    std::vector<Target> targets{goal_of(response_for(setup, 123), factor(123), 0.9),
                                goal_of(response_for(setup, 123), factor(123), 0.9, Quantity::area_at_pressure)};
    targets[1].weight = 0.5;
    targets[0].lower = 0.98 * targets[0].y, targets[0].upper = 1.01 * targets[0].y;
    std::vector<std::pair<double, std::uint64_t>> expected;
    for (std::uint64_t g = 0; g < 200; ++g) {
        const Response response = scaled(response_for(setup, g), factor(g));
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

TEST_CASE("screening with free amplitude finds a stored genome and its amplitude") {
    const Folder folder;
    const DatabaseSetup setup = small_setup();
    const GenomeStore store = built(folder / "genomes.db", {.genomes = 200});
    const StoredCurves curves = store.curves(true);
    for (const auto quantity : {Quantity::stiffness, Quantity::area_at_displacement, Quantity::load_at_displacement,
                                Quantity::interface_stiffness})
        for (const double reach : {0.95, 0.4, 0.2}) {
            if (quantity == Quantity::area_at_displacement && reach < 0.9)
                continue; // many genomes have the same few touching nodes
            const Target target = goal_of(response_for(setup, 77), 0.037, reach, quantity);
            const auto matches = screen(curves, setup.model, {target}, {.best = 3});
            INFO(int(quantity) << " " << reach);
            CHECK(matches[0].index == 77);
            CHECK(matches[0].scale == Approx(0.037).epsilon(1e-3));
            CHECK(matches[0].similarity > 0.999);
            for (const Match& match : matches) {
                const Response response = scaled(response_for(setup, match.index), match.scale);
                CHECK(match.similarity == Approx(similarity(target, curve_of(quantity, response))).epsilon(1e-9));
            }
        }
}

TEST_CASE("a genome without a response, or whose curve ends too early, is not matched") {
    const Folder folder;
    const DatabaseSetup setup = small_setup();
    const GenomeStore store = built(folder / "genomes.db", {.genomes = 20});
    const double max_pressure = response_for(setup, 7).pressure[7];
    for (const Quantity quantity : {Quantity::stiffness, Quantity::area_at_pressure, Quantity::area_at_displacement}) {
        const Target target = goal_of(response_for(setup, 7), 1, 0.9, quantity);
        for (const ScreenOptions& options : {ScreenOptions{}, ScreenOptions{.max_pressure = max_pressure}}) {
            StoredCurves curves = store.curves(true);
            CHECK(screen(curves, setup.model, {target}, options)[0].index == 7);
            for (const std::size_t lost : {7u, 12u}) {
                curves.range[lost] = std::nan("");
                for (std::size_t j = 8 * lost; j < 8 * lost + 8; ++j)
                    curves.pressure[j] = curves.fraction[j] = std::nan("");
            }
            const auto matches = screen(curves, setup.model, {target}, {options.max_pressure, 20});
            CHECK((!matches.empty() && matches.size() <= 18));
            for (const Match& match : matches) CHECK((match.index != 7 && match.index != 12 && match.similarity < 1));
        }
    }
    Target none = goal_of(response_for(setup, 7), 1, 0.9);
    none.y[2] = 0;
    CHECK_THROWS_AS(screen(store.curves(), setup.model, {none}, {}), InputError);
    // Eq. 11 fixes the amplitude, so no genome reaches this displacement.
    Target far = goal_of(response_for(setup, 7), 1, 0.9, Quantity::load_at_displacement);
    far.x *= 1e6;
    CHECK(screen(store.curves(), setup.model, {far}, {.max_pressure = max_pressure}).empty());
}

TEST_CASE("stored starts of lines and maps meet targets at every length and modulus, and another model is refused") {
    const Folder folder;
    for (const auto& [kernel, is_map] : {std::pair(Kernel::free, false),
                                         {Kernel::strip, false},
                                         {Kernel::periodic, false},
                                         {Kernel::free, true},
                                         {Kernel::periodic, true}}) {
        DatabaseSetup setup = is_map ? small_map_setup() : small_setup();
        setup.model.body.kernel = kernel;
        setup.model.loading.reach.reset();
        setup.model = completed(setup.model);
        const GenomeStore store =
            built(folder / (name_of(kernel) + std::string(is_map ? "-map.db" : ".db")), {.genomes = 40}, setup);
        Model model{{64, 2.5}, {kernel, 210}, {8}};
        if (is_map) model.grid.nodes = 16, model.grid.rows = 12, model.grid.width = 0.75 * 2.5;
        if (kernel == Kernel::strip)
            model.body.strip_width = *setup.model.body.strip_width * 2.5 / setup.model.grid.length;
        DesignSetup design{.model = completed(model)};
        const double times = 2.5 / setup.model.grid.length, scale = 210 / times;
        Genome genome = store.genome(7);
        for (Series& series : genome.series) {
            series.lambda *= times;
            series.A *= std::pow(times, -series.H); // keeps the heights, by Eq. 2
        }
        const Response stretched = respond(genome, design.model);
        for (Index j = 0; j < 8; ++j) {
            CHECK(stretched.pressure[j] == Approx(scale * response_for(setup, 7).pressure[j]).epsilon(1e-9));
            CHECK(stretched.contact_fraction[j] == response_for(setup, 7).contact_fraction[j]);
        }
        design.targets = {goal_of(stretched, 0.02, 0.9), goal_of(stretched, 0.02, 0.9, Quantity::area_at_pressure)};
        const auto starts = stored_starts(store, design, 4);
        REQUIRE(starts.size() == 4);
        for (const Target& target : design.targets)
            CHECK(similarity(target, curve_of(target.quantity, respond(starts[0], design.model))) > 0.999);
        design.max_pressure = 0.02 * stretched.pressure[7];
        CHECK(respond(stored_starts(store, design, 1)[0], design.model).pressure[7] == Approx(*design.max_pressure));
        if (is_map) {
            design.model.grid.width *= 1.1;
            CHECK_THROWS_WITH(stored_starts(store, design, 1), Catch::Contains("width_mm"));
        } else if (kernel == Kernel::free) {
            design.targets[0].weight = 2;
            CHECK_THROWS_WITH(stored_answers(store, design, 1), Catch::Contains("weight 2 is out of range"));
            *design.model.body.datum *= 2;
            CHECK_THROWS_WITH(stored_starts(store, design, 1), Catch::Contains("datum_mm"));
            design.model.loading.steps = 9;
            CHECK_THROWS_WITH(stored_starts(store, design, 1), Catch::Contains("steps is 8, not 9"));
        }
    }
}
