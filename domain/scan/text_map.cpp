#include "domain/errors.hpp"
#include "domain/scan/map.hpp"

#include <cmath>

namespace rough {
namespace {

/// The lines of a file, one after another, without blank ones and the control characters of record ends.
class Reader {
  public:
    Reader(const Lines& lines, const std::string& file) : lines_(lines), file_(file) { skip_blank(); }
    bool done() const { return at_ == lines_.size(); }
    const std::string& text() const { return text_; }
    const std::string& file() const { return file_; }
    int line() const { return static_cast<int>(at_) + 1; }
    void next() { at_ += !done(), skip_blank(); }
    /// The words of the line, at least one.
    std::vector<std::string_view> words() const {
        auto all = split(text_, Dialect::Separator::blanks);
        if (all.empty()) // a line of quotes
            all.emplace_back(text_);
        return all;
    }
    bool starts(std::string_view start) const { return !done() && text_.starts_with(start); }

    [[noreturn]] void refuse(const std::string& expected) const {
        if (done()) rough::refuse(file_, ": ends early, before ", expected, "; export it again");
        rough::refuse(at(file_, line()), ": found '", text_.substr(0, 60), "' instead of ", expected, "; correct it");
    }
    double positive(std::string_view word, const std::string& what) const {
        const auto value = number(word, Dialect{});
        if (!value || !(value->value > 0)) refuse(what + " above 0");
        return value->value;
    }
    long count(std::string_view word) const {
        constexpr double max_count = 1e9;
        const double value = positive(word, "a count");
        if (value > max_count) refuse("a count up to 1e9");
        return std::lround(value);
    }
    LengthUnit unit(std::string_view word) const {
        const auto unit = length_unit(word);
        if (!unit) refuse("a length unit");
        return *unit;
    }

