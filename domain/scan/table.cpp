#include "domain/scan/table.hpp"

#include "domain/errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace rough {
namespace {

constexpr std::size_t max_rows = 10'000'000, max_cells = 20'000'000;
/// Most columns of a scan: x, height and validity, or an index before two columns. More columns are a matrix.
constexpr std::size_t max_scan_columns = 3;

/// Whether a line has only blanks, or a spreadsheet's empty cells.
bool empty_line(std::string_view line) {
    return line.find_first_not_of(" \t\v\f;,") == std::string_view::npos;
}

/// The text after a line's comment mark; nothing if the line is not a comment.
std::optional<std::string_view> comment(std::string_view line) {
    line = trim(line);
    constexpr std::array<std::string_view, 6> marks{"#", "%", "!", "//", "*", "'"};
    if (std::none_of(marks.begin(), marks.end(), [&](auto mark) { return line.starts_with(mark); }))
        return std::nullopt;
    return trim(line.substr(std::min(line.find_first_not_of("#%!/*' \t"), line.size())));
}

/// A row without the comment after it.
std::string_view without_remark(std::string_view line) {
    for (std::size_t i = 1; i < line.size(); ++i)
        if ((line[i] == '#' || line[i] == '%') && (line[i - 1] == ' ' || line[i - 1] == '\t'))
            return line.substr(0, i);
    return line;
}

/// The number of numbers in a line; 0 if it is not a row.
struct RowSize {
    std::size_t cells = 0;
    bool any_number = false; ///< at least one is not missing
};

/// Visits the numbers of a line up to the first cell that is not a number.
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

/// The dialect that reads the most lines as rows, with their commonest width.
Guess best_guess(const Lines& lines, bool one_column) {
    using enum Dialect::Separator;
    // The end of a file is its table, and a thousand lines of it show the dialect, or fewer long ones.
    std::vector<std::string_view> sample;
    std::size_t left = 200'000; // characters
    for (std::size_t i = lines.size(); i-- > 0 && sample.size() < 1000 && (left > 0 || sample.size() < 20);)
        if (!empty_line(lines[i]) && !comment(lines[i])) {
            sample.push_back(lines[i]);
            left -= std::min(left, lines[i].size());
        }
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
        std::map<std::size_t, std::size_t> widths;
        Guess guess{dialect, 0, 0};
        for (const std::string_view line : sample)
            if (const RowSize row = size_of_row(line, dialect); row.any_number) {
                ++guess.rows;
                ++widths[row.cells];
            }
        for (const auto& [width, count] : widths)
            if (guess.columns == 0 || count >= widths[guess.columns])
                guess.columns = width;
        if (guess.rows > best.rows ||
            (guess.rows == best.rows && best.columns != wanted && guess.columns == wanted))
            best = guess;
    }
    return best;
}

