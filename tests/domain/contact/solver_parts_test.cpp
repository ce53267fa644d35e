#include "domain/contact/solvers/extension.hpp"
#include "tests/catch.hpp"

#include <random>

using namespace rough;

namespace {

/// A few nodes of a grid.
struct Scene {
    Extent shape;
    std::vector<int> nodes;
    explicit Scene(Extent extent) : shape(extent) {
        std::mt19937 random(7);
        for (int i = 0; i < shape.nodes(); ++i)
            if (random() % 6 == 0 || i == shape.nodes() / 2)
                nodes.push_back(i);
    }
    std::vector<float> field() const { return std::vector<float>(static_cast<std::size_t>(shape.nodes())); }
};

const std::vector<Extent> shapes{{64, 32}, {27, 35}, {31, 97}, {48, 5}, {9, 1}, {2, 3}, {1, 1}};

} // namespace

TEST_CASE("a continued field keeps its values at the nodes and stays within their range",
          "[contact][areas]") {
    for (const Extent shape : shapes) {
        const Scene scene(shape);
        std::vector<float> field = scene.field();
        std::mt19937 random(3);
        float lowest = 1000, largest = 0;
        for (const int i : scene.nodes) {
            float& value = field[static_cast<std::size_t>(i)] = static_cast<float>(1 + random() % 100);
            lowest = std::min(lowest, value), largest = std::max(largest, value);
        }
        const std::vector<float> before = field;
        Extension extension(shape);
        extension.know(scene.nodes);
        extension.extend(field.data());
        for (const int i : scene.nodes)
            CHECK(field[static_cast<std::size_t>(i)] == before[static_cast<std::size_t>(i)]);
        const auto [low, high] = std::minmax_element(field.begin(), field.end());
        CHECK(*low >= lowest * (1 - 1e-5F)); // so a constant stays one
        CHECK(*high <= largest * (1 + 1e-5F));
    }
}

TEST_CASE("Extension::transpose is the transpose of extend", "[contact][areas]") {
    for (const Extent shape : shapes) {
        const Scene scene(shape);
        std::vector<float> given = scene.field(), load = scene.field();
        std::mt19937 random(5);
        for (const int i : scene.nodes)
            given[static_cast<std::size_t>(i)] = static_cast<float>(random() % 100);
        for (float& value : load)
            value = static_cast<float>(random() % 100);
        std::vector<float> continued = given, carried = load;
        Extension extension(shape);
        extension.know(scene.nodes);
        extension.extend(continued.data());
        extension.transpose(carried.data());
        double all = 0, there = 0;
        for (std::size_t i = 0; i < load.size(); ++i)
            all += static_cast<double>(continued[i]) * static_cast<double>(load[i]);
        for (const int i : scene.nodes)
            there += static_cast<double>(given[static_cast<std::size_t>(i)]) *
                     static_cast<double>(carried[static_cast<std::size_t>(i)]);
        CHECK(there == Approx(all).epsilon(1e-5));
    }
}
