#include "domain/errors.hpp"
#include "domain/scan/map.hpp"
#include "domain/text/bytes.hpp"
#include "domain/text/zip.hpp"
#include "ga/base/number.hpp"

#include <boost/uuid/detail/md5.hpp>

#include <cmath>
#include <pugixml.hpp>

namespace rough {
namespace {

constexpr std::size_t max_xml_bytes = 50'000'000;
constexpr std::ptrdiff_t max_xml_nodes = 1'000'000; // an element with text counts as two; attributes, too

/// A child by its name without a namespace prefix.
pugi::xml_node child(const pugi::xml_node& of, std::string_view name) {
    return of.find_child([&](const pugi::xml_node& node) {
        const std::string_view full = node.name();
        return full.substr(full.find(':') + 1) == name; // npos + 1 is 0
    });
}

std::string_view text(const pugi::xml_node& of, std::string_view name) { return trim(child(of, name).child_value()); }

/// Parses the text, which must outlive the document.
void load_xml(pugi::xml_document& document, std::string& xml, const std::string& name, const std::string& file) {
    if (std::ranges::count_if(xml, [](char c) { return c == '<' || c == '='; }) > max_xml_nodes)
        refuse(file, ": its ", name, " has more than ", max_xml_nodes,
               " elements and attributes; store the heights as binary");
    if (const auto parsed = document.load_buffer_inplace(xml.data(), xml.size()); !parsed)
        refuse(file, ": its ", name, " is not XML (", parsed.description(), "); export it again");
}

/// The number in a node; `fallback` if it is missing or empty.
double value(const pugi::xml_node& of, std::string_view name, double fallback, const std::string& file) {
    const std::string_view word = text(of, name);
    if (word.empty()) return fallback;
    const auto read = number(word, Dialect{});
    if (!read || std::isnan(read->value))
        refuse(file, ": main.xml: ", name, " '", word.substr(0, 60), "' is not a number; export it again");
    return read->value;
}

std::int64_t size(const pugi::xml_node& of, std::string_view name, double fallback, const std::string& file) {
    constexpr double max_size = 20'000'000;
    const double count = value(of, name, fallback, file);
    if (!(count >= 1 && count <= max_size) || count != std::floor(count))
        refuse(file, ": main.xml: ", name, " ", count, " is out of range (a whole number from 1 to ", max_size, ")");
    return static_cast<std::int64_t>(count);
}

/// ISO 25178-71's number of an X3P type.
int type_of(std::string_view name, const std::string& file) {
    constexpr std::string_view names = "ILFD";
    if (name.size() != 1 || names.find(name) == names.npos)
        refuse(file, ": main.xml: heights of type '", name.substr(0, 60), "'; use I, L, F or D");
    return std::array{5, 6, 3, 7}[names.find(name)];
}

double increment(const pugi::xml_node& axes, std::string_view name, const std::string& file) {
    const pugi::xml_node axis = child(axes, name);
    const double step = value(axis, "Increment", 0, file);
    if (text(axis, "AxisType") != "I" || !(step > 0))
        refuse(file, ": main.xml: axis ", name, " of type '", text(axis, "AxisType").substr(0, 60), "' and increment ",
               step, "; use an incremental axis (I) with its increment");
    return step;
}

/// Heights from the XML: "x;y;z" or "z" for each point, empty if it was not measured.
Eigen::VectorXd listed(const pugi::xml_node& list, Index count, const std::string& file) {
    Eigen::VectorXd heights(count);
    Index found = 0;
    for (const pugi::xml_node& datum : list.children()) {
        std::string_view word = trim(datum.child_value());
        word = trim(word.substr(word.rfind(';') + 1)); // npos + 1 is 0
        const auto height = number(word, Dialect{});
        if (!height) refuse(file, ": main.xml: height '", word.substr(0, 60), "' is not a number; export it again");
        if (found++ < count) heights[found - 1] = height->value;
    }
    if (found != count)
        refuse(file, ": main.xml lists ", found, " heights, but announces ", count, "; export it again");
    return heights;
}

/// MD5 in hexadecimal digits, as X3P requires it.
std::string md5_of(std::string_view bytes) {
    boost::uuids::detail::md5 hash;
    hash.process_bytes(bytes.data(), bytes.size());
    boost::uuids::detail::md5::digest_type digest;
    hash.get_digest(digest);
    std::string text;
    for (const auto word : digest) // a word has 4 bytes, from Boost 1.86 on one
        for (int shift = 8 * static_cast<int>(sizeof word) - 4; shift >= 0; shift -= 4)
            text += "0123456789abcdef"[word >> shift & 15];
    return text;
}

void expect_checksum(std::string_view given, std::string_view bytes, const std::string& part, const std::string& file) {
    if (!given.empty() && lower(given) != md5_of(bytes))
        refuse(file, ": its ", part, " has the MD5 ", md5_of(bytes), ", but the archive gives ", given.substr(0, 60),
               "; export it again");
}

} // namespace

HeightMap read_x3p(const Zip& archive, const std::string& file) {
    const std::string folder = archive.folder_of("main.xml");
    auto xml = archive.entry(folder + "main.xml", max_xml_bytes);
    if (!xml)
        refuse(file, ": a zip archive without main.xml or sheets",
               archive.entry("index.xml", max_xml_bytes) ? " (Sensofar's PLUX)" : "",
               "; export it as X3P, SDF or text");
    if (const auto checksum = archive.entry(folder + "md5checksum.hex", 1000))
        expect_checksum(std::string_view(*checksum).substr(0, checksum->find_first_of(" \t\r\n*")), *xml, "main.xml",
                        file);
    pugi::xml_document document;
    load_xml(document, *xml, "main.xml", file);
    const pugi::xml_node root = document.document_element(), axes = child(child(root, "Record1"), "Axes"),
                         heights = child(axes, "CZ"), record = child(root, "Record3"),
                         matrix = child(record, "MatrixDimension"), link = child(record, "DataLink");
    if (!axes || !record) refuse(file, ": its main.xml has no axes or no data; export it as ISO 5436-2 (X3P)");
    HeightMap map{.format = "ISO 25178-72 (X3P)", .height_unit = {"m", 1e3}};
    const std::int64_t columns = matrix ? size(matrix, "SizeX", 1, file) : size(record, "ListDimension", 0, file);
    map.rows = matrix ? size(matrix, "SizeY", 1, file) : 1;
    if (matrix && size(matrix, "SizeZ", 1, file) != 1)
        refuse(file, ": main.xml has several layers; export one (SizeZ 1)");
    expect_points(columns, map.rows, file);
    map.spacing = 1e3 * increment(axes, "CX", file);
    if (map.rows > 1) map.row_spacing = 1e3 * increment(axes, "CY", file);
    map.height_factor = value(heights, "Increment", 1, file);
    if (!(map.height_factor > 0))
        refuse(file, ": main.xml: the heights' increment ", map.height_factor, " is out of range (above 0)");

    const std::int64_t count = columns * map.rows;
    if (!link) {
        map.heights = listed(child(record, "DataList"), count, file);
        return map;
    }
    const auto linked = [&](const char* name, const char* checksum, std::int64_t max_size) {
        std::string path(text(link, name));
        if (path.starts_with("./")) path.erase(0, 2);
        std::optional<std::string> found;
        if (!path.empty()) {
            found = archive.entry(folder + path, static_cast<std::size_t>(max_size));
            if (!found)
                refuse(file, ": main.xml names '", path.substr(0, 60),
                       "', which is not in the archive; export it again");
            expect_checksum(text(link, checksum), *found, path, file);
        }
        return found;
    };
    const auto data = linked("PointDataLink", "MD5ChecksumPointData", 8 * count);
    if (!data) refuse(file, ": main.xml has no link to heights; add a PointDataLink");
    map.heights = stored_numbers(*data, count, type_of(text(heights, "DataType"), file), std::nan(""), file);
    if (const auto mask = linked("ValidPointsLink", "MD5ChecksumValidPoints", count / 8 + 1)) {
        if (8 * static_cast<Index>(mask->size()) < count)
            refuse(file, ": its valid points end early, before ", count, " bits; export it again");
        for (Index i = 0; i < count; ++i)
            if (!((*mask)[static_cast<std::size_t>(i / 8)] >> i % 8 & 1)) map.heights[i] = std::nan("");
    }
    return map;
}

std::optional<std::string> sheet_of(const Zip& archive, const std::string& file) {
    std::vector<std::string> shared; // texts of cells
    pugi::xml_document document;
    if (auto xml = archive.entry("xl/sharedStrings.xml", max_xml_bytes)) {
        load_xml(document, *xml, "sharedStrings.xml", file);
        for (const pugi::xml_node& item : document.document_element().children()) {
            std::string& text = shared.emplace_back();
            for (const auto& part : item.select_nodes(".//*[local-name()='t']")) text += part.node().child_value();
        }
    }
    std::optional<std::string> best;
    long most = -1;
    for (int sheet = 1; sheet < 1000; ++sheet) {
        auto xml = archive.entry("xl/worksheets/sheet" + std::to_string(sheet) + ".xml", max_xml_bytes);
        if (!xml) break;
        load_xml(document, *xml, "sheet " + std::to_string(sheet), file);
        std::vector<std::string> rows;
        std::size_t widest = 0; // column
        long numbers = 0;
        for (const pugi::xml_node& row : child(document.document_element(), "sheetData").children()) {
            std::size_t column = 0;
            std::string& line = rows.emplace_back();
            for (const pugi::xml_node& cell : row.children()) {
                std::size_t place = 0; // "AB12" is in column 28
                for (const char* c = cell.attribute("r").value(); *c >= 'A' && *c <= 'Z' && place < 20000; ++c)
                    place = 26 * place + static_cast<std::size_t>(*c - 'A') + 1;
                const std::size_t tabs = place > column + 1 ? place - column - 1 : 0;
                line.append(tabs + (column > 0), ';');
                column += tabs + 1;
                const std::string_view type = cell.attribute("t").value();
                std::string word(text(cell, "v"));
                if (type == "s")
                    if (const auto index = number(word, Dialect{});
                        index && index->value >= 0 && index->value < static_cast<double>(shared.size()))
                        word = shared[static_cast<std::size_t>(index->value)];
                if (type == "inlineStr") word = text(child(cell, "is"), "t");
                numbers += type.empty() || type == "n";
                std::ranges::replace_if(
                    word, [](char c) { return c == ';' || c == '\n'; }, ' ');
                line += word;
            }
            widest = std::max(widest, column);
        }
        if (numbers <= most) continue;
        most = numbers;
        best = "";
        for (std::string& line : rows) { // empty cells at its end are missing heights
            const auto marks = static_cast<std::size_t>(std::ranges::count(line, ';'));
            *best += line.append(widest - std::min(widest, marks + 1), ';') + '\n';
        }
    }
    return best;
}

std::string x3p(const Profile& surface) {
    std::string data;
    for (const double height : surface.heights) append_little_endian(data, 1e-3 * height);
    const auto axis = [](const char* name, const char* type, const std::string& step) {
        return "      <" + std::string(name) + "><AxisType>" + type + "</AxisType><DataType>D</DataType>" +
               "<Increment>" + step + "</Increment><Offset>0</Offset></" + name + ">\n";
    };
    const std::string xml =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<p:ISO5436_2 xmlns:p=\"http://www.opengps.eu/2008/ISO5436_2\">\n"
        "  <Record1>\n    <Revision>ISO5436 - 2000</Revision>\n    <FeatureType>" +
        std::string(surface.is_2d() ? "SUR" : "PRF") + "</FeatureType>\n    <Axes>\n" +
        axis("CX", "I", ga::number(1e-3 * surface.spacing)) +
        axis("CY", "I", surface.is_2d() ? ga::number(1e-3 * surface.row_spacing) : "1") + axis("CZ", "A", "1") +
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
        md5_of(data) +
        "</MD5ChecksumPointData></DataLink>\n  </Record3>\n"
        "  <Record4><ChecksumFile>md5checksum.hex</ChecksumFile></Record4>\n</p:ISO5436_2>\n";
    return zipped({{"main.xml", xml}, {"bindata/data.bin", data}, {"md5checksum.hex", md5_of(xml) + " *main.xml\n"}});
}

} // namespace rough