  private:
    void skip_blank() {
        text_.clear();
        for (; !done(); ++at_) {
            text_ = lines_[at_];
            std::replace(text_.begin(), text_.end(), '\x1a', ' ');
            text_ = trim(text_);
            if (!text_.empty()) return;
        }
    }
    const Lines& lines_;
    const std::string& file_;
    std::size_t at_ = 0;
    std::string text_;
};

std::string_view after(std::string_view text, char mark) {
    return trim(text.substr(std::min(text.find(mark), text.size() - 1) + 1));
}

/// Reads up to `count` numbers, to a line that begins with `end` or, if it is empty, to the end of the file.
void read_heights(HeightMap& map, Reader& in, std::string_view end,
                  std::size_t count = std::numeric_limits<std::size_t>::max()) {
    std::vector<double> heights;
    for (; !in.done() && (end.empty() || !in.starts(end)) && heights.size() < count; in.next())
        for_each_cell(in.text(), Dialect::Separator::blanks, [&](std::string_view word) {
            const auto height = number(word, Dialect{});
            if (!height) in.refuse("a height");
            expect_points(static_cast<std::int64_t>(heights.size()) + 1, 2, in.file());
            heights.push_back(height->value);
            map.line.push_back(in.line());
            return true;
        });
    if (!end.empty() && in.done())
        in.refuse(end == "\x03" ? "an end of record (ETX)" : "'" + std::string(end) + "' after the heights");
    map.heights = Eigen::Map<const Eigen::VectorXd>(heights.data(), static_cast<Index>(heights.size()));
}

/// Reads notes, which state the spacing, up to a line that begins with `start`, then heights up to `end`.
template <class Note>
void read_noted(HeightMap& map, Reader& in, std::string_view start, std::string_view end, const std::string& spacing,
                Note note) {
    for (in.next(); !in.starts(start); in.next()) {
        if (in.done()) in.refuse("'" + std::string(start) + "' before the heights");
        note();
    }
    if (!(map.spacing > 0)) in.refuse(spacing + " before the heights");
    in.next();
    read_heights(map, in, end);
}

/// ISO 25178-71, ASCII: "Xscale = 5E-07" in metres, the heights between two lines of '*', then a trailer.
HeightMap surface_data_file(Reader in) {
    HeightMap map{.format = "ISO 25178-71 (SDF)", .height_unit = {"m", 1e3}};
    double missing = std::nan("");
    read_noted(map, in, "*", "*", "an Xscale", [&] {
        const std::string key = lower(trim(in.text().substr(0, in.text().find('='))));
        const std::string_view value = after(in.text(), '=');
        if (key == "xscale")
            map.spacing = in.positive(value, "a spacing") * 1e3;
        else if (key == "zscale")
            map.height_factor = in.positive(value, "a factor");
        else if (key == "numpoints")
            map.announced = in.count(value);
        else if (key == "yscale" && value != "0" && value != "0.0")
            map.row_spacing = in.positive(value, "a spacing") * 1e3;
        else if (key == "numprofiles")
            map.rows = in.count(value);
        else if (key == "datatype" && value.size() == 1)
            missing = missing_mark(value[0] - '0');
    });
    std::replace(map.heights.begin(), map.heights.end(), missing, std::nan(""));
    if (map.rows > 1 && map.heights.size() != map.rows * std::max<Index>(map.announced, 1))
        refuse(in.file(), ": ", map.heights.size(),
               " heights, but the header gives NumProfiles times NumPoints; export it again");
    map.announced = map.rows > 1 ? -1 : map.announced;
    return map;
}

/// An axis as in "CX I 8001 um 1.0e0 D 5e-4": type, count, unit, factor and number type. The last field is
/// the spacing of a CX of type I.
struct Axis {
    std::vector<std::string_view> words; ///< valid until the reader moves
    LengthUnit unit;
    double factor;
    long count;
};

Axis axis(const Reader& in, std::string_view name) {
    const auto words = in.words();
    if (words.size() < 6 || words[0] != name)
        in.refuse("the axis '" + std::string(name) + "' with type, count, unit, factor and number type");
    return {words, in.unit(words[3]), in.positive(words[4], "a factor"), in.count(words[2])};
}

/// Takes a map's heights to be as the next line, the axis CZ, states.
void read_height_axis(HeightMap& map, Reader& in) {
    in.next();
    const Axis z = axis(in, "CZ");
    map.height_unit = z.unit;
    map.height_factor = z.factor;
    map.announced = z.count;
}

/// ISO 5436-2: four records that each end with ETX: what it is and its axes, notes, the heights, a check sum.
HeightMap softgauge(Reader in) {
    in.next();
    if (!in.starts("PRF")) in.refuse("a profile (PRF)");
    in.next();
    const Axis x = axis(in, "CX");
    if (x.words[1] != "I" || x.words.size() < 7) in.refuse("an incremental axis CX (I) with its spacing");
    HeightMap map{"ISO 5436-2 (SMD)"};
    map.spacing = in.positive(x.words[6], "a spacing") * x.factor * x.unit.in_mm;
    read_height_axis(map, in);
    for (int record = 1; record <= 2; ++record) {
        while (!in.done() && !in.starts("\x03")) in.next();
        if (in.done()) in.refuse("records that end with ETX");
        in.next();
    }
    read_heights(map, in, "\x03");
    return map;
}

/// Talysurf's PRF: axes, EOR, "SPACING CX 2.5e-4" in the unit of CX and other notes, EOR, heights, EOR.
HeightMap talysurf(Reader in) {
    in.next(), in.next();
    const Axis x = axis(in, "CX");
    HeightMap map{"Talysurf PRF"};
    read_height_axis(map, in);
    in.next();
    if (!in.starts("EOR")) in.refuse("EOR");
    read_noted(map, in, "EOR", "EOR", "a line 'SPACING CX'", [&] {
        const auto words = in.words();
        if (words.size() > 2 && words[0] == "SPACING" && words[1] == "CX")
            map.spacing = in.positive(words[2], "a spacing") * (x.factor * x.unit.in_mm);
    });
    return map;
}

/// PTB's PR: "X-len = 4000 X-resolution 2000 points/scanline: 8001", the resolution in points per mm, then
/// heights in µm; German words in older files.
bool is_ptb_axis(std::string_view text) {
    const std::string line = lower(text);
    return (line.find("x-resolution") != line.npos && line.find("points/scanline") != line.npos) ||
           (line.find("x-aufl") != line.npos && line.find("punkte/zeile") != line.npos);
}

HeightMap ptb(Reader in) {
    in.next();
    const auto words = in.words();
    const auto name = std::find_if(words.begin(), words.end(), [](auto word) {
        return lower(word).starts_with("x-resolution") || lower(word).starts_with("x-aufl");
    });
    if (words.end() - name < 2) in.refuse("a resolution");
    HeightMap map{.format = "PTB's PR", .height_unit = {"µm", 1e-3}};
    map.spacing = 1 / in.positive(name[1], "a resolution");
    map.announced = in.count(words.back());
    in.next();
    read_heights(map, in, "");
    return map;
}

/// SigmaSurf: "SPACING_UM: 0.25", other keys, "PROFILE_UM:", heights.
HeightMap sigma_surf(Reader in) {
    HeightMap map{.format = "SigmaSurf", .height_unit = {"µm", 1e-3}};
    read_noted(map, in, "PROFILE_UM", "", "SPACING_UM", [&] {
        if (in.starts("SPACING_UM"))
            map.spacing = in.positive(after(in.text(), ':'), "a spacing") * 1e-3;
        else if (in.starts("NUMBER_OF_POINTS"))
            map.announced = in.count(after(in.text(), ':'));
    });
    return map;
}

/// Wyko's and Vision's ASC: "X Size<tab>640", names with type, length and value, "RAW_DATA". Then follows a
/// line along y for each x, in nm or in wavelengths. Other blocks may follow.
HeightMap wyko(Reader in) {
    HeightMap map{.format = "Wyko (ASC)", .height_unit = {"nm", 1e-6}};
    const auto flags = in.words();
    const bool in_nm = flags.size() > 2 && flags[flags.size() - 2] != "0";
    long columns = 0;
    double wavelength = 0, multiplier = 1, aspect = 1;
    for (in.next(); !in.starts("RAW_DATA"); in.next()) {
        const auto words = in.words();
        if (in.done()) in.refuse("RAW_DATA before the heights");
        const std::string key = lower(words[0]);
        const std::string_view value = words.back();
        if (words.size() > 2 && lower(words[1]) == "size" && (key == "x" || key == "y"))
            (key == "x" ? columns : map.rows) = in.count(value);
        else if (key == "pixel_size")
            map.row_spacing = in.positive(value, "a spacing");
        else if (key == "aspect")
            aspect = in.positive(value, "a ratio");
        else if (key == "wavelength")
            wavelength = in.positive(value, "a wavelength");
        else if (key == "mult")
            multiplier = in.positive(value, "a factor");
    }
    expect_points(columns, map.rows, in.file());
    if (!(map.row_spacing > 0) || !(in_nm || wavelength > 0)) in.refuse("Pixel_size and Wavelength before the heights");
    map.spacing = map.row_spacing * aspect;
    map.height_factor = in_nm ? 1 : wavelength / multiplier;
    in.next();
    const Index all = columns * map.rows;
    read_heights(map, in, "", static_cast<std::size_t>(all));
    if (map.heights.size() != all) in.refuse(line_of(all, " heights"));
    map.heights = map.heights.reshaped(map.rows, columns).transpose().reshaped().eval();
    map.line.clear(); // they are in another order
    return map;
}

/// Zygo's XYZ: line 4 has the size of the phase map, line 8 the camera's resolution in m as its seventh
/// number. Between two lines '#' are a column, a row and a height in µm or "No Data".
HeightMap zygo(const Lines& lines, const std::string& file) {
    HeightMap map{.format = "Zygo XYZ", .height_unit = {"µm", 1e-3}};
    Reader in(lines, file);
    const auto numbers_of = [&](std::size_t line, std::size_t count) {
        std::vector<double> numbers;
        for (const std::string_view word : split(line < lines.size() ? lines[line] : "", Dialect().separator))
            if (const auto value = number(word, Dialect{})) numbers.push_back(value->value);
        if (numbers.size() < count)
            refuse(at(file, static_cast<int>(line + 1)), ": fewer than ", count,
                   " numbers in the header of a Zygo XYZ file; export it again");
        return numbers;
    };
    const auto size = numbers_of(3, 4), camera = numbers_of(7, 7);
    expect_points(std::llround(size[2]), std::llround(size[3]), file);
    const Index columns = std::lround(size[2]);
    map.rows = std::lround(size[3]);
    map.spacing = map.row_spacing = 1e3 * camera[6];
    if (!(map.spacing > 0))
        refuse(at(file, 8), ": no lateral calibration; calibrate the instrument, or export a matrix");
    map.heights = Eigen::VectorXd::Constant(columns * map.rows, std::nan(""));
    while (!in.done() && !in.starts("#")) in.next();
    for (in.next(); !in.done() && !in.starts("#"); in.next()) {
        const auto words = in.words();
        const bool no_data = in.text().ends_with("No Data");
        const auto x = number(words[0], Dialect{}), y = words.size() > 2 ? number(words[1], Dialect{}) : x,
                   z = no_data ? Number{std::nan(""), 0} : number(words.back(), Dialect{});
        const Index i = x ? std::lround(x->value - size[0]) : -1, j = y ? std::lround(y->value - size[1]) : -1;
        if (words.size() < 3 || !z || i < 0 || i >= columns || j < 0 || j >= map.rows)
            in.refuse("a column, a row and a height");
        map.heights[j * columns + i] = z->value;
    }
    return map;
}

} // namespace

std::optional<HeightMap> text_map(const Lines& lines, const std::string& file) {
    const Reader in(lines, file);
    if (in.starts("ISO 5436")) return softgauge(in);
    if (in.starts("SigmaSurf_Data")) return sigma_surf(in);
    if (in.starts("Wyko ASCII")) return wyko(in);
    if (in.starts("Zygo XYZ")) return zygo(lines, file);
    for (std::size_t i = 0; in.starts("a") && i < std::min<std::size_t>(lines.size(), 30); ++i)
        if (lower(trim(lines[i])).starts_with("xscale")) return surface_data_file(in);
    Reader second = in;
    second.next();
    if (is_ptb_axis(second.text())) return ptb(in);
    Reader third = second;
    third.next();
    const auto words = second.words();
    if (!words.empty() && words.back() == "PRF" && third.starts("CX")) return talysurf(in);
    return std::nullopt;
}

} // namespace rough
