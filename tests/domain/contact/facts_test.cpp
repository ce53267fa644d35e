#include "domain/contact/kernel.hpp"
#include "domain/errors.hpp"
#include "domain/response/response.hpp"
#include "tests/domain/contact/scenes.hpp"

using namespace rough;

namespace {

using scenes::Scene;

/// Random scenes of 20 to 200 nodes on every kernel, pressed in 12 steps.
std::vector<Scene> random_scenes(int count) {
    std::mt19937 random(20);
    std::vector<Scene> scenes;
    for (int k = 0; k < count; ++k) scenes.push_back(scenes::random_scene(random, k, 20, 180, 12));
    return scenes;
}

ContactCurve solved(const Scene& scene) {
    return solve_contact(scene.profile, scene.body, scene.displacements, {.states = true});
}

/// Two waves on 2 mm.
Profile two_mm() {
    return sampled({201, 2}, [](double x) { return std::cos(5 * x) + 0.3 * std::sin(21 * x); });
}

} // namespace

TEST_CASE("no node leaves contact as the approach grows", "[contact]") {
    for (const Scene& scene : random_scenes(150)) {
        const ContactCurve curve = solved(scene);
        std::vector<int> before;
        for (const ContactState& state : curve.states) {
            std::vector<int> nodes = state.nodes;
            std::sort(nodes.begin(), nodes.end());
            CHECK(std::includes(nodes.begin(), nodes.end(), before.begin(), before.end()));
            CHECK(state.tangent.minCoeff() > 0);
            CHECK(state.pressure.minCoeff() > 0);
            before = nodes;
        }
    }
}

TEST_CASE("only overlapping nodes touch a strip or a half-plane with datum from L on", "[contact]") {
    int touched_apart = 0;
    for (const Scene& scene : random_scenes(150)) {
        const double highest = scene.profile.heights.maxCoeff();
        const bool theorem =
            scene.body.kernel == Kernel::strip ||
            (scene.body.kernel == Kernel::free && scene.body.datum >= profile_length(scene.profile, Kernel::free));
        const ContactCurve curve = solved(scene);
        for (std::size_t j = 0; j < curve.steps.size(); ++j)
            for (const int node : curve.states[j].nodes) {
                const bool apart = highest - scene.profile.heights[node] >= scene.displacements[j];
                if (theorem) CHECK_FALSE(apart);
                touched_apart += apart;
            }
    }
    CHECK(touched_apart > 0); // on the other bodies it does happen
}

TEST_CASE("pressure scales with heights and displacements, and stiffness and contact stay", "[contact]") {
    for (Scene scene : random_scenes(60)) {
        ContactCurve expected = solved(scene);
        const double scale = 1e-3;
        for (LoadStep& step : expected.steps) step.pressure *= scale;
        scene.profile.heights *= scale;
        for (double& displacement : scene.displacements) displacement *= scale;
        scenes::check_same(solved(scene), expected, 1e-10);
    }
}

TEST_CASE("pressure is convex, and stiffness never falls or exceeds that of full contact", "[contact]") {
    for (Scene scene : random_scenes(150)) {
        scene.displacements.insert(scene.displacements.begin(), 0); // first touch
        const ContactCurve curve = solved(scene);
        double full = std::numeric_limits<double>::infinity();
        if (scene.body.kernel != Kernel::periodic) {
            Profile flat = scene.profile;
            flat.heights.setZero();
            full = solve_contact(flat, scene.body, {1}).steps[0].tangent_stiffness;
        }
        LoadStep before = curve.steps.front();
        CHECK(before.pressure == 0);
        double secant_before = 0;
        for (const LoadStep& step : std::span(curve.steps).subspan(1)) {
            const double secant = (step.pressure - before.pressure) / (step.displacement - before.displacement);
            CHECK(secant >= secant_before * (1 - 1e-10));
            CHECK(secant <= step.tangent_stiffness * (1 + 1e-10));
            CHECK(secant >= before.tangent_stiffness * (1 - 1e-10));
            CHECK(step.tangent_stiffness >= before.tangent_stiffness * (1 - 1e-10));
            CHECK(step.tangent_stiffness <= full * (1 + 1e-10));
            before = step;
            secant_before = secant;
        }
    }
}

