#include "domain/design/search.hpp"
#include "domain/design/starts.hpp"
#include "domain/errors.hpp"
#include "tests/catch.hpp"
#include "tests/domain/random_genome.hpp"

using namespace rough;
using rough::testing::uniform;

namespace {

/// A random surface, a line on each kernel or a map, with its response as target.
struct OwnResponse {
    DesignSetup setup;
    Genome genome;
    std::string words;
};

OwnResponse own_response(unsigned seed) {
    std::mt19937_64 random(seed);
    const bool is_map = seed % 4 == 3;
    Model model;
    model.body.kernel = is_map ? (seed % 8 == 3 ? Kernel::free : Kernel::periodic) : Kernel(seed % 4);
    const bool periodic = model.body.kernel == Kernel::periodic;
    const double length = std::pow(10., uniform(random, -1, 1));
    model.grid = {is_map ? 16 : periodic ? 64 : 65, length};
    if (is_map) model.grid.rows = 16, model.grid.width = length;
    model.body.effective_modulus = std::pow(10., uniform(random, 0, 5));
    model.loading.steps = 5 + static_cast<int>(random() % 16);
    OwnResponse own{{.model = completed(model), .limits = {.shortest_wave = length / 8}}, {}, ""};
    own.genome = rough::testing::random_genome(random, 1 + int(random() % 2), is_map ? 4 : 1, length, length / 8);
    if (periodic && !is_map) own.genome = fitting_grid(own.setup, own.genome);
    const Profile surface = sample(own.genome, own.setup.model.grid);

    const Quantity quantity = std::array{Quantity::stiffness, Quantity::interface_stiffness, Quantity::area_at_pressure,
                                         Quantity::area_at_displacement, Quantity::load_at_displacement}[random() % 5];
    model = own.setup.model;
    auto& last = against_pressure(quantity) ? model.loading.to_pressure : model.loading.to_displacement;
    last = uniform(random, 0.2, 0.8) * curve_of(quantity, respond(surface, model)).to;
    own.setup.targets = {target_like(surface, model, "its own", quantity, {10, last})};
    own.words = line_of("surface ", seed, ", kernel ", int(model.body.kernel), ", quantity ", int(quantity), ", ",
                        model.loading.steps, " load steps");
    return own;
}

/// Checks that no such target is refused or called out of reach. A search that begins with the surface
/// reaches it, and any other search ends with an answer.
void check_own_responses(unsigned first, unsigned count) {
    for (unsigned seed = first; seed < first + count; ++seed) {
        const OwnResponse own = own_response(seed);
        INFO(own.words);
        CHECK(unreachable(own.setup, exact_enough).reasons.empty());
        SearchOptions options{
            .pipeline = "score | refine lm 2 | best 1", .starts = {own.genome}, .threads = 1, .alternatives = 1};
        CHECK(search(own.setup, options).best.similarity >= own.setup.required_similarity);
        options = {.pipeline = "shape 3 | score | refine lm 2 | best 1", .threads = 1, .alternatives = 1};
        CHECK_NOTHROW(search(own.setup, options));
    }
}

} // namespace

TEST_CASE("designs accept and reach the response of a random surface") { check_own_responses(1, 24); }

TEST_CASE("designs accept and reach 1,000 responses of random lines and maps", "[long]") {
    check_own_responses(1000, 1000);
}
