#include "domain/profile/solid.hpp"

#include "domain/errors.hpp"
#include "domain/text/bytes.hpp"
#include "domain/text/zip.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace rough {
namespace {

using Vertex = Eigen::Vector3f;

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

Mesh extruded(const Profile& profile, const Extrusion& extrusion) {
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

    Mesh mesh;
    mesh.vertices.reserve(static_cast<std::size_t>(4 * nodes));
    mesh.facets.reserve(static_cast<std::size_t>(8 * (nodes - 1) + 4));
    using Corner = std::uint32_t;
    const auto face = [&](Corner a, Corner b, Corner c, Corner d) {
        mesh.facets.push_back({a, b, c});
        mesh.facets.push_back({a, c, d});
    };
    // Of every node: front low, front top, back low, back top.
    for (Index i = 0; i < nodes; ++i) {
        const auto x = static_cast<float>(m * profile.spacing * static_cast<double>(i));
        const auto top = static_cast<float>(m * (base + profile.heights[i] - lowest));
        const auto back = static_cast<float>(m * width);
        if (i > 0 && !(x > mesh.vertices.back().x()))
            throw InputError("solid: " + std::to_string(nodes) +
                             " nodes, more than single precision tells apart");
        for (const Vertex& vertex :
             {Vertex(x, 0, 0), Vertex(x, 0, top), Vertex(x, back, 0), Vertex(x, back, top)})
            mesh.vertices.push_back(vertex);
        const auto right = static_cast<Corner>(4 * i), left = right - 4;
        if (i == 0) {
            face(0, 1, 3, 2);
            continue;
        }
        face(left, right, right + 1, left + 1);
        face(right + 2, left + 2, left + 3, right + 3);
        face(left + 1, right + 1, right + 3, left + 3);
        face(left + 2, right + 2, right, left);
    }
    const auto last = static_cast<Corner>(4 * (nodes - 1));
    face(last, last + 2, last + 3, last + 1);
    return mesh;
}

std::string binary_stl(const Profile& profile, const Extrusion& extrusion) {
    const Mesh mesh = extruded(profile, extrusion);
    std::string bytes = "rugosa: extruded profile, lengths in mm";
    bytes.resize(80, ' ');
    append_little_endian(bytes, static_cast<std::uint32_t>(mesh.facets.size()));
    const auto append = [&](const Vertex& vertex) {
        for (int i = 0; i < 3; ++i)
            append_little_endian(bytes, vertex[i]);
    };
    for (const auto& [a, b, c] : mesh.facets) { // its normal, three corners, an empty attribute
        const auto corner = [&](std::uint32_t i) { return mesh.vertices[i]; };
        const Eigen::Vector3d u = (corner(b) - corner(a)).cast<double>(),
                              v = (corner(c) - corner(a)).cast<double>();
        append(u.cross(v).normalized().cast<float>());
        append(corner(a)), append(corner(b)), append(corner(c));
        bytes.append(2, '\0');
    }
    return bytes;
}

std::string three_mf(const Profile& profile, const Extrusion& extrusion) {
    const Mesh mesh = extruded(profile, extrusion);
    const auto number = [](auto value) {
        char text[32];
        return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
    };
    const std::string head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    std::string model =
        head +
        "<model unit=\"millimeter\" xml:lang=\"en-US\" "
        "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n"
        "<resources><object id=\"1\" type=\"model\" name=\"rugosa: extruded profile\"><mesh>\n<vertices>\n";
    for (const Vertex& vertex : mesh.vertices)
        model += "<vertex x=\"" + number(vertex.x()) + "\" y=\"" + number(vertex.y()) + "\" z=\"" +
                 number(vertex.z()) + "\"/>\n";
    model += "</vertices>\n<triangles>\n";
    for (const auto& [a, b, c] : mesh.facets)
        model += "<triangle v1=\"" + number(a) + "\" v2=\"" + number(b) + "\" v3=\"" + number(c) + "\"/>\n";
    model += "</triangles>\n</mesh></object></resources>\n<build><item objectid=\"1\"/></build>\n</model>\n";
    return zipped(
        {{"[Content_Types].xml",
          head + "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
                 "<Default Extension=\"rels\" "
                 "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
                 "<Default Extension=\"model\" "
                 "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n"},
         {"_rels/.rels",
          head + "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
                 "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
                 "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>\n"},
         {"3D/3dmodel.model", model}});
}

} // namespace rough
