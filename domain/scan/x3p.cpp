#include "domain/scan/x3p.hpp"

#include "domain/errors.hpp"
#include "domain/scan/stored_heights.hpp"
#include "domain/text/cells.hpp"
#include "domain/text/zip.hpp"

#include <boost/uuid/detail/md5.hpp>

#include <charconv>
#include <cmath>
#include <pugixml.hpp>

namespace rough {
namespace {

constexpr std::size_t most_xml = 50'000'000;

/// A child by its name without the prefix of a name space.
pugi::xml_node child(const pugi::xml_node& of, std::string_view name) {
    for (const pugi::xml_node& node : of.children()) {
        const std::string_view full = node.name();
        if (full.substr(full.find(':') == full.npos ? 0 : full.find(':') + 1) == name)
            return node;
    }
    return {};
}

std::string_view text(const pugi::xml_node& of, std::string_view name) {
    return trim(child(of, name).child_value());
}

/// The number in a node; `otherwise` where it is missing or empty.
double value(const pugi::xml_node& of, std::string_view name, double otherwise, const std::string& file) {
    const std::string_view word = text(of, name);
    if (word.empty())
        return otherwise;
    const auto read = number(word, Dialect{});
    if (!read || std::isnan(read->value))
        refuse(file, ": main.xml has ", name, " '", word.substr(0, 60), "', expected a number");
    return read->value;
}

std::int64_t size(const pugi::xml_node& of, std::string_view name, double otherwise,
                  const std::string& file) {
    const double count = value(of, name, otherwise, file);
    if (!(count >= 1 && count <= static_cast<double>(most_points)) || count != std::floor(count))
        refuse(file, ": main.xml has ", name, " ", count, ", expected 1 to ", most_points);
    return static_cast<std::int64_t>(count);
}

/// ISO 25178-71's number of an X3P type.
int type_of(std::string_view name, const std::string& file) {
    if (name == "I")
        return 5;
    if (name == "L")
        return 6;
    if (name == "F")
        return 3;
    if (name == "D")
        return 7;
    refuse(file, ": main.xml has heights of type '", name.substr(0, 60), "', expected I, L, F or D");
}

double increment(const pugi::xml_node& axes, std::string_view name, const std::string& file) {
    const pugi::xml_node axis = child(axes, name);
    const double step = value(axis, "Increment", 0, file);
    if (text(axis, "AxisType") != "I" || !(step > 0))
        refuse(file, ": main.xml has an axis ", name, " of type '", text(axis, "AxisType").substr(0, 60),
               "' and increment ", step, ", expected an incremental one (I) with its increment");
    return step;
}

/// "x;y;z" or "z", a line a point; nothing in between where none was measured.
std::vector<double> listed(const pugi::xml_node& list, std::size_t count, const std::string& file) {
    std::vector<double> heights;
    for (const pugi::xml_node& datum : list.children()) {
        std::string_view word = trim(datum.child_value());
        word = trim(word.substr(word.rfind(';') + 1)); // npos + 1 is 0
        const auto height = number(word, Dialect{});
        if (!height)
            refuse(file, ": main.xml has '", word.substr(0, 60), "' among its heights");
        heights.push_back(height->value);
        if (heights.size() > count)
            break;
    }
    if (heights.size() != count)
        refuse(file, ": main.xml lists other than ", count, " heights");
    return heights;
}

std::string hexadecimal_md5(const std::string& bytes) {
    boost::uuids::detail::md5 hash;
    hash.process_bytes(bytes.data(), bytes.size());
    boost::uuids::detail::md5::digest_type digest;
    hash.get_digest(digest);
    std::string text;
    for (const auto word : digest) // of 4 bytes or, from Boost 1.86 on, of one
        for (int shift = 8 * static_cast<int>(sizeof word) - 4; shift >= 0; shift -= 4)
            text += "0123456789abcdef"[word >> shift & 15];
    return text;
}

std::string written(double number) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

} // namespace

HeightMap read_x3p_description(
    const std::string& xml,
    const std::function<std::optional<std::string>(const std::string& name, std::size_t most)>& entry,
    const std::string& file) {
    pugi::xml_document document;
    if (const auto read = document.load_buffer(xml.data(), xml.size()); !read)
        refuse(file, ": its main.xml is no XML (", read.description(), ")");
    const pugi::xml_node root = document.document_element(), axes = child(child(root, "Record1"), "Axes"),
                         heights = child(axes, "CZ"), record = child(root, "Record3"),
                         matrix = child(record, "MatrixDimension");
    if (!axes || !record)
        refuse(file, ": its main.xml has no axes or no data, expected ISO 5436-2 (X3P)");
    HeightMap map{"ISO 25178-72 (X3P)"};
    map.height_unit = {"m", 1e3};
    const std::int64_t columns =
        matrix ? size(matrix, "SizeX", 1, file) : size(record, "ListDimension", 0, file);
    map.rows = matrix ? size(matrix, "SizeY", 1, file) : 1;
    if (matrix && size(matrix, "SizeZ", 1, file) != 1)
        refuse(file, ": main.xml has several layers, expected SizeZ 1");
    if (columns > most_points / map.rows)
        refuse(file, ": ", map.rows, " rows of ", columns, " heights, expected at most ", most_points);
    map.spacing = 1e3 * increment(axes, "CX", file);
    if (map.rows > 1)
        map.row_spacing = 1e3 * increment(axes, "CY", file);
    map.height_factor = value(heights, "Increment", 1, file);
    if (!(map.height_factor > 0))
        refuse(file, ": main.xml has the increment ", map.height_factor, " of heights, expected one above 0");

    const auto count = static_cast<std::size_t>(columns * map.rows);
    const pugi::xml_node link = child(record, "DataLink");
    const auto linked = [&](std::string_view name, std::size_t most) -> std::optional<std::string> {
        std::string path(text(link, name));
        if (path.starts_with("./"))
            path.erase(0, 2);
        return path.empty() ? std::nullopt : entry(path, most);
    };
    if (!link) {
        map.heights = listed(child(record, "DataList"), count, file);
        return map;
    }
    const int type = type_of(text(heights, "DataType"), file);
    const auto data = linked("PointDataLink", 8 * count);
    if (!data)
        refuse(file, ": the heights that main.xml names are not in the archive");
    map.heights = stored_heights(*data, 0, columns, map.rows, type, std::nan(""), file);
    if (const auto valid = linked("ValidPointsLink", count / 8 + 1))
        for (std::size_t i = 0; i < count; ++i)
            if (i / 8 >= valid->size() || !(static_cast<unsigned char>((*valid)[i / 8]) >> i % 8 & 1))
                map.heights[i] = std::nan("");
    return map;
}

HeightMap read_x3p(const std::string& bytes, const std::string& file) {
    const Zip archive(bytes, file);
    const auto xml = archive.entry("main.xml", most_xml);
    if (!xml)
        refuse(file, ": a zip archive without main.xml, expected X3P, or of an Excel workbook its table "
                     "exported as CSV");
    return read_x3p_description(
        *xml, [&](const std::string& name, std::size_t most) { return archive.entry(name, most); }, file);
}

std::string x3p(const Profile& surface) {
    std::string data;
    for (const double height : surface.heights)
        append_little_endian(data, 1e-3 * height);
    const auto axis = [](const char* name, const char* type, const std::string& step) {
        return "      <" + std::string(name) + "><AxisType>" + type + "</AxisType><DataType>D</DataType>" +
               "<Increment>" + step + "</Increment><Offset>0</Offset></" + name + ">\n";
    };
    const std::string xml =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<p:ISO5436_2 xmlns:p=\"http://www.opengps.eu/2008/ISO5436_2\">\n"
        "  <Record1>\n    <Revision>ISO5436 - 2000</Revision>\n    <FeatureType>" +
        std::string(surface.is_2d() ? "SUR" : "PRF") + "</FeatureType>\n    <Axes>\n" +
        axis("CX", "I", written(1e-3 * surface.spacing)) +
        axis("CY", "I", surface.is_2d() ? written(1e-3 * surface.row_spacing) : "1") + axis("CZ", "A", "1") +
        "    </Axes>\n  </Record1>\n"
        "  <Record2>\n    <Date>1980-01-01T00:00:00Z</Date>\n    <Creator>rugosa</Creator>\n"
        "    <Instrument><Manufacturer>none</Manufacturer><Model>rugosa</Model><Serial>none</Serial>"
        "<Version>" RUGOSA_VERSION "</Version></Instrument>\n"
        "    <CalibrationDate>1980-01-01T00:00:00Z</CalibrationDate>\n"
        "    <ProbingSystem><Type>Software</Type><Identification>none</Identification></ProbingSystem>\n"
        "    <Comment>a surface as it was modelled; the dates mean nothing</Comment>\n  </Record2>\n"
        "  <Record3>\n    <MatrixDimension><SizeX>" +
        std::to_string(surface.shape().columns) + "</SizeX><SizeY>" + std::to_string(surface.rows) +
        "</SizeY><SizeZ>1</SizeZ></MatrixDimension>\n"
        "    <DataLink><PointDataLink>bindata/data.bin</PointDataLink><MD5ChecksumPointData>" +
        hexadecimal_md5(data) +
        "</MD5ChecksumPointData></DataLink>\n  </Record3>\n"
        "  <Record4><ChecksumFile>md5checksum.hex</ChecksumFile></Record4>\n</p:ISO5436_2>\n";
    return zipped({{"main.xml", xml},
                   {"bindata/data.bin", data},
                   {"md5checksum.hex", hexadecimal_md5(xml) + " *main.xml\n"}});
}

} // namespace rough
