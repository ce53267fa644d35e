#include "domain/scan/header.hpp"

#include "domain/errors.hpp"
#include "domain/text/lines.hpp"

#include <algorithm>
#include <cmath>

namespace rough {
namespace {

struct Entry {
    std::string key; ///< lower case, without blanks, '-', '_' and '.'
    std::string_view value;
};

/// "key: value", "key = value", "key;value", "key<tab>value", "key,value".
std::optional<Entry> entry(std::string_view line) {
    for (const char mark : std::string_view("=:;\t,")) {
        const std::size_t place = line.find(mark);
        if (place == std::string_view::npos || trim(line.substr(0, place)).empty())
            continue;
        std::string key = lower(trim(line.substr(0, place)));
        std::erase_if(key,
                      [](char c) { return std::string_view(" \t-_.\"").find(c) != std::string_view::npos; });
        std::string_view value = line.substr(place + 1);
        value = value.substr(0, value.find_last_not_of(" \t;,\"") + 1);
        value = value.substr(std::min(value.find_first_not_of(" \t\""), value.size()));
        return Entry{std::move(key), value};
    }
    return std::nullopt;
}

constexpr std::string_view unit_keys = " unit units lengthunit lengthunits einheit ";
constexpr std::string_view spacing_keys =
    " spacing samplespacing pointspacing xspacing step stepsize xstep dx deltax pixelsize increment "
    "xincrement "
    "pitch samplingpitch samplinginterval sampleinterval pointdistance sampledistance xscale ";
constexpr std::string_view width_keys = " width xlength breite ";

/// Which columns a key like "x-unit", "Height units" or "Unit" speaks of.
enum class UnitOf { nothing, all, x, height };
UnitOf unit_key(const std::string& key) {
    if (is_in(unit_keys, key))
        return UnitOf::all;
    const auto names = [&](std::initializer_list<std::string_view> parts) {
        return std::any_of(parts.begin(), parts.end(),
                           [&](auto part) { return key.find(part) != std::string::npos; });
    };
    std::string rest = key;
    const std::size_t place = rest.find("unit");
    if (place == std::string::npos)
        return UnitOf::nothing;
    rest.erase(place, rest.substr(place).starts_with("units") ? 5 : 4);
    if (rest == "x" || rest == "xaxis" || names({"lateral", "horizontal", "position"}))
        return UnitOf::x;
    if (rest == "z" || rest == "y" || rest == "zaxis" || rest == "yaxis" ||
        names({"height", "value", "vertical"}))
        return UnitOf::height;
    return UnitOf::nothing;
}

/// "0.5 um", "0,5 µm", "0.156 um/sample".
std::optional<HeaderLength> length_of(std::string_view value) {
    const std::size_t end = std::min(value.find_first_not_of("+-0123456789.,eE"), value.size());
    const bool comma = value.substr(0, end).find(',') != std::string_view::npos;
    const auto size = number(trim(value.substr(0, end)), Dialect{Dialect::Separator::blanks, comma});
    if (!size || !(size->value > 0))
        return std::nullopt;
    std::string_view unit = trim(value.substr(end));
    unit = unit.substr(0, unit.find('/'));
    if (unit.size() > 2 && (unit.front() == '[' || unit.front() == '('))
        unit = unit.substr(1, unit.size() - 2);
    return HeaderLength{size->value, length_unit(unit)};
}

/// "heightconversionfactor(->m)": its unit in mm; 0 where the key is another.
double conversion_unit(const std::string& key, const std::string& where) {
    constexpr std::string_view start = "heightconversionfactor(";
    if (!key.starts_with(start))
        return 0;
    const std::size_t word = key.find('>') + 1, end = key.find(')');
    if (word == 0 || end == std::string::npos || end < word)
        return 0;
    return length_unit_named(std::string_view(key).substr(word, end - word), where).in_mm;
}

double positive(const Entry& entry, const std::string& where) {
    const auto value = number(entry.value, Dialect{});
    if (!value || !(value->value > 0))
        throw InputError(where + ": " + entry.key + " is '" + std::string(entry.value) +
                         "', expected a number above 0");
    return value->value;
}

void take(Header& header, const Entry& entry, const std::string& where) {
    if (const UnitOf of = unit_key(entry.key); of != UnitOf::nothing) {
        const auto units = length_units_in(entry.value, where);
        if (units.empty())
            throw InputError(where + ": '" + std::string(entry.value) + "' names no length unit");
        if (of != UnitOf::height)
            header.x_unit = units.front();
        if (of != UnitOf::x)
            header.height_unit = units.back();
    } else if (const double in_mm = conversion_unit(entry.key, where)) {
        header.height_factor = positive(entry, where);
        header.height_unit = LengthUnit{"m", in_mm};
    } else if (is_in(width_keys, entry.key)) {
        header.width = length_of(entry.value);
    } else if (is_in(spacing_keys, entry.key) ||
               (entry.key == "resolution" && entry.value.find("/sample") != std::string_view::npos)) {
        header.spacing = length_of(entry.value);
    }
}

/// A line that speaks of numbers is no line of column names.
bool holds_number(std::string_view line) {
    for (const auto separator :
         {Dialect::Separator::blanks, Dialect::Separator::semicolon, Dialect::Separator::comma})
        for (std::string_view cell : split(line, separator))
            if (const auto value = number(cell, Dialect{}); value && !std::isnan(value->value))
                return true;
    return false;
}

/// Splits at blanks, a bracketed unit going with the word before it.
std::vector<std::string> words_with_units(std::string_view line) {
    std::vector<std::string> cells;
    for (std::string_view word : split(line, Dialect::Separator::blanks)) {
        const bool unit = word.starts_with('[') || word.starts_with('(');
        if (unit && !cells.empty() && cells.back().find_first_of("[(") == std::string::npos)
            cells.back() += " " + std::string(word);
        else
            cells.emplace_back(word);
    }
    return cells;
}

/// The cells of a line of column names; empty where none of the separators gives one a column.
std::vector<std::string> column_names(std::string_view line, const Dialect& dialect, std::size_t columns) {
    using enum Dialect::Separator;
    for (const auto separator : {dialect.separator, semicolon, tab, comma}) {
        if (separator == blanks)
            continue;
        const auto cells = split(line, separator);
        if (cells.size() == columns)
            return {cells.begin(), cells.end()};
    }
    auto words = words_with_units(line);
    return words.size() == columns ? words : std::vector<std::string>{};
}

/// The units that a line of column names gives, one a column.
std::vector<std::optional<LengthUnit>> column_units(const TextLine& line, const Dialect& dialect,
                                                    std::size_t columns, const std::string& where) {
    std::vector<std::optional<LengthUnit>> units(columns);
    std::string_view alone = trim(line.text);
    if (alone.size() > 2 && (alone.front() == '[' || alone.front() == '('))
        alone = alone.substr(1, alone.size() - 2);
    if (const auto unit = length_unit(alone)) // one for all
        return std::vector<std::optional<LengthUnit>>(columns, unit);
    const auto names = column_names(line.text, dialect, columns);
    for (std::size_t c = 0; c < names.size(); ++c)
        if (const auto found = length_units_in(names[c], where); !found.empty())
            units[c] = found.back();
    if (!names.empty())
        return units;
    const auto found = length_units_in(line.text, where);
    if (found.size() >= columns)
        for (std::size_t c = 0; c < columns; ++c)
            units[c] = found[c];
    return units;
}

bool names_validity(const TextLine& line, const Dialect& dialect, std::size_t columns) {
    const auto names = column_names(line.text, dialect, columns);
    return !names.empty() && lower(names.back()).starts_with("valid");
}

} // namespace

Header read_header(const std::vector<TextLine>& lines, const Dialect& dialect, std::size_t columns,
                   const std::string& file) {
    Header header;
    header.units.resize(columns);
    header.unknown_units.resize(columns);
    for (const TextLine& line : lines)
        if (const auto read = entry(line.text))
            take(header, *read, at(file, line.number));
    // The names stand right above the table, their units with them or in a line of their own.
    std::size_t looked = 0;
    for (auto line = lines.rbegin(); line != lines.rend() && looked < 3; ++line, ++looked) {
        const auto read = entry(line->text);
        if (holds_number(line->text) || (read && unit_key(read->key) != UnitOf::nothing))
            break;
        const auto units = column_units(*line, dialect, columns, at(file, line->number));
        const auto names = column_names(line->text, dialect, columns);
        for (std::size_t c = 0; c < columns; ++c) {
            if (!header.units[c])
                header.units[c] = units[c];
            if (!names.empty() && header.unknown_units[c].empty())
                header.unknown_units[c] = unknown_unit_in(names[c]);
        }
        header.validity_column |= names_validity(*line, dialect, columns);
    }
    return header;
}

bool names_spacing(const std::string& line) {
    const auto read = entry(line);
    return read && (is_in(spacing_keys, read->key) || is_in(width_keys, read->key)) && length_of(read->value);
}

} // namespace rough
