#include "domain/profile/solid.hpp"

#include "domain/errors.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace rough {
namespace {

using Vertex = Eigen::Vector3f;

/// Facets as STL's records of normal, three vertices and an empty attribute.
class Facets {
  public:
    void add(const Vertex& a, const Vertex& b, const Vertex& c) {
        const Eigen::Vector3d u = (b - a).cast<double>(), v = (c - a).cast<double>();
        append(u.cross(v).normalized().cast<float>());
        append(a), append(b), append(c);
        bytes_.append(2, '\0');
        ++count_;
    }
    /// Corners in the order that turns left seen from outside.
    void add(const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& d) {
        add(a, b, c);
        add(a, c, d);
    }
    std::string file() const {
        std::string header = "rugosa: extruded profile, lengths in mm";
        header.resize(80, ' ');
        append(header, count_);
        return header + bytes_;
    }

  private:
    void append(const Vertex& vertex) {
        for (int i = 0; i < 3; ++i)
            append(bytes_, std::bit_cast<std::uint32_t>(vertex[i]));
    }
    static void append(std::string& bytes, std::uint32_t word) {
        for (int shift = 0; shift < 32; shift += 8)
            bytes += static_cast<char>(word >> shift & 0xFF); // STL is little endian
    }

    std::string bytes_;
    std::uint32_t count_ = 0;
};

void expect_positive(double value, const char* what) {
    if (!(value > 0) || !std::isfinite(value))
        refuse("solid: ", what, " ", value, ", expected a number above 0");
}

void expect_normal(double length, const char* what) {
    if (!std::isnormal(static_cast<float>(length)))
        refuse("solid: a ", what, " of ", length,
               " mm, expected one that single precision holds, 1.2e-38 to 3.4e38 mm");
}

/// Numbers of single precision that a relief spans, at least; one part of 2^24 is lost beside a whole.
constexpr double fewest_levels = 256, levels = 16777216;

} // namespace

std::string binary_stl(const Profile& profile, const Extrusion& extrusion) {
    const Index nodes = profile.nodes();
    const double lowest = profile.heights.minCoeff(), range = profile.heights.maxCoeff() - lowest;
    const double length = profile.spacing * static_cast<double>(nodes - 1);
    const double width = extrusion.width != 0 ? extrusion.width : length / 4;
    const double thickest = range * levels / fewest_levels;
    const double base =
        extrusion.base != 0 ? extrusion.base : std::max(range, std::min(length / 10, thickest / 4));
    expect_positive(extrusion.magnify, "magnification");
    expect_positive(width, "width");
    expect_positive(base, "base");

    const double m = extrusion.magnify;
    expect_normal(m * length, "length");
    expect_normal(m * width, "width");
    expect_normal(m * (base + range), "height");
    if (base > thickest)
        refuse("solid: base ", base, " mm, expected at most ", thickest,
               " mm: beside a thicker one single precision loses the heights, ", range, " mm");

    Facets facets;
    const auto vertex = [&](Index i, bool back, bool top) {
        const double height = base + profile.heights[i] - lowest;
        return Vertex(static_cast<float>(m * profile.spacing * static_cast<double>(i)),
                      static_cast<float>(back ? m * width : 0), static_cast<float>(top ? m * height : 0));
    };
    struct Section {
        Vertex front_low, front_top, back_low, back_top;
    };
    const auto section = [&](Index i) {
        return Section{vertex(i, false, false), vertex(i, false, true), vertex(i, true, false),
                       vertex(i, true, true)};
    };
    Section left = section(0);
    facets.add(left.front_low, left.front_top, left.back_top, left.back_low);
    for (Index i = 1; i < nodes; ++i) {
        const Section right = section(i);
        if (!(right.front_low.x() > left.front_low.x()))
            throw InputError("solid: " + std::to_string(nodes) +
                             " nodes, more than single precision tells apart");
        facets.add(left.front_low, right.front_low, right.front_top, left.front_top);
        facets.add(right.back_low, left.back_low, left.back_top, right.back_top);
        facets.add(left.front_top, right.front_top, right.back_top, left.back_top);
        facets.add(left.back_low, right.back_low, right.front_low, left.front_low);
        left = right;
    }
    facets.add(left.front_low, left.back_low, left.back_top, left.front_top);
    return facets.file();
}

} // namespace rough
