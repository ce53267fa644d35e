#include "domain/scan/table.hpp"

#include "domain/errors.hpp"
#include "domain/text/lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace rough {
namespace {

constexpr std::size_t most_rows = 10'000'000;

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

/// A line's numbers; empty where it is no row.
std::vector<Number> row_of(std::string_view line, const Dialect& dialect) {
    std::vector<Number> row;
    for (std::string_view cell : split(without_remark(line), dialect.separator)) {
        const auto value = number(cell, dialect);
        if (!value)
            return {};
        row.push_back(*value);
    }
    return row;
}

bool any_number(const std::vector<Number>& row) {
    return std::any_of(row.begin(), row.end(), [](const Number& cell) { return !std::isnan(cell.value); });
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
        if (const auto row = row_of(line, dialect); any_number(row)) {
            ++guess.rows;
            ++widths[row.size()];
        }
    for (const auto& [width, count] : widths)
        if (guess.columns == 0 || count >= widths[guess.columns])
            guess.columns = width;
    return guess;
}

Guess best_guess(const std::vector<std::string>& lines, bool one_column) {
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
bool is_count(const Table& table, const std::vector<Number>& row, std::size_t rows_left) {
    if (table.rows() > 0 || row.size() != 1 || table.announced >= 0 || !(row[0].value >= 1) ||
        row[0].value != std::floor(row[0].value) || row[0].last_digit != 1 ||
        row[0].value > static_cast<double>(most_rows))
        return false;
    return table.columns > 1 || row[0].value == static_cast<double>(rows_left);
}

} // namespace

Table read_table(const std::vector<std::string>& lines, const std::string& file, bool one_column) {
    const Guess guess = best_guess(lines, one_column);
    if (guess.rows == 0)
        throw InputError(file + ": holds no numbers, expected lines of x and height");
    if (guess.columns > most_cells)
        throw InputError(file + ": more than 1e7 numbers in a line");
    Table table;
    table.dialect = guess.dialect;
    table.columns = guess.columns;
    table.column.resize(guess.columns);

    std::size_t rows_left = 0;
    for (const std::string& line : lines)
        rows_left += !comment(line) && !row_of(line, table.dialect).empty();

    const auto add = [&](std::vector<Number> row, int line) {
        row.resize(table.columns, Number{std::nan(""), 0});
        for (std::size_t c = 0; c < table.columns; ++c)
            table.column[c].push_back(row[c]);
        table.line.push_back(line);
        if (table.rows() > most_rows)
            throw InputError(at(file, line) + ": more than 1e7 points");
    };
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const int line = static_cast<int>(i + 1);
        if (empty_line(lines[i]))
            continue;
        if (const auto remark = comment(lines[i])) {
            if (table.rows() == 0)
                table.header.push_back({line, std::string(*remark)});
            continue;
        }
        const std::vector<Number> row = row_of(lines[i], table.dialect);
        rows_left -= !row.empty();
        const bool is_row = !row.empty() && (table.rows() > 0 || any_number(row));
        if (!is_row && table.rows() == 0) {
            table.header.push_back({line, lines[i]});
        } else if (!is_row) {
            throw InputError(at(file, line) + ": '" + std::string(trim(lines[i])).substr(0, 60) +
                             "', expected " + std::to_string(table.columns) +
                             (table.columns == 1 ? " number" : " numbers"));
        } else if (is_count(table, row, rows_left)) {
            table.announced = static_cast<long>(row[0].value);
        } else if (row.size() > table.columns) {
            throw InputError(at(file, line) + ": " + std::to_string(row.size()) + " columns, expected " +
                             std::to_string(table.columns) + " as in the other rows");
        } else {
            add(row, line);
        }
    }
    return table;
}

} // namespace rough
