#include "domain/profile/solid.hpp"
#include "domain/text/zip.hpp"
#include "tests/catch.hpp"
#include "tests/domain/contact/maps.hpp"
#include "tests/domain/random_genome.hpp"
#include "tests/folder.hpp"

#include <Eigen/Geometry>

#include <cstring>
#include <map>
#include <pugixml.hpp>
#include <set>

using namespace rough;

namespace {

using Corner = std::array<float, 3>;
struct Facets {
    std::vector<std::array<Corner, 3>> facets;
    std::vector<Corner> normals;
};

Facets parsed(const std::string& stl) {
    std::uint32_t count = 0;
    std::memcpy(&count, stl.data() + 80, 4);
    REQUIRE(stl.size() == 84 + 50 * std::size_t(count));
    Facets mesh;
    for (std::uint32_t f = 0; f < count; ++f) {
        std::array<Corner, 4> record;
        std::memcpy(&record, stl.data() + 84 + 50 * std::size_t(f), 48);
        mesh.normals.push_back(record[0]);
        mesh.facets.push_back({record[1], record[2], record[3]});
    }
    return mesh;
}

Eigen::Vector3d vector(const Corner& corner) { return {corner[0], corner[1], corner[2]}; }

/// Checks that every edge is passed once in each direction and that normals point outwards; gives the volume.
double closed_volume(const Facets& mesh) {
    double six = 0;
    std::map<std::pair<Corner, Corner>, int> edges;
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
        const auto& [a, b, c] = mesh.facets[f];
        for (const auto& edge : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) ++edges[edge];
        six += vector(a).dot(vector(b).cross(vector(c)));
        const Eigen::Vector3d normal = (vector(b) - vector(a)).cross(vector(c) - vector(a)).normalized();
        CHECK((normal - vector(mesh.normals[f])).norm() < 1e-6);
    }
    for (const auto& [edge, times] : edges) {
        CHECK(times == 1);
        CHECK(edges.count({edge.second, edge.first}) == 1);
    }
    return six / 6;
}

std::string output_of(const std::string& command) {
    FILE* pipe = popen(command.c_str(), "r");
    REQUIRE(pipe != nullptr);
    std::string output;
    for (int c = 0; (c = std::fgetc(pipe)) != EOF;) output += char(c);
    REQUIRE(pclose(pipe) == 0);
    return output;
}

Profile rough_profile(unsigned seed, Index nodes) {
    std::mt19937_64 random(seed);
    return sample(testing::random_genome(random, 2, 3, 0.84942, 0.84942 / 100), {.nodes = nodes});
}

} // namespace

TEST_CASE("a profile's solid is closed, and its volume is the profile's area times the width") {
    const Profile profile = rough_profile(2, 400);
    for (const double magnify : {1.0, 50.0}) {
        const Facets mesh = parsed(binary_stl(profile, {.width = 0.3, .base = 0.2, .magnify = magnify}));
        CHECK(mesh.facets.size() == 8 * 399 + 4);
        const Eigen::ArrayXd z = profile.heights.array() - profile.heights.minCoeff() + 0.2;
        const double area = (z.sum() - (z[0] + z[z.size() - 1]) / 2) * profile.spacing;
        CHECK(closed_volume(mesh) == Approx(area * 0.3 * std::pow(magnify, 3)).epsilon(1e-5));
    }
}

TEST_CASE("a map's solid is closed and as large as its prism over all cells", "[areal]") {
    const Profile map =
        maps::map_of({7, 5}, 0.1, 0.2, [](double x, double y) { return std::sin(9 * x) * std::cos(4 * y); });
    const double low = map.heights.minCoeff();
    for (const bool periodic : {false, true}) {
        const Extrusion extrusion{.base = 0.5, .magnify = 2, .periodic = periodic};
        const auto node = [&](Index i, Index n) { // outer corners have the heights of nodes
            return periodic ? i % n : std::clamp<Index>(i - 1, 0, n - 1);
        };
        const auto at = [&](Index i, Index n, double spacing) {
            return spacing * (periodic ? double(i) : std::clamp(double(i) - 0.5, 0., double(n)));
        };
        const Index columns = periodic ? 8 : 9, rows = periodic ? 6 : 7;
        double volume = 0; // each cell is cut into two triangles along its rising diagonal
        for (Index j = 0; j < rows - 1; ++j)
            for (Index i = 0; i < columns - 1; ++i) {
                const auto z = [&](Index x, Index y) { return map.heights[node(y, 5) * 7 + node(x, 7)] - low + 0.5; };
                volume += (at(i + 1, 7, 0.1) - at(i, 7, 0.1)) * (at(j + 1, 5, 0.2) - at(j, 5, 0.2)) *
                          ((z(i, j) + z(i + 1, j + 1)) / 3 + (z(i + 1, j) + z(i, j + 1)) / 6);
            }
        const Facets mesh = parsed(binary_stl(map, extrusion));
        CHECK(mesh.facets.size() == std::size_t(4 * (columns * rows - 1)));
        CHECK(closed_volume(mesh) == Approx(8 * volume).epsilon(1e-5));
        Eigen::Array3f high = Eigen::Array3f::Zero();
        for (const Eigen::Vector3f& vertex : solid(map, extrusion).vertices) high = high.max(vertex.array());
        CHECK(high[0] == Approx(2 * 0.7));
        CHECK(high[1] == Approx(2 * 1));
    }
    CHECK_THROWS_WITH(solid(map, {.width = 1}), Catch::Contains("as wide as they are"));
}

