#include "domain/errors.hpp"
#include "domain/scan/map.hpp"
#include "domain/text/bytes.hpp"

#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <zlib.h>

namespace rough {
namespace {

constexpr double missing_height = std::numeric_limits<double>::quiet_NaN();

/// A type of numbers: its size in bytes, its reader, and its mark of a missing value.
struct NumberType {
    std::int64_t size;
    double (*load)(std::string_view bytes, std::size_t at);
    double missing;
};
template <class T>
constexpr NumberType number_type(double missing = missing_height) {
    return {sizeof(T), [](std::string_view bytes, std::size_t at) -> double { return little_endian<T>(bytes, at); },
            missing};
}
constexpr NumberType number_types[] = {number_type<std::uint8_t>(),
                                       number_type<std::uint16_t>(65535),
                                       number_type<std::uint32_t>(4294967295),
                                       number_type<float>(),
                                       number_type<std::int8_t>(),
                                       number_type<std::int16_t>(-32768),
                                       number_type<std::int32_t>(-2147483648.),
                                       number_type<double>()};

/// Reads the heights, row after row, that start at a byte.
void take_heights(HeightMap& map, std::string_view bytes, std::size_t at, std::int64_t columns, int type,
                  double missing, const std::string& file) {
    expect_points(columns, map.rows, file);
    map.heights = stored_numbers(bytes.substr(std::min(at, bytes.size())), columns * map.rows, type, missing, file);
}

void expect_spacing(double spacing, const std::string& what, const std::string& file) {
    if (!(spacing > 0) || !std::isfinite(spacing))
        refuse(file, ": ", what, " ", spacing, " is out of range (above 0, finite)");
}

void expect_header(const std::string& bytes, std::size_t size, const std::string& file) {
    if (bytes.size() < size)
        refuse(file, ": ", bytes.size(), " bytes, fewer than the header of ", size, "; export it again");
}

/// ISO 25178-71, binary: 81 bytes of header, lengths in metres. In version 2.0 the numbers of points and of
/// profiles have 32 bits each, and the header 85 bytes.
HeightMap surface_data_file(const std::string& bytes, const std::string& file) {
    const bool wide = bytes.starts_with("bISO-2");
    const std::size_t header = wide ? 85 : 81, scales = header - 35;
    expect_header(bytes, header, file);
    const auto count = [&](std::size_t which) -> std::int64_t {
        if (wide) return little_endian<std::uint32_t>(bytes, 42 + 4 * which);
        return little_endian<std::uint16_t>(bytes, 42 + 2 * which);
    };
    const std::int64_t columns = count(0);
    HeightMap map{.format = "ISO 25178-71 (SDF)", .height_unit = {"m", 1e3}};
    map.rows = count(1);
    map.spacing = 1e3 * little_endian<double>(bytes, scales);
    map.row_spacing = 1e3 * little_endian<double>(bytes, scales + 8);
    map.height_factor = little_endian<double>(bytes, scales + 16);
    expect_spacing(map.spacing, "Xscale", file);
    expect_spacing(map.height_factor, "Zscale", file);
    if (map.rows > 1) expect_spacing(map.row_spacing, "Yscale", file);
    if (bytes[header - 3] != 0) refuse(file, ": the heights are compressed; save it without compression");
    const int type = static_cast<unsigned char>(bytes[header - 2]);
    take_heights(map, bytes, header, columns, type, missing_mark(type), file);
    return map;
}

/// A unit in a field of 16 bytes of Latin-1, where µ is one byte.
LengthUnit unit_field(const std::string& bytes, std::size_t at, const std::string& file) {
    std::string word = bytes.substr(at, 16);
    word.resize(std::min(word.find('\0'), word.size()));
    if (const auto micro = word.find('\xB5'); micro != std::string::npos) word.replace(micro, 1, "u");
    return length_unit_named(trim(word), file);
}

/// A number as its shortest decimal with this precision: 0.0005, not 0.0005000000237.
double decimal(float number) {
    std::array<char, 64> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
    double value = number;
    std::from_chars(text.data(), end, value);
    return value;
}

/// The compressed heights of a Digital Surf file, `size` bytes. It has the number of streams, their lengths
/// before and after compression, and the streams (zlib).
std::string uncompressed(std::string_view data, std::size_t size, const std::string& file) {
    const auto word = [&, data](std::size_t index) -> std::size_t {
        if (data.size() < 4 * index + 4) refuse(file, ": its compressed heights end early; export it again");
        return little_endian<std::uint32_t>(data, 4 * index);
    };
    std::string heights(size, '\0');
    const std::size_t streams = word(0);
    std::size_t done = 0, at = 4 + 8 * streams;
    for (std::size_t k = 0; k < streams; ++k) {
        const std::size_t raw = word(1 + 2 * k), packed = word(2 + 2 * k);
        uLongf length = raw;
        if (raw > size - done || packed > data.size() - std::min(at, data.size()) ||
            uncompress(reinterpret_cast<Bytef*>(heights.data() + done), &length,
                       reinterpret_cast<const Bytef*>(data.data() + at), packed) != Z_OK ||
            length != raw)
            refuse(file, ": its compressed heights are damaged; export it again");
        done += raw, at += packed;
    }
    if (done != size) refuse(file, ": ends early, with ", done, " of ", size, " bytes of heights; export it again");
    return heights;
}

/// Digital Surf's SUR and PRO: 512 bytes of header, a comment, a private zone, integers. Colours may follow
/// the heights (type 16).
HeightMap digital_surf(const std::string& bytes, const std::string& file) {
    constexpr std::size_t header = 512;
    expect_header(bytes, header, file);
    const auto half = [&](std::size_t at) { return little_endian<std::int16_t>(bytes, at); };
    const auto whole = [&](std::size_t at) { return little_endian<std::int32_t>(bytes, at); };
    if (half(12) != 0)
        refuse(file, ": a Digital Surf file of format ", half(12), "; save it in format 0, lowest byte first");
    if (half(18) != 1 && half(18) != 2 && half(18) != 16)
        refuse(file, ": a Digital Surf object of type ", half(18), "; save a profile (1) or a surface (2)");
    if (half(98) != 16 && half(98) != 32)
        refuse(file, ": heights of ", half(98), " bits; save them with 16 or 32 bits");
    HeightMap map{half(18) == 1 ? "Digital Surf (PRO)" : "Digital Surf (SUR)"};
    const std::int64_t columns = whole(108);
    map.rows = whole(112);
    map.spacing = decimal(little_endian<float>(bytes, 120)) * unit_field(bytes, 180, file).in_mm;
    map.height_factor = decimal(little_endian<float>(bytes, 128));
    map.height_unit = unit_field(bytes, 212, file);
    expect_spacing(map.spacing, "spacing", file);
    expect_spacing(map.height_factor, "height step", file);
    if (map.rows > 1) {
        map.row_spacing = decimal(little_endian<float>(bytes, 124)) * unit_field(bytes, 196, file).in_mm;
        expect_spacing(map.row_spacing, "spacing of rows", file);
    }
    const double missing = half(86) != 0 ? whole(100) - 2. : missing_height; // two below the lowest height
    const std::size_t data =
        header + little_endian<std::uint16_t>(bytes, 334) + little_endian<std::uint16_t>(bytes, 336);
    const int type = half(98) == 16 ? 5 : 6;
    if (!bytes.starts_with("DSCOMPRESSED")) {
        take_heights(map, bytes, data, columns, type, missing, file);
        return map;
    }
    expect_points(columns, map.rows, file);
    const auto size = static_cast<std::size_t>(columns * map.rows) * (type == 5 ? 2 : 4);
    if (size > 2000 * bytes.size()) // zlib packs to a thousandth at most
        refuse(file, ": ends early, before ", size, " bytes of heights; export it again");
    const std::string heights = uncompressed(std::string_view(bytes).substr(std::min(data, bytes.size())), size, file);
    take_heights(map, heights, 0, columns, type, missing, file);
    return map;
}

/// Gwyddion's simple field: lines "key = value", one to four zero bytes up to a multiple of four, floats.
HeightMap simple_field(const std::string& bytes, const std::string& file) {
    const std::size_t end = bytes.find('\0');
    if (end == std::string::npos || end > 1'000'000)
        refuse(file, ": a Gwyddion simple field whose header has no end; export it again");
    HeightMap map{.format = "Gwyddion simple field", .height_unit = {"m", 1e3}};
    double columns = 0, rows = 0, width = 1, height = 1, unit = 1e3; // without sizes 1 m, as in Gwyddion
    const std::pair<std::string_view, double*> numbers[] = {
        {"xres", &columns}, {"yres", &rows}, {"xreal", &width}, {"yreal", &height}};
    std::string_view rest(bytes.data(), end);
    while (!rest.empty()) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        const std::size_t mark = line.find('=');
        if (mark == std::string_view::npos) continue;
        const std::string key = lower(trim(line.substr(0, mark)));
        const std::string_view value = trim(line.substr(mark + 1));
        for (const auto& [name, target] : numbers)
            if (key == name) {
                const auto read = number(value, Dialect{});
                if (!read || !(read->value > 0))
                    refuse(file, ": ", key, " '", value.substr(0, 60), "' is not a number above 0; export it again");
                *target = read->value;
            }
        if (key == "xyunits")
            unit = length_unit_named(value, file).in_mm;
        else if (key == "zunits")
            map.height_unit = length_unit_named(value, file);
    }
    constexpr double max_points = 1e9;
    if (!(columns >= 1 && rows >= 1 && columns < max_points && rows < max_points) || columns != std::floor(columns) ||
        rows != std::floor(rows))
        refuse(file, ": ", columns, " x ", rows, " points; set XRes and YRes to whole numbers from 1");
    map.rows = static_cast<Index>(rows);
    map.spacing = width / columns * unit;
    map.row_spacing = height / rows * unit;
    take_heights(map, bytes, end + 4 - end % 4, static_cast<std::int64_t>(columns), 3, missing_height, file);
    return map;
}

/// The first bytes of a format, and its reader.
struct Format {
    std::string_view begins;
    HeightMap (*read)(const std::string& bytes, const std::string& file);
};
const Format formats[] = {{"bISO-", surface_data_file},
                          {"bBCR-", surface_data_file},
                          {"DIGITAL SURF", digital_surf},
                          {"DSCOMPRESSED", digital_surf},
                          {"Gwyddion Simple Field 1.", simple_field},
                          {"GWYP", read_gwy}};

/// The greatest step of which all heights are multiples, up to rounding; 0 if a small one would be needed.
double quantum(const Eigen::VectorXd& heights) {
    const double largest = heights.cwiseAbs().maxCoeff(), rounding = 1e-9 * largest;
    double step = 0;
    for (double rest : heights)
        for (rest = std::abs(rest); rest > rounding;) { // Euclid's algorithm
            if (step == 0 || rest < step) std::swap(rest, step);
            if (step > 0 && step < 1e3 * rounding) return 0;
            rest = std::abs(std::remainder(rest, step));
        }
    return step;
}

} // namespace

