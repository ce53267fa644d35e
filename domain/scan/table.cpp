#include "domain/scan/table.hpp"

#include "domain/errors.hpp"
#include "domain/text/lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace rough {
namespace {

constexpr std::size_t max_rows = 10'000'000, max_cells = 20'000'000;
constexpr std::size_t max_scan_columns =
    3; ///< x, height and validity, or an index before two; more are a matrix

/// A line of blanks, or of a spreadsheet's empty cells.
bool empty_line(std::string_view line) {
    return line.find_first_not_of(" \t\v\f;,") == std::string_view::npos;
}

/// The text after a line's comment mark; nothing where the line is no comment.
std::optional<std::string_view> comment(std::string_view line) {
    line = trim(line);
    constexpr std::array<std::string_view, 6> marks{"#", "%", "!", "//", "*", "'"};
    if (std::none_of(marks.begin(), marks.end(), [&](auto mark) { return line.starts_with(mark); }))
        return std::nullopt;
    return trim(line.substr(std::min(line.find_first_not_of("#%!/*' \t"), line.size())));
}

/// A row without the comment behind it.
std::string_view without_remark(std::string_view line) {
    for (std::size_t i = 1; i < line.size(); ++i)
        if ((line[i] == '#' || line[i] == '%') && (line[i - 1] == ' ' || line[i - 1] == '\t'))
            return line.substr(0, i);
    return line;
}

/// How many numbers a line has; none if it is no row.
struct RowSize {
    std::size_t cells = 0;
    bool any_number = false; ///< one of them is not missing
};

/// Visits the numbers of a line up to the first cell that is none.
template <class Visit>
RowSize visit_row(std::string_view line, const Dialect& dialect, Visit visit) {
    RowSize size;
    for_each_cell(without_remark(line), dialect.separator, [&](std::string_view cell) {
        const auto value = number(cell, dialect);
        if (!value) {
            size = {};
            return false;
        }
        ++size.cells;
        size.any_number = size.any_number || !std::isnan(value->value);
        visit(*value);
        return size.cells <= max_rows; // a longer row is refused
    });
    return size;
}

RowSize size_of_row(std::string_view line, const Dialect& dialect) {
    return visit_row(line, dialect, [](const Number&) {});
}

struct Guess {
    Dialect dialect;
    std::size_t rows = 0;
    std::size_t columns = 0;
};

/// How many of the lines a dialect reads as rows, and their commonest width.
Guess read_with(const Dialect& dialect, const std::vector<std::string_view>& lines) {
    std::map<std::size_t, std::size_t> widths;
    Guess guess{dialect, 0, 0};
    for (std::string_view line : lines)
        if (const RowSize row = size_of_row(line, dialect); row.any_number) {
            ++guess.rows;
            ++widths[row.cells];
        }
    for (const auto& [width, count] : widths)
        if (guess.columns == 0 || count >= widths[guess.columns])
            guess.columns = width;
    return guess;
}

Guess best_guess(const std::vector<std::string_view>& lines, bool one_column) {
    using enum Dialect::Separator;
    // The end of a file is its table; a thousand lines of it tell the dialect.
    std::vector<std::string_view> sample;
    for (std::size_t i = lines.size(); i-- > 0 && sample.size() < 1000;)
        if (!empty_line(lines[i]) && !comment(lines[i]))
            sample.push_back(lines[i]);
    constexpr std::array<Dialect, 8> dialects{{{semicolon, false},
                                               {semicolon, true},
                                               {tab, false},
                                               {tab, true},
                                               {comma, false},
                                               {comma_and_blank, true},
                                               {blanks, false},
                                               {blanks, true}}};
    const std::size_t wanted = one_column ? 1 : 2;
    Guess best;
    for (const Dialect& dialect : dialects) {
        const Guess guess = read_with(dialect, sample);
        if (guess.rows > best.rows ||
            (guess.rows == best.rows && best.columns != wanted && guess.columns == wanted))
            best = guess;
    }
    return best;
}

/// A lone count of points before the rows: of a wider table, or of as many single heights as follow.
bool is_count(const Table& table, std::size_t cells, std::size_t rows_left) {
    if (table.rows() > 0 || cells != 1 || table.announced >= 0)
        return false;
    const auto& [value, last_digit] = table.cells.back();
    if (!(value >= 1) || value != std::floor(value) || last_digit != 1 ||
        value > static_cast<double>(max_rows))
        return false;
    return table.columns > 1 || value == static_cast<double>(rows_left);
}

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

Table read_table(const std::vector<std::string_view>& lines, const std::string& file, bool one_column) {
    const Guess guess = best_guess(lines, one_column);
    if (guess.rows == 0)
        throw InputError(file + ": holds no numbers, expected lines of x and height");
    Table table;
    table.dialect = guess.dialect;
    table.columns = guess.columns;
    std::size_t rows_left = 0, cells = 0;
    for (const std::string_view line : lines)
        if (const RowSize row = comment(line) ? RowSize{} : size_of_row(line, table.dialect); row.cells > 0)
            ++rows_left, cells += std::min(std::max(row.cells, std::min(table.columns, max_scan_columns)),
                                           table.columns);
    if (cells > max_cells || table.columns > max_rows)
        throw InputError(file + ": more than " +
                         (cells > max_cells ? "2e7 numbers" : "1e7 numbers in a line") + ", expected fewer");
    table.cells.reserve(cells);
    table.line.reserve(rows_left);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const int line = static_cast<int>(i + 1);
        if (empty_line(lines[i]))
            continue;
        if (const auto remark = comment(lines[i])) {
            if (table.rows() == 0)
                table.header.push_back({line, *remark});
            continue;
        }
        const std::size_t before = table.cells.size();
        const RowSize row = visit_row(lines[i], table.dialect, [&](const Number& cell) {
            if (table.cells.size() - before < table.columns)
                table.cells.push_back(cell);
        });
        rows_left -= row.cells > 0;
        const bool is_row = row.cells > 0 && (table.rows() > 0 || row.any_number);
        if (is_row && is_count(table, row.cells, rows_left)) {
            table.announced = static_cast<long>(table.cells.back().value);
            table.cells.resize(before);
        } else if (is_row) {
            if (row.cells > table.columns || (row.cells < table.columns && table.columns > max_scan_columns))
                throw InputError(at(file, line) + ": " + std::to_string(row.cells) + " columns, expected " +
                                 std::to_string(table.columns) + " as in the other rows");
            if (table.rows() == max_rows)
                throw InputError(at(file, line) + ": more than 1e7 points");
            table.cells.resize(before + table.columns, Number{std::nan(""), 0});
            table.line.push_back(line);
        } else if (table.rows() == 0) {
            table.cells.resize(before);
            table.header.push_back({line, lines[i]});
        } else {
            throw InputError(at(file, line) + ": '" + std::string(trim(lines[i])).substr(0, 60) +
                             "', expected " + std::to_string(table.columns) +
                             (table.columns == 1 ? " number" : " numbers"));
        }
    }
    return table;
}

Header read_header(const Table& table, const std::string& file) {
    const std::vector<TextLine>& lines = table.header;
    const Dialect& dialect = table.dialect;
    const std::size_t columns =
        table.columns <= max_scan_columns ? table.columns : 1; // a matrix has one unit
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

bool names_spacing(std::string_view line) {
    const auto read = entry(line);
    return read && (is_in(spacing_keys, read->key) || is_in(width_keys, read->key)) && length_of(read->value);
}

} // namespace rough