TEST_CASE("ADMesh finds no fault in a profile's solid") {
    const tests::Folder folder;
    for (const Index nodes : {2, 512, 5001}) {
        const auto file = folder.write("solid.stl", binary_stl(rough_profile(3, nodes), {.magnify = 100}));
        const std::string report = output_of("admesh " + file.string());
        INFO(report);
        const auto count = [&](const std::string& what) {
            const auto place = report.find(what);
            REQUIRE(place != std::string::npos);
            return std::stol(report.substr(report.find(':', place) + 1));
        };
        CHECK(count("Number of facets") == 8 * (nodes - 1) + 4);
        CHECK(count("Number of parts") == 1);
        for (const std::string fault :
             {"Total disconnected facets", "Degenerate facets", "Edges fixed", "Facets removed", "Facets added",
              "Facets reversed", "Backwards edges", "Normals fixed"})
            CHECK(count(fault) == 0);
    }
}

TEST_CASE("a solid beyond single precision is refused, and its base leaves heights resolved") {
    const Profile profile = rough_profile(5, 50);
    CHECK_THROWS_WITH(binary_stl(profile, {.width = 1e308}), Catch::Contains("width of 1e+308 mm"));
    CHECK_THROWS_WITH(binary_stl(profile, {.width = 1e-308}), Catch::Contains("width of 1e-308 mm"));
    CHECK_THROWS_WITH(binary_stl(profile, {.magnify = 1e300}), Catch::Contains("length of"));
    CHECK_THROWS_WITH(binary_stl(profile, {.base = 1e7}), Catch::Contains("base 10000000 mm"));
    std::set<float> levels;
    for (const auto& facet : parsed(binary_stl({1e-9 * profile.heights, profile.spacing})).facets)
        for (const Corner& corner : facet) levels.insert(corner[2]);
    CHECK(levels.size() >= 45); // 50 nodes
}

TEST_CASE("a 3MF file has the STL's solid in millimetres and the parts of its format") {
    const Profile profile = rough_profile(6, 120);
    const Extrusion extrusion{.width = 0.3, .base = 0.2, .magnify = 10};
    const std::string bytes = three_mf(profile, extrusion);
    CHECK(bytes == three_mf(profile, extrusion)); // no clock in it
    const Zip zip(bytes, "solid.3mf");
    for (const auto& [name, part] : {std::pair("[Content_Types].xml", "3dmanufacturing-3dmodel+xml"),
                                     std::pair("_rels/.rels", "/3D/3dmodel.model")}) {
        pugi::xml_document document;
        const std::string xml = zip.entry(name, 10000).value();
        CHECK(document.load_string(xml.c_str()));
        CHECK_THAT(xml, Catch::Contains(part));
    }
    pugi::xml_document document;
    REQUIRE(document.load_string(zip.entry("3D/3dmodel.model", 10'000'000).value().c_str()));
    const auto model = document.child("model");
    CHECK(std::string(model.attribute("unit").value()) == "millimeter");
    const auto mesh = model.child("resources").child("object").child("mesh");
    CHECK(std::string(model.child("build").child("item").attribute("objectid").value()) ==
          model.child("resources").child("object").attribute("id").value());
    std::vector<Corner> vertices;
    for (const auto& vertex : mesh.child("vertices").children())
        vertices.push_back(
            {vertex.attribute("x").as_float(), vertex.attribute("y").as_float(), vertex.attribute("z").as_float()});
    const Facets stl = parsed(binary_stl(profile, extrusion));
    std::size_t f = 0;
    for (const auto& triangle : mesh.child("triangles").children()) {
        const auto corner = [&](const char* name) { return vertices.at(triangle.attribute(name).as_uint()); };
        REQUIRE(stl.facets.at(f++) == std::array{corner("v1"), corner("v2"), corner("v3")});
    }
    CHECK(f == stl.facets.size());
    CHECK_FALSE(zip.entry("3D/other.model", 10));
}