void expect_points(std::int64_t columns, std::int64_t rows, const std::string& file) {
    const std::int64_t max_points = rows == 1 ? 10'000'000 : 20'000'000;
    if (columns < 1 || rows < 1 || columns > max_points / rows)
        refuse(file, ": ", rows, " rows of ", columns, " heights; give 1 to ", max_points, " heights in all");
}

double missing_mark(int type) { return type < 0 || type > 7 ? missing_height : number_types[type].missing; }

Eigen::VectorXd stored_numbers(std::string_view bytes, std::int64_t count, int type, double missing,
                               const std::string& file) {
    if (type < 0 || type > 7) refuse(file, ": numbers of type ", type, "; use a type from 0 to 7");
    const NumberType& of = number_types[type];
    if (static_cast<std::int64_t>(bytes.size()) < of.size * count)
        refuse(file, ": ends early, with ", bytes.size(), " of ", of.size * count,
               " bytes of heights; export it again");
    Eigen::VectorXd numbers(count);
    for (Index i = 0; i < count; ++i) {
        const double number = of.load(bytes, static_cast<std::size_t>(of.size * i));
        // The largest float marks missing values, too.
        const bool measured = number != missing && std::abs(number) < std::numeric_limits<float>::max();
        numbers[i] = measured ? number : missing_height;
    }
    return numbers;
}

