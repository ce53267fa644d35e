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
bool empty_line(std::string_view line) { return line.find_first_not_of(" \t\v\f;,") == std::string_view::npos; }

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
        if ((line[i] == '#' || line[i] == '%') && (line[i - 1] == ' ' || line[i - 1] == '\t')) return line.substr(0, i);
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
            if (const RowSize row = visit_row(line, dialect, [](const Number&) {}); row.any_number) {
                ++guess.rows;
                ++widths[row.cells];
            }
        // The last cells of a row may be empty, if a mark separates them.
        const bool is_matrix = !widths.empty() && widths.rbegin()->first > max_scan_columns;
        for (const auto& [width, count] : widths)
            if (guess.columns == 0 || count >= widths[guess.columns] || (is_matrix && dialect.separator != blanks))
                guess.columns = width;
        if (guess.rows > best.rows || (guess.rows == best.rows && best.columns != wanted && guess.columns == wanted))
            best = guess;
    }
    return best;
}

/// Whether a cell is a count of points.
bool is_count(const Number& cell) {
    return cell.value >= 1 && cell.value == std::floor(cell.value) && cell.last_place == 0 &&
           cell.value <= static_cast<double>(max_rows);
}

/// Removes lines at the start of a single column that are not heights. They are the count of the heights that
/// follow, and a length before or after it.
void take_lone_lines(Table& table) {
    constexpr std::size_t min_heights = 20; // fewer may be equal to a height by chance
    for (std::size_t lone = 1; lone <= 3 && lone < table.rows(); ++lone)
        for (std::size_t k = 0; k < lone && (lone == 1 || table.rows() >= lone + min_heights); ++k)
            if (const Number& cell = table.at(k, 0);
                is_count(cell) && cell.value == static_cast<double>(table.rows() - lone)) {
                table.announced = static_cast<long>(cell.value);
                table.lone = lone;
                const auto end = static_cast<std::ptrdiff_t>(lone);
                table.cells.erase(table.cells.begin(), table.cells.begin() + end);
                table.line.erase(table.line.begin(), table.line.begin() + end);
                return;
            }
}

/// The cells of a line by its separators, empty ones included.
std::size_t separated(std::string_view line, Dialect::Separator separator) {
    using enum Dialect::Separator;
    const char mark = separator == semicolon ? ';' : separator == tab ? '\t' : ',';
    return separator == blanks ? 0 : static_cast<std::size_t>(std::ranges::count(line, mark)) + 1;
}

} // namespace

Table read_table(const Lines& lines, const std::string& file, bool one_column) {
    const Guess guess = best_guess(lines, one_column);
    if (guess.rows == 0) refuse(file, ": contains no numbers; give lines of x and height");
    Table table;
    table.dialect = guess.dialect;
    table.columns = guess.columns;
    if (table.columns > max_rows) refuse(file, ": more than 1e7 numbers in a line; give fewer");
    // Memory for all possible cells, but only a few times the file's size.
    const auto characters = static_cast<std::size_t>(lines[lines.size() - 1].end() - lines[0].begin());
    table.cells.reserve(
        std::min({max_cells, lines.size() * table.columns, std::max(characters / 2, max_scan_columns * lines.size())}));
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const int line = static_cast<int>(i + 1);
        const bool is_wide =
            table.columns > max_scan_columns && separated(lines[i], table.dialect.separator) >= table.columns;
        if (empty_line(lines[i]) && !(is_wide && table.rows() > 0)) continue;
        if (const auto remark = comment(lines[i])) {
            if (table.rows() == 0) table.header.push_back({line, *remark});
            continue;
        }
        const std::size_t before = table.cells.size();
        const RowSize row = visit_row(lines[i], table.dialect, [&](const Number& cell) {
            if (table.cells.size() - before < table.columns) table.cells.push_back(cell);
        });
        const bool is_row = (row.cells > 0 || empty_line(lines[i])) && (table.rows() > 0 || row.any_number);
        const bool is_lone =
            is_row && table.columns > 1 && row.cells == 1 && table.rows() == 0 && !std::isnan(table.cells.back().value);
        if (is_lone && (is_count(table.cells.back()) || table.cells.back().last_place < 0)) {
            if (is_count(table.cells.back())) table.announced = static_cast<long>(table.cells.back().value);
            ++table.lone;
            table.cells.resize(before);
        } else if (is_row) {
            if (row.cells > table.columns ||
                (row.cells < table.columns && table.columns > max_scan_columns && !is_wide))
                refuse(at(file, line), ": ", row.cells, " columns, but the other rows have ", table.columns,
                       "; correct this row");
            if (table.rows() == max_rows) refuse(at(file, line), ": more than 1e7 points; give fewer");
            if (before + table.columns > max_cells) refuse(file, ": more than 2e7 numbers; give fewer");
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
    if (table.columns == 1) take_lone_lines(table);
    return table;
}

} // namespace rough
