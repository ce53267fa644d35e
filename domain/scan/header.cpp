#include "domain/scan/header.hpp"

#include "domain/errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rough {
namespace {

/// A key and its value: "key: value", "key = value", "key;value", "key<tab>value", "key,value".
struct Entry {
    std::string key; ///< lower case, without brackets, blanks, quotes, '-', '_' and '.'
    std::string_view value;
    std::optional<LengthUnit> unit; ///< in brackets after the key, "dx (um)"
};

std::optional<Entry> entry(std::string_view line) {
    for (const char mark : std::string_view("=:;\t,")) {
        const std::size_t place = line.find(mark);
        if (place == std::string_view::npos || trim(line.substr(0, place)).empty()) continue;
        Entry read{lower(trim(line.substr(0, place))), line.substr(place + 1), {}};
        if (const std::size_t open = read.key.find_first_of("[("), close = read.key.find_last_of("])");
            open != std::string::npos && close != std::string::npos && open < close && open > 0)
            if (read.unit = length_unit(read.key.substr(open + 1, close - open - 1)); read.unit) read.key.resize(open);
        std::erase_if(read.key, [](char c) { return std::string_view(" \t-_.\"").find(c) != std::string_view::npos; });
        read.value = read.value.substr(0, read.value.find_last_not_of(" \t;,\"") + 1);
        read.value = read.value.substr(std::min(read.value.find_first_not_of(" \t\""), read.value.size()));
        return read;
    }
    return std::nullopt;
}

/// A member of Header, and the keys that state it, as Entry::key. They are those of Gwyddion (also in German,
/// French, Italian and Spanish), SPIP, Nova, Keyence, Wyko, Dektak and their like.
template <class Value>
struct Keys {
    Value Header::*member;
    std::string_view names;
};

constexpr std::array<Keys<std::optional<LengthUnit>>, 3> unit_keys{{
    {&Header::x_unit,
     " unit units lengthunit lengthunits einheit xunit xunits unitx xaxisunit xyunit xyunits unitxy "
     "lateralunit lateralunits unitlateral horizontalunit horizontalunits positionunit positionunits "},
    {&Header::y_unit, " yunit yunits unity yaxisunit "},
    {&Header::height_unit,
     " unit units lengthunit lengthunits einheit zunit zunits unitz zaxisunit heightunit heightunits "
     "unitheight valueunit valueunits dataunit dataunits unitdata verticalunit verticalunits einheiten "
     "unités unitàvalore unidadesdevalor "},
}};
constexpr std::array<Keys<std::optional<HeaderLength>>, 4> length_keys{{
    {&Header::spacing,
     " spacing samplespacing pointspacing xspacing spacingx step stepsize xstep stepx xstepsize dx deltax "
     "pixelsize pixelsizex xpixelsize pixelspacing increment xincrement pitch xpitch pitchx samplingpitch "
     "samplinginterval sampleinterval samplingstep pointdistance sampledistance xscale scalex xycalibration "
     "xcalibration lateralresolution "},
    {&Header::row_spacing,
     " yspacing spacingy rowspacing linespacing ystep stepy ystepsize dy deltay pixelsizey ypixelsize "
     "yincrement ypitch pitchy yscale scaley ycalibration linedistance "},
    {&Header::width, " width xlength xrange xreal xsize scanwidth breite largeur larghezza anchura "},
    {&Header::height, " height ylength yrange yreal ysize scanheight höhe hauteur altezza altura "},
}};
constexpr std::array<Keys<long>, 2> count_keys{{
    {&Header::columns, " xpixels columns cols ncols nx xres xsize horizontal pointsperline "},
    {&Header::rows, " ypixels rows lines nrows ny yres ysize vertical "},
}};

/// Whether a key states a unit.
bool is_unit_key(std::string_view key) {
    return std::ranges::any_of(unit_keys, [&](const auto& known) { return is_in(known.names, key); });
}

/// The content of a text in brackets, else the text.
std::string_view without_brackets(std::string_view text) {
    const bool brackets = text.size() > 2 && (text.front() == '[' || text.front() == '(');
    return brackets ? text.substr(1, text.size() - 2) : text;
}

/// "0.5 um", "0,5 µm", "0.156 um/sample", "138","nm". The last cell of "7<tab>4<tab>0.0005", where Wyko's
/// type and length of the number precede it.
std::optional<HeaderLength> length_of(const Entry& entry) {
    std::string_view value = entry.value;
    if (std::ranges::count(value, '\t') > 1) value = trim(value.substr(value.rfind('\t')));
    const std::size_t end = std::min(value.find_first_not_of("+-0123456789.,eE"), value.size());
    std::string_view digits = trim(value.substr(0, end));
    digits = digits.substr(0, digits.find_last_not_of(',') + 1);
    const bool comma = digits.find(',') != std::string_view::npos;
    const auto size = number(digits, Dialect{Dialect::Separator::blanks, comma});
    if (!size || !(size->value > 0)) return std::nullopt;
    std::string_view unit = value.substr(end);
    unit = unit.substr(std::min(unit.find_first_not_of(" \t;,\""), unit.size()));
    const auto named = length_unit(without_brackets(trim(unit.substr(0, unit.find('/')))));
    return HeaderLength{size->value, named ? named : entry.unit, std::pow(10., size->last_place) / 2 / size->value};
}

/// The unit in mm of "heightconversionfactor(->m)"; 0 for another key.
double conversion_unit(const std::string& key, const std::string& where) {
    const std::size_t word = key.find('>') + 1, end = key.find(')');
    if (!key.starts_with("heightconversionfactor(") || word == 0 || end == std::string::npos || end < word) return 0;
    return length_unit_named(std::string_view(key).substr(word, end - word), where).in_mm;
}

void take(Header& header, const Entry& entry, const std::string& where) {
    if (const double in_mm = conversion_unit(entry.key, where); in_mm > 0) {
        const auto factor = number(entry.value, Dialect{});
        if (!factor || !(factor->value > 0))
            refuse(where, ": ", entry.key, " '", entry.value, "' is not a number above 0; correct it");
        header.height_factor = factor->value;
        header.height_unit = LengthUnit{"m", in_mm};
        return;
    }
    if (is_unit_key(entry.key)) {
        const auto units = length_units_in(entry.value, where);
        if (units.empty()) refuse(where, ": '", entry.value, "' has no length unit; write one, as in 'unit: um'");
        for (const auto& [member, names] : unit_keys)
            if (is_in(names, entry.key)) header.*member = member == &Header::height_unit ? units.back() : units.front();
        return;
    }
    const auto length = length_of(entry);
    const bool per_sample = entry.key == "resolution" && entry.value.find("/sample") != std::string_view::npos;
    const std::string_view key = per_sample ? "spacing" : std::string_view(entry.key);
    const bool is_count = is_in(" xsize ysize ", key) && !(length && length->unit); // else a length
    for (const auto& [member, names] : length_keys)
        if (is_in(names, key) && !is_count) {
            header.*member = length;
            return;
        }
    for (const auto& [member, names] : count_keys)
        if (is_in(names, key) && length && length->value == std::floor(length->value) && length->value < 1e9)
            header.*member = std::lround(length->value);
}

/// Whether a line contains numbers, so that it is not a line of column names.
bool holds_number(std::string_view line) {
    for (const auto separator : {Dialect::Separator::blanks, Dialect::Separator::semicolon, Dialect::Separator::comma})
        for (std::string_view cell : split(line, separator))
            if (const auto value = number(cell, Dialect{}); value && !std::isnan(value->value)) return true;
    return false;
}

/// The names in a line of column names; empty if no separator gives one name per column.
std::vector<std::string> column_names(std::string_view line, const Dialect& dialect, std::size_t columns) {
    using enum Dialect::Separator;
    for (const auto separator : {dialect.separator, semicolon, tab, comma})
        if (const auto cells = split(line, separator); separator != blanks && cells.size() == columns)
            return {cells.begin(), cells.end()};
    std::vector<std::string> words; // a bracketed unit belongs to the word before it
    for (std::string_view word : split(line, blanks))
        if ((word.starts_with('[') || word.starts_with('(')) && !words.empty() &&
            words.back().find_first_of("[(") == std::string::npos)
            words.back() += " " + std::string(word);
        else
            words.emplace_back(word);
    return words.size() == columns ? words : std::vector<std::string>{};
}

/// The units in a line of column names, one per column.
std::vector<std::optional<LengthUnit>> column_units(std::string_view line, const std::vector<std::string>& names,
                                                    std::size_t columns, const std::string& where) {
    std::vector<std::optional<LengthUnit>> units(columns, length_unit(without_brackets(trim(line))));
    if (units.front()) // one for all
        return units;
    for (std::size_t c = 0; c < names.size(); ++c)
        if (const auto found = length_units_in(names[c], where); !found.empty()) units[c] = found.back();
    if (names.empty())
        if (const auto found = length_units_in(line, where); found.size() >= columns)
            std::copy_n(found.begin(), columns, units.begin());
    return units;
}

} // namespace