bool is_binary_map(std::string_view head) {
    return std::any_of(std::begin(formats), std::end(formats),
                       [&](const Format& format) { return head.starts_with(format.begins); });
}

std::optional<HeightMap> binary_map(const std::string& bytes, const std::string& file) {
    for (const Format& format : formats)
        if (bytes.starts_with(format.begins)) return format.read(bytes, file);
    return std::nullopt;
}

std::string sur(const Profile& surface) {
    constexpr double most = 1 << 30; // in steps of the heights
    const auto [columns, rows] = surface.shape();
    if (surface.nodes() > std::numeric_limits<std::int32_t>::max())
        refuse("sur: ", surface.nodes(), " heights are too many for the format; give fewer nodes");
    // A step of which all heights are multiples gives them back exactly.
    const Eigen::VectorXd known = surface.heights.array().isNaN().select(0, surface.heights);
    const double largest = known.cwiseAbs().maxCoeff();
    double step = decimal(static_cast<float>(quantum(known)));
    if (!(step > 0) || largest / step > most ||
        ((known / step).array() - (known / step).array().round()).abs().maxCoeff() > 1e-6)
        step = decimal(static_cast<float>(largest > 0 ? largest / most : 1));
    for (const double size : {step, surface.spacing, surface.is_2d() ? surface.row_spacing : 1})
        if (!std::isnormal(static_cast<float>(size)))
            refuse("sur: heights up to ", largest, " mm at spacings of ", surface.spacing, " x ", surface.row_spacing,
                   " mm are beyond the format's numbers; check the unit");
    constexpr std::int32_t missing = std::numeric_limits<std::int32_t>::min();
    std::vector<std::int32_t> heights;
    for (const double height : known) heights.push_back(static_cast<std::int32_t>(std::lround(height / step)));
    const auto [least, highest] = std::ranges::minmax(heights);
    const bool has_holes = surface.heights.hasNaN();
    const std::int32_t lowest = has_holes ? missing + 2 : least; // two above the mark of a missing height
    for (std::size_t i = 0; i < heights.size(); ++i)
        if (std::isnan(surface.heights[static_cast<Index>(i)])) heights[i] = missing;

    std::string bytes = "DIGITAL SURF";
    const auto text = [&](std::string_view word, std::size_t size) {
        bytes += word;
        bytes.append(size - word.size(), ' ');
    };
    const auto halves = [&](std::initializer_list<int> numbers) {
        for (const int number : numbers) append_little_endian(bytes, static_cast<std::int16_t>(number));
    };
    const auto zeros_to = [&](std::size_t place) { bytes.resize(place, '\0'); };
    halves({0, 1, 1, surface.is_2d() ? 2 : 1}); // lowest byte first, one object, version, its type
    text("rugosa", 30);
    text("", 30);
    halves({0, 0, 1, has_holes, 1}); // material, acquisition, range, missing heights, absolute heights
    zeros_to(98);
    halves({32});
    for (const Index number : {Index(lowest), Index(highest), columns, rows, surface.nodes()})
        append_little_endian(bytes, static_cast<std::int32_t>(number));
    for (const double size : {surface.spacing, surface.row_spacing, step})
        append_little_endian(bytes, static_cast<float>(size));
    for (const char* word : {"X", "Y", "Z", "mm", "mm", "mm", "mm", "mm", "mm"}) // axes, steps, lengths
        text(word, 16);
    for (int axis = 0; axis < 3; ++axis) append_little_endian(bytes, 1.f); // ratio of the units of steps and lengths
    zeros_to(512);
    for (const std::int32_t height : heights) append_little_endian(bytes, height);
    return bytes;
}

} // namespace rough