TEST_CASE("a wave of amplitude e shifts the curve by at most 2 e in displacement", "[contact]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (const Scene& scene : random_scenes(90)) {
        if (scene.body.kernel == Kernel::periodic) continue;
        const ContactCurve whole = solved(scene);
        const double e = 0.03 * scene.displacements.back() * uniform(random), wave = 3 + 20 * uniform(random);
        Scene without = scene;
        for (Index i = 0; i < scene.profile.nodes(); ++i)
            without.profile.heights[i] -= e * std::cos(wave * static_cast<double>(i));
        for (std::size_t j = 0; j < whole.steps.size(); ++j) {
            const double displacement = scene.displacements[j];
            auto pressure = [&](double at) {
                return at <= 0 ? 0.0 : solve_contact(without.profile, without.body, {at}).steps[0].pressure;
            };
            CHECK(pressure(displacement - 2 * e) <= whole.steps[j].pressure * (1 + 1e-10));
            CHECK(pressure(displacement + 2 * e) >= whole.steps[j].pressure * (1 - 1e-10));
        }
    }
}

TEST_CASE("another datum d2 adds (2 P L/(pi E*)) ln(d2/d) to the displacement of every load step", "[contact]") {
    for (Scene scene : random_scenes(60)) {
        if (scene.body.kernel != Kernel::free) continue;
        const double length = profile_length(scene.profile, Kernel::free), d2 = 7 * length;
        const double compliance = 2 * length / (std::numbers::pi * scene.body.effective_modulus) *
                                  std::log(d2 / *completed(scene.body, length).datum);
        ContactCurve expected = solved(scene);
        scene.body.datum = d2;
        for (std::size_t j = 0; j < expected.steps.size(); ++j) {
            LoadStep& step = expected.steps[j];
            scene.displacements[j] += step.pressure * compliance;
            step.tangent_stiffness = 1 / (1 / step.tangent_stiffness + compliance);
        }
        scenes::check_same(solved(scene), expected, 1e-9);
    }
}

TEST_CASE("datum and strip width default to those of the profile's length, to the bit", "[contact]") {
    const Profile profile = two_mm();
    for (const Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip}) {
        const bool periodic = kernel == Kernel::periodic;
        const Body stated{.kernel = kernel, .datum = 0.01 * 200, .strip_width = 0.01 * 200 / 511};
        const Response left = respond(profile, {.kernel = kernel});
        const Response right = respond(profile, stated, {20, periodic ? 0.95 : 1});
        CHECK(left.pressure == right.pressure);
        CHECK(left.tangent_stiffness == right.tangent_stiffness);
        const Model model{.grid = {201, periodic ? 0.01 * 201 : 0.01 * 200}, .body = {.kernel = kernel}};
        CHECK(respond(profile, model).pressure == left.pressure);
        CHECK(completed(model).grid.periodic == periodic);
    }
}

TEST_CASE("a datum is refused up to (L + spacing)/4, and a modulus that is not positive", "[contact]") {
    const Profile profile = two_mm();
    const double limit = datum_limit(profile);
    CHECK(limit == Approx(2.01 / 4));
    CHECK_THROWS_AS(solve_contact(profile, {Kernel::free, 1, limit * (1 - 1e-12), 0}, {0.01}), InputError);
    CHECK(solve_contact(profile, {Kernel::free, 1, limit * (1 + 1e-6), 0}, {0.01}).steps[0].pressure > 0);
    for (const double modulus : {0., -1., HUGE_VAL, std::nan("")})
        CHECK_THROWS_WITH(solve_contact(profile, {Kernel::free, modulus}, {0.01}), Catch::Contains("modulus"));
}