/// Whether a line's only cell is a count of points before the rows: of a wider table, or of as many single
/// heights as follow. `next` is the index of the line after it.
bool is_count(const Table& table, const Lines& lines, std::size_t next) {
    if (table.rows() > 0 || table.announced >= 0)
        return false;
    const auto& [value, last_place] = table.cells.back();
    if (!(value >= 1 && value == std::floor(value) && last_place == 0 &&
          value <= static_cast<double>(max_rows)))
        return false;
    if (table.columns > 1)
        return true;
    double rows = 0;
    for (std::size_t i = next; i < lines.size(); ++i)
        rows += !comment(lines[i]) && size_of_row(lines[i], table.dialect).cells > 0;
    return value == rows;
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
    "xincrement pitch samplingpitch samplinginterval sampleinterval pointdistance sampledistance xscale ";
constexpr std::string_view width_keys = " width xlength breite ";

/// The columns whose unit a key like "x-unit", "Height units" or "Unit" gives.
enum class UnitOf { nothing, all, x, height };
UnitOf unit_key(const std::string& key) {
    if (is_in(unit_keys, key))
        return UnitOf::all;
    std::string rest = key;
    const std::size_t place = rest.find("unit");
    if (place == std::string::npos)
        return UnitOf::nothing;
    rest.erase(place, rest.substr(place).starts_with("units") ? 5 : 4);
    const auto holds = [&](std::initializer_list<std::string_view> parts) {
        return std::any_of(parts.begin(), parts.end(),
                           [&](auto part) { return key.find(part) != std::string::npos; });
    };
    if (is_in(" x xaxis ", rest) || holds({"lateral", "horizontal", "position"}))
        return UnitOf::x;
    return is_in(" z y zaxis yaxis ", rest) || holds({"height", "value", "vertical"}) ? UnitOf::height
                                                                                      : UnitOf::nothing;
}

/// The content of a text in brackets, else the text.
std::string_view without_brackets(std::string_view text) {
    const bool brackets = text.size() > 2 && (text.front() == '[' || text.front() == '(');
    return brackets ? text.substr(1, text.size() - 2) : text;
}

/// "0.5 um", "0,5 µm", "0.156 um/sample".
std::optional<HeaderLength> length_of(std::string_view value) {
    const std::size_t end = std::min(value.find_first_not_of("+-0123456789.,eE"), value.size());
    const bool comma = value.substr(0, end).find(',') != std::string_view::npos;
    const auto size = number(trim(value.substr(0, end)), Dialect{Dialect::Separator::blanks, comma});
    if (!size || !(size->value > 0))
        return std::nullopt;
    const std::string_view unit = trim(value.substr(end));
    return HeaderLength{size->value, length_unit(without_brackets(unit.substr(0, unit.find('/'))))};
}

/// The unit in mm of "heightconversionfactor(->m)"; 0 for another key.
double conversion_unit(const std::string& key, const std::string& where) {
    const std::size_t word = key.find('>') + 1, end = key.find(')');
    if (!key.starts_with("heightconversionfactor(") || word == 0 || end == std::string::npos || end < word)
        return 0;
    return length_unit_named(std::string_view(key).substr(word, end - word), where).in_mm;
}

void take(Header& header, const Entry& entry, const std::string& where) {
    if (const UnitOf of = unit_key(entry.key); of != UnitOf::nothing) {
        const auto units = length_units_in(entry.value, where);
        if (units.empty())
            refuse(where, ": '", entry.value, "' has no length unit; write one, as in 'unit: um'");
        if (of != UnitOf::height)
            header.x_unit = units.front();
        if (of != UnitOf::x)
            header.height_unit = units.back();
    } else if (const double in_mm = conversion_unit(entry.key, where); in_mm > 0) {
        const auto factor = number(entry.value, Dialect{});
        if (!factor || !(factor->value > 0))
            refuse(where, ": ", entry.key, " '", entry.value, "' is not a number above 0; correct it");
        header.height_factor = factor->value;
        header.height_unit = LengthUnit{"m", in_mm};
    } else if (is_in(width_keys, entry.key)) {
        header.width = length_of(entry.value);
    } else if (is_in(spacing_keys, entry.key) ||
               (entry.key == "resolution" && entry.value.find("/sample") != std::string_view::npos)) {
        header.spacing = length_of(entry.value);
    }
}

/// Whether a line contains numbers, so that it is not a line of column names.
bool holds_number(std::string_view line) {
    for (const auto separator :
         {Dialect::Separator::blanks, Dialect::Separator::semicolon, Dialect::Separator::comma})
        for (std::string_view cell : split(line, separator))
            if (const auto value = number(cell, Dialect{}); value && !std::isnan(value->value))
                return true;
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
std::vector<std::optional<LengthUnit>> column_units(std::string_view line,
                                                    const std::vector<std::string>& names,
                                                    std::size_t columns, const std::string& where) {
    std::vector<std::optional<LengthUnit>> units(columns, length_unit(without_brackets(trim(line))));
    if (units.front()) // one for all
        return units;
    for (std::size_t c = 0; c < names.size(); ++c)
        if (const auto found = length_units_in(names[c], where); !found.empty())
            units[c] = found.back();
    if (names.empty())
        if (const auto found = length_units_in(line, where); found.size() >= columns)
            std::copy_n(found.begin(), columns, units.begin());
    return units;
}

} // namespace

Table read_table(const Lines& lines, const std::string& file, bool one_column) {
    const Guess guess = best_guess(lines, one_column);
    if (guess.rows == 0)
        refuse(file, ": contains no numbers; give lines of x and height");
    Table table;
    table.dialect = guess.dialect;
    table.columns = guess.columns;
    if (table.columns > max_rows)
        refuse(file, ": more than 1e7 numbers in a line; give fewer");
    // Memory for all possible cells, but only a few times the file's size.
    const auto characters = static_cast<std::size_t>(lines[lines.size() - 1].end() - lines[0].begin());
    table.cells.reserve(std::min({max_cells, lines.size() * table.columns,
                                  std::max(characters / 2, max_scan_columns * lines.size())}));
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
        const bool is_row = row.cells > 0 && (table.rows() > 0 || row.any_number);
        if (is_row && row.cells == 1 && is_count(table, lines, i + 1)) {
            table.announced = static_cast<long>(table.cells.back().value);
            table.cells.resize(before);
        } else if (is_row) {
            if (row.cells > table.columns || (row.cells < table.columns && table.columns > max_scan_columns))
                refuse(at(file, line), ": ", row.cells, " columns, but the other rows have ", table.columns,
                       "; correct this row");
            if (table.rows() == max_rows)
                refuse(at(file, line), ": more than 1e7 points; give fewer");
            if (before + table.columns > max_cells)
                refuse(file, ": more than 2e7 numbers; give fewer");
            table.cells.resize(before + table.columns, Number{std::nan(""), 0});
            table.line.push_back(line);
        } else if (table.rows() == 0) {
            table.cells.resize(before);
            table.header.push_back({line, lines[i]});
        } else {
            refuse(at(file, line), ": '", trim(lines[i]).substr(0, 60), "' is not a row of ", table.columns,
                   table.columns == 1 ? " number" : " numbers", "; correct this row");
        }
    }
    return table;
}

Header read_header(const Table& table, const std::string& file) {
    const std::vector<TextLine>& lines = table.header;
    const std::size_t columns =
        table.columns <= max_scan_columns ? table.columns : 1; // one unit for a matrix
    Header header;
    header.units.resize(columns);
    header.unknown_units.resize(columns);
    for (const TextLine& line : lines)
        if (const auto read = entry(line.text))
            take(header, *read, at(file, line.number));
    // The names are right above the table, their units with them or in a line below.
    for (auto line = lines.rbegin(); line != lines.rend() && line - lines.rbegin() < 3; ++line) {
        const auto read = entry(line->text);
        if (holds_number(line->text) || (read && unit_key(read->key) != UnitOf::nothing))
            break;
        const auto names = column_names(line->text, table.dialect, columns);
        const auto units = column_units(line->text, names, columns, at(file, line->number));
        for (std::size_t c = 0; c < columns; ++c) {
            if (!header.units[c])
                header.units[c] = units[c];
            if (!names.empty() && header.unknown_units[c].empty())
                header.unknown_units[c] = unknown_unit_in(names[c]);
        }
        header.validity_column |= !names.empty() && lower(names.back()).starts_with("valid");
    }
    return header;
}

bool names_spacing(std::string_view line) {
    const auto read = entry(line);
    return read && (is_in(spacing_keys, read->key) || is_in(width_keys, read->key)) && length_of(read->value);
}

} // namespace rough
