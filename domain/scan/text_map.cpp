#include "domain/errors.hpp"
#include "domain/scan/height_map.hpp"
#include "domain/text/lines.hpp"
#include "domain/text/words.hpp"

#include <algorithm>
#include <cmath>

namespace rough {
namespace {

/// The lines of a file, one after another; blank ones and the control characters of record ends are skipped.
class Reader {
  public:
    Reader(const std::vector<std::string_view>& lines, const std::string& file) : lines_(lines), file_(file) {
        skip_blank();
    }
    bool done() const { return at_ == lines_.size(); }
    const std::string& text() const { return text_; }
    const std::string& file() const { return file_; }
    int line() const { return static_cast<int>(at_) + 1; }
    void next() { at_ += !done(), skip_blank(); }
    std::vector<std::string_view> words() const { return split(text_, Dialect::Separator::blanks); }
    bool starts(std::string_view start) const { return !done() && text_.starts_with(start); }

    [[noreturn]] void refuse(const std::string& expected) const {
        if (done())
            throw InputError(file_ + ": ends early, expected " + expected);
        throw InputError(at(file_, line()) + ": '" + text_.substr(0, 60) + "', expected " + expected);
    }
    double positive(std::string_view word, const std::string& what) const {
        const auto value = number(word, Dialect{});
        if (!value || !(value->value > 0))
            refuse(what + " above 0");
        return value->value;
    }
    long count(std::string_view word) const {
        constexpr double max_count = 1e9;
        const double value = positive(word, "a count");
        if (value > max_count)
            refuse("a count up to 1e9");
        return std::lround(value);
    }
    LengthUnit unit(std::string_view word) const {
        const auto unit = length_unit(word);
        if (!unit)
            refuse("a length unit");
        return *unit;
    }

