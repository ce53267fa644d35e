#include "domain/profile/solid.hpp"

#include "domain/errors.hpp"
#include "domain/text/bytes.hpp"
#include "domain/text/zip.hpp"

#include <Eigen/Geometry>

#include <bit>
#include <charconv>
#include <cmath>
#include <png.h>

namespace rough {
namespace {

using Vertex = Eigen::Vector3f;

/// Lowest number of single-precision levels in a relief, and their number in a whole (2^24).
constexpr double min_levels = 256, levels = 16777216;

/// The width of the solid in the second direction, mm.
double width_of(const Profile& surface, const Extrusion& extrusion) {
    const auto [columns, rows] = surface.shape();
    return surface.is_2d() ? surface.row_spacing * static_cast<double>(rows)
                           : extrusion.width.value_or(surface.spacing * static_cast<double>(columns - 1) / 4);
}

/// The heights of a solid along one axis.
struct SolidAxis {
    std::vector<double> at;  ///< positions, mm
    std::vector<Index> node; ///< nodes with these heights
};

/// The axis of a line or map: its nodes, and a map's edges with the heights of the nodes nearest to them.
SolidAxis axis_of(Index nodes, double spacing, bool is_2d, bool periodic) {
    SolidAxis axis;
    const bool has_cells = is_2d && !periodic;
    if (has_cells) axis = {{0}, {0}};
    for (Index i = 0; i < nodes; ++i) {
        axis.at.push_back((has_cells ? spacing / 2 : 0) + spacing * static_cast<double>(i));
        axis.node.push_back(i);
    }
    if (is_2d) {
        axis.at.push_back(spacing * static_cast<double>(nodes));
        axis.node.push_back(periodic ? 0 : nodes - 1);
    }
    return axis;
}

constexpr double white = 65535, max_pixels = 25e6, max_side = 1e6; // the last is that of libpng

void append(png_structp png, png_bytep data, std::size_t size) noexcept {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}

/// Appends a PNG file; false if libpng refuses. As it leaves by longjmp, no object here has a destructor.
bool write_png(std::string& bytes, Extent size, png_bytepp rows, png_textp text, int texts) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    if (!info) {
        png_destroy_write_struct(&png, nullptr);
        return false;
    }
    if (setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        return false;
    }
    png_set_write_fn(png, &bytes, append, nullptr);
    png_set_IHDR(png, info, static_cast<png_uint_32>(size.columns), static_cast<png_uint_32>(size.rows), 16,
                 PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_text(png, info, text, texts);
    png_write_info(png, info);
    if (std::endian::native == std::endian::little) png_set_swap(png);
    png_write_image(png, rows);
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    return true;
}

} // namespace

Mesh solid(const Profile& surface, const Extrusion& extrusion) {
    const auto [nodes, map_rows] = surface.shape();
    const bool is_2d = surface.is_2d();
    if (is_2d && (extrusion.width || nodes < 2 || map_rows < 2))
        refuse("solid: a map of ", nodes, " x ", map_rows, " heights", extrusion.width ? " and a width" : "",
               "; give 2 x 2 or more without a width: maps are as wide as they are");
    const double lowest = surface.heights.minCoeff(), range = surface.heights.maxCoeff() - lowest;
    const double width = width_of(surface, extrusion);
    const SolidAxis along_x = axis_of(nodes, surface.spacing, is_2d, extrusion.periodic),
                    along_y = is_2d ? axis_of(map_rows, surface.row_spacing, true, extrusion.periodic)
                                    : SolidAxis{{0, width}, {0, 0}}; // the ends of a profile's ridges
    const auto columns = static_cast<Index>(along_x.at.size()), rows = static_cast<Index>(along_y.at.size());
    const double length = along_x.at.back();
    const double thickest = range * levels / min_levels;
    const double base = extrusion.base.value_or(std::max(range, std::min(length / 10, thickest / 4)));
    const double m = extrusion.magnify;
    for (const auto& [name, value] : {std::pair("magnification", m), {"width", width}, {"base", base}})
        if (!(value > 0) || !std::isfinite(value))
            refuse("solid: ", name, " ", value, " is out of range (above 0, finite)");
    for (const auto& [name, value] :
         {std::pair("length", m * length), {"width", m * width}, {"height", m * (base + range)}})
        if (!std::isnormal(static_cast<float>(value)))
            refuse("solid: a ", name, " of ", value, " mm is beyond single precision; use 1.2e-38 to 3.4e38 mm");
    if (base > thickest)
        refuse("solid: base ", base, " mm is out of range (at most ", thickest,
               " mm: single precision loses heights of ", range, " mm in a thicker one)");

    Mesh mesh;
    mesh.vertices.reserve(static_cast<std::size_t>(2 * columns * rows));
    using Corner = std::uint32_t;
    // Vertices: low and high for each node, row after row at one x, then the next x.
    const auto low = [&](Index i, Index j) { return static_cast<Corner>(2 * (i * rows + j)); };
    const auto high = [&](Index i, Index j) { return low(i, j) + 1; };
    for (Index i = 0; i < columns; ++i)
        for (Index j = 0; j < rows; ++j) {
            const auto column = static_cast<std::size_t>(i), row = static_cast<std::size_t>(j);
            const double height = surface.heights[along_y.node[row] * nodes + along_x.node[column]];
            const auto x = static_cast<float>(m * along_x.at[column]), y = static_cast<float>(m * along_y.at[row]),
                       top = static_cast<float>(m * (base + height - lowest));
            if ((j > 0 && !(y > mesh.vertices.back().y())) || (j == 0 && i > 0 && !(x > mesh.vertices.back().x())))
                refuse("solid: ", surface.nodes(), " nodes are more than single precision resolves; use fewer nodes");
            mesh.vertices.emplace_back(x, y, 0);
            mesh.vertices.emplace_back(x, y, top);
        }
    const auto face = [&](Corner a, Corner b, Corner c, Corner d) {
        mesh.facets.push_back({a, b, c});
        mesh.facets.push_back({a, c, d});
    };
    const Index last = columns - 1, back = rows - 1;
    for (Index j = 0; j < back; ++j) face(low(0, j), high(0, j), high(0, j + 1), low(0, j + 1));
    for (Index i = 0; i < last; ++i) {
        face(low(i, 0), low(i + 1, 0), high(i + 1, 0), high(i, 0));
        face(low(i + 1, back), low(i, back), high(i, back), high(i + 1, back));
        for (Index j = 0; j < back; ++j) {
            face(high(i, j), high(i + 1, j), high(i + 1, j + 1), high(i, j + 1));
            face(low(i, j + 1), low(i + 1, j + 1), low(i + 1, j), low(i, j));
        }
    }
    for (Index j = 0; j < back; ++j) face(low(last, j), low(last, j + 1), high(last, j + 1), high(last, j));
    return mesh;
}

std::string binary_stl(const Profile& surface, const Extrusion& extrusion) {
    const Mesh mesh = solid(surface, extrusion);
    std::string bytes = "rugosa: a rough surface, lengths in mm";
    bytes.resize(80, ' ');
    append_little_endian(bytes, static_cast<std::uint32_t>(mesh.facets.size()));
    const auto append = [&](const Vertex& vertex) {
        for (int i = 0; i < 3; ++i) append_little_endian(bytes, vertex[i]);
    };
    for (const auto& [a, b, c] : mesh.facets) { // normal, three corners, an empty attribute
        const auto corner = [&](std::uint32_t i) { return mesh.vertices[i]; };
        const Eigen::Vector3d u = (corner(b) - corner(a)).cast<double>(), v = (corner(c) - corner(a)).cast<double>();
        append(u.cross(v).normalized().cast<float>());
        append(corner(a)), append(corner(b)), append(corner(c));
        bytes.append(2, '\0');
    }
    return bytes;
}

std::string three_mf(const Profile& surface, const Extrusion& extrusion) {
    const Mesh mesh = solid(surface, extrusion);
    const auto number = [](auto value) {
        char text[32];
        return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
    };
    const std::string head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    std::string model =
        head + "<model unit=\"millimeter\" xml:lang=\"en-US\" "
               "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n"
               "<resources><object id=\"1\" type=\"model\" name=\"rugosa: a rough surface\"><mesh>\n<vertices>\n";
    for (const Vertex& vertex : mesh.vertices)
        model += "<vertex x=\"" + number(vertex.x()) + "\" y=\"" + number(vertex.y()) + "\" z=\"" + number(vertex.z()) +
                 "\"/>\n";
    model += "</vertices>\n<triangles>\n";
    for (const auto& [a, b, c] : mesh.facets)
        model += "<triangle v1=\"" + number(a) + "\" v2=\"" + number(b) + "\" v3=\"" + number(c) + "\"/>\n";
    model += "</triangles>\n</mesh></object></resources>\n<build><item objectid=\"1\"/></build>\n</model>\n";
    return zipped({{"[Content_Types].xml",
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

HeightImage height_image(const Profile& surface, const Extrusion& extrusion) {
    const auto [columns, map_rows] = surface.shape();
    const double width = width_of(surface, extrusion);
    const double rows = surface.is_2d() ? static_cast<double>(map_rows) // else nearly square pixels
                                        : std::max(2.0, 1 + std::round(width / surface.spacing));
    const auto side = static_cast<double>(columns);
    if (!(rows * side <= max_pixels && std::max(rows, side) <= max_side))
        refuse("height image: ", columns, " x ", rows, " pixels are more than ", max_pixels, " or than ", max_side,
               " along a side; use fewer nodes or a smaller width");
    const double lowest = surface.heights.minCoeff(), level = (surface.heights.maxCoeff() - lowest) / white;
    std::vector<std::uint16_t> greys(static_cast<std::size_t>(surface.nodes()));
    for (std::size_t i = 0; i < greys.size() && level > 0; ++i)
        greys[i] = static_cast<std::uint16_t>(std::lround((surface.heights[static_cast<Index>(i)] - lowest) / level));
    std::vector<png_bytep> lines(static_cast<std::size_t>(rows)); // from the largest y to the smallest
    for (std::size_t j = 0; j < lines.size(); ++j)
        lines[j] = reinterpret_cast<png_bytep>(
            &greys[surface.is_2d() ? (lines.size() - 1 - j) * static_cast<std::size_t>(columns) : 0]);

    HeightImage image;
    image.scale = {{"height_per_grey_mm", level},
                   {"lowest_height_mm", lowest},
                   {"spacing_mm", surface.spacing},
                   {"row_spacing_mm", surface.is_2d() ? surface.row_spacing : width / (rows - 1)}};
    std::vector<std::pair<std::string, std::string>> texts{
        {"Description", "height = lowest_height_mm + grey * height_per_grey_mm, x to the right, y upwards"}};
    for (const auto& [name, value] : image.scale) texts.emplace_back(name, line_with_digits(17, value));
    std::vector<png_text> chunks(texts.size());
    for (std::size_t i = 0; i < texts.size(); ++i) {
        chunks[i].compression = PNG_TEXT_COMPRESSION_NONE;
        chunks[i].key = texts[i].first.data();
        chunks[i].text = texts[i].second.data();
        chunks[i].text_length = texts[i].second.size();
    }
    if (!write_png(image.png, {columns, static_cast<Index>(rows)}, lines.data(), chunks.data(),
                   static_cast<int>(chunks.size())))
        refuse("height image: libpng cannot write it; use fewer nodes");
    return image;
}

} // namespace rough