Header read_header(const Table& table, const std::string& file) {
    const std::vector<TextLine>& lines = table.header;
    const std::size_t columns = table.columns <= 3 ? table.columns : 1; // one unit for a matrix
    Header header;
    header.units.resize(columns);
    header.unknown_units.resize(columns);
    header.names.resize(columns);
    for (const TextLine& line : lines)
        if (const auto read = entry(line.text)) take(header, *read, at(file, line.number));
    // The names are right above the table, their units with them or in a line below.
    for (auto line = lines.rbegin(); line != lines.rend() && line - lines.rbegin() < 3; ++line) {
        const auto read = entry(line->text);
        if (holds_number(line->text) || (read && is_unit_key(read->key))) break;
        const auto names = column_names(line->text, table.dialect, columns);
        const auto units = column_units(line->text, names, columns, at(file, line->number));
        for (std::size_t c = 0; c < columns; ++c) {
            if (!header.units[c]) header.units[c] = units[c];
            if (!names.empty() && header.unknown_units[c].empty()) header.unknown_units[c] = unknown_unit_in(names[c]);
            if (!names.empty() && header.names[c].empty()) header.names[c] = lower(names[c]);
        }
        header.validity_column |= !names.empty() && lower(names.back()).starts_with("valid");
    }
    return header;
}

bool names_spacing(std::string_view line) {
    const auto read = entry(line);
    const auto is_stated = [&](const Keys<std::optional<HeaderLength>>& known) {
        return (known.member == &Header::spacing || known.member == &Header::width) && is_in(known.names, read->key);
    };
    return read && std::ranges::any_of(length_keys, is_stated) && length_of(*read);
}

} // namespace rough