  private:
    void skip_blank() {
        text_.clear();
        for (; !done(); ++at_) {
            text_ = lines_[at_];
            std::replace_if(
                text_.begin(), text_.end(), [](char c) { return c == '\x1a' || c == '\0'; }, ' ');
            text_ = trim(text_);
            if (!text_.empty())
                return;
        }
    }
    const std::vector<std::string_view>& lines_;
    const std::string& file_;
    std::size_t at_ = 0;
    std::string text_;
};

std::string_view after(std::string_view text, char mark) {
    return trim(text.substr(std::min(text.find(mark), text.size() - 1) + 1));
}

/// Numbers until a line that begins with `end`.
void read_heights(HeightMap& profile, Reader& in, std::string_view end) {
    std::vector<double> heights;
    for (; !in.done() && !(in.starts(end) && !end.empty()); in.next())
        for_each_cell(in.text(), Dialect::Separator::blanks, [&](std::string_view word) {
            const auto height = number(word, Dialect{});
            if (!height)
                in.refuse("a height");
            expect_points(static_cast<std::int64_t>(heights.size()) + 1, 2, in.file());
            heights.push_back(height->value);
            profile.line.push_back(in.line());
            return true;
        });
    if (!end.empty() && in.done())
        in.refuse(end == "\x03" ? "an end of record (ETX)" : "'" + std::string(end) + "' after the heights");
    profile.heights = Eigen::Map<const Eigen::VectorXd>(heights.data(), static_cast<Index>(heights.size()));
}

/// Notes up to a line that begins with `start`, which give the spacing, then the heights up to `end`.
template <class Note>
void read_noted(HeightMap& profile, Reader& in, std::string_view start, std::string_view end,
                const std::string& spacing, Note note) {
    for (in.next(); !in.starts(start); in.next()) {
        if (in.done())
            in.refuse("'" + std::string(start) + "' before the heights");
        note();
    }
    if (!(profile.spacing > 0))
        in.refuse(spacing + " before the heights");
    in.next();
    read_heights(profile, in, end);
}

/// ISO 25178-71, ASCII: "Xscale = 5E-07" in metres, the heights between two lines of '*', a trailer behind.
HeightMap surface_data_file(Reader in, const std::string& file) {
    HeightMap profile{"ISO 25178-71 (SDF)"};
    profile.height_unit = {"m", 1e3};
    double missing = std::nan("");
    read_noted(profile, in, "*", "*", "an Xscale", [&] {
        const std::string key = lower(trim(in.text().substr(0, in.text().find('='))));
        const std::string_view value = after(in.text(), '=');
        if (key == "xscale")
            profile.spacing = in.positive(value, "a spacing") * 1e3;
        else if (key == "zscale")
            profile.height_factor = in.positive(value, "a factor");
        else if (key == "numpoints")
            profile.announced = in.count(value);
        else if (key == "yscale" && value != "0" && value != "0.0")
            profile.row_spacing = in.positive(value, "a spacing") * 1e3;
        else if (key == "numprofiles")
            profile.rows = in.count(value);
        else if (key == "datatype" && value.size() == 1)
            missing = missing_mark(value[0] - '0');
    });
    std::replace(profile.heights.begin(), profile.heights.end(), missing, std::nan(""));
    if (profile.rows > 1 && profile.heights.size() != profile.rows * std::max<Index>(profile.announced, 1))
        throw InputError(file + ": " + std::to_string(profile.heights.size()) +
                         " heights, expected NumProfiles times NumPoints");
    profile.announced = profile.rows > 1 ? -1 : profile.announced;
    return profile;
}

/// "CZ A 8001 um 1.0e0 D": type, count, unit, factor and number type of an axis, the last field of a CX of
/// type I its spacing.
struct Axis {
    std::vector<std::string_view> words;
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

/// ISO 5436-2: four records that each end with ETX: what it is and its axes, notes, the heights, a check sum.
HeightMap softgauge(Reader in) {
    in.next();
    if (!in.starts("PRF"))
        in.refuse("a profile (PRF)");
    in.next();
    const Axis x = axis(in, "CX");
    if (x.words[1] != "I" || x.words.size() < 7)
        in.refuse("an incremental axis CX (I) with its spacing");
    HeightMap profile{"ISO 5436-2 (SMD)"};
    profile.spacing = in.positive(x.words[6], "a spacing") * x.factor * x.unit.in_mm;
    in.next();
    const Axis z = axis(in, "CZ");
    profile.height_unit = z.unit, profile.height_factor = z.factor;
    profile.announced = z.count;
    for (int record = 1; record <= 2; ++record) {
        while (!in.done() && !in.starts("\x03"))
            in.next();
        if (in.done())
            in.refuse("records that end with ETX");
        in.next();
    }
    read_heights(profile, in, "\x03");
    return profile;
}

/// Talysurf's PRF: axes, EOR, "SPACING CX 2.5e-4" in the unit of CX and other notes, EOR, heights, EOR.
HeightMap talysurf(Reader in) {
    in.next(), in.next();
    const Axis x = axis(in, "CX");
    HeightMap profile{"Talysurf PRF"};
    const double x_unit = x.factor * x.unit.in_mm;
    in.next();
    const Axis z = axis(in, "CZ");
    profile.height_unit = z.unit, profile.height_factor = z.factor;
    profile.announced = z.count;
    in.next();
    if (!in.starts("EOR"))
        in.refuse("EOR");
    read_noted(profile, in, "EOR", "EOR", "a line 'SPACING CX'", [&] {
        const auto words = in.words();
        if (words.size() > 2 && words[0] == "SPACING" && words[1] == "CX")
            profile.spacing = in.positive(words[2], "a spacing") * x_unit;
    });
    return profile;
}

/// PTB's PR: "X-len = 4000 X-resolution 2000 points/scanline: 8001", the resolution in points a mm, then
/// heights in µm; in German in older files.
bool ptb_axis(std::string_view text) {
    const std::string line = lower(text);
    return (line.find("x-resolution") != line.npos && line.find("points/scanline") != line.npos) ||
           (line.find("x-aufl") != line.npos && line.find("punkte/zeile") != line.npos);
}

HeightMap ptb(Reader in) {
    in.next();
    const auto words = in.words();
    const auto name = std::find_if(words.begin(), words.end(), [](auto word) {
        const std::string small = lower(word);
        return small.starts_with("x-resolution") || small.starts_with("x-aufl");
    });
    if (words.end() - name < 2)
        in.refuse("a resolution");
    HeightMap profile{"PTB's PR"};
    profile.height_unit = {"µm", 1e-3};
    profile.spacing = 1 / in.positive(name[1], "a resolution");
    profile.announced = in.count(words.back());
    in.next();
    read_heights(profile, in, "");
    return profile;
}

/// SigmaSurf: "SPACING_UM: 0.25", other keys, "PROFILE_UM:", heights.
HeightMap sigma_surf(Reader in) {
    HeightMap profile{"SigmaSurf"};
    profile.height_unit = {"µm", 1e-3};
    read_noted(profile, in, "PROFILE_UM", "", "SPACING_UM", [&] {
        if (in.starts("SPACING_UM"))
            profile.spacing = in.positive(after(in.text(), ':'), "a spacing") * 1e-3;
        else if (in.starts("NUMBER_OF_POINTS"))
            profile.announced = in.count(after(in.text(), ':'));
    });
    return profile;
}

} // namespace

std::optional<HeightMap> text_map(const std::vector<std::string_view>& lines, const std::string& file) {
    const Reader in(lines, file);
    if (in.done())
        return std::nullopt;
    if (in.starts("ISO 5436"))
        return softgauge(in);
    if (in.starts("SigmaSurf_Data"))
        return sigma_surf(in);
    const auto is_x_scale = [](std::string_view line) { return lower(trim(line)).starts_with("xscale"); };
    const std::size_t head = std::min<std::size_t>(lines.size(), 30);
    if (in.starts("a") && std::any_of(lines.begin(), lines.begin() + static_cast<long>(head), is_x_scale))
        return surface_data_file(in, file);
    Reader second = in;
    second.next();
    if (!second.done() && ptb_axis(second.text()))
        return ptb(in);
    Reader third = second;
    if (!third.done())
        third.next();
    const auto words = second.words();
    if (!words.empty() && words.back() == "PRF" && third.starts("CX"))
        return talysurf(in);
    return std::nullopt;
}

} // namespace rough
