#include "domain/target/target_table.hpp"

#include "domain/errors.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/lines.hpp"
#include "domain/text/words.hpp"

#include <algorithm>
#include <cmath>

namespace rough {

namespace {

constexpr std::size_t max_bytes = 16'000'000;

using Separator = Dialect::Separator;

Separator separator_of(const std::string& header) {
    return header.find(';') != std::string::npos    ? Separator::semicolon
           : header.find('\t') != std::string::npos ? Separator::tab
                                                    : Separator::comma;
}

double number_in(std::string_view cell, Separator separator, const std::string& where) {
    auto value = number(cell, {separator, false});
    if (!value && separator != Separator::comma)
        value = number(cell, {separator, true});
    if (value && std::isfinite(value->value))
        return value->value;
    throw InputError(where + ": \"" + std::string(cell) + "\" given, expected a finite number");
}

} // namespace

int TargetTable::place_of(const std::string& name) const {
    const auto found = std::find(header.begin(), header.end(), name);
    return found == header.end() ? -1 : static_cast<int>(found - header.begin());
}

Eigen::VectorXd TargetTable::column(int place, double factor) const {
    Eigen::VectorXd values(static_cast<Index>(rows.size()));
    for (std::size_t k = 0; k < rows.size(); ++k)
        values[static_cast<Index>(k)] = factor * rows[k][static_cast<std::size_t>(place)];
    return values;
}

std::string TargetTable::header_text() const {
    std::string text;
    for (const auto& name : header)
        text += (text.empty() ? "" : ",") + name;
    return text;
}

TargetTable read_target_table(const std::filesystem::path& file) {
    TargetTable table;
    Separator separator = Separator::comma;
    int number = 0;
    std::string bytes = read_whole(file, max_bytes);
    for (const std::string_view whole : text_lines(bytes, file.string())) {
        ++number;
        const std::string line(trim(whole));
        if (line.empty())
            continue;
        const std::string where = file.string() + ":" + std::to_string(number);
        if (line[0] == '#') {
            const auto colon = line.find(':');
            if (colon != std::string::npos)
                table.recorded[std::string(trim(line.substr(1, colon - 1)))] = trim(line.substr(colon + 1));
        } else if (table.header.empty()) {
            separator = separator_of(line);
            table.header_line = number;
            for (const auto cell : split(line, separator))
                table.header.emplace_back(cell);
        } else {
            const auto cells = split(line, separator);
            if (cells.size() != table.header.size())
                throw InputError(where + ": \"" + line + "\" given, expected " +
                                 std::to_string(table.header.size()) + " numbers with " +
                                 (separator == Separator::semicolon ? "semicolons"
                                  : separator == Separator::tab     ? "tabs"
                                                                    : "commas") +
                                 " between");
            table.rows.emplace_back();
            for (const auto cell : cells)
                table.rows.back().push_back(number_in(cell, separator, where));
        }
    }
    return table;
}

} // namespace rough
