#pragma once

#include "domain/database/store.hpp"
#include "ga/base/json.hpp"
#include "tests/apps/program.hpp"

#include <regex>
#include <sstream>

namespace app::testing {

/// The first group of each match of a regular expression in a text.
inline std::vector<std::string> found(const std::string& text, const std::string& pattern) {
    const std::regex expression(pattern);
    std::vector<std::string> all;
    for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i) all.push_back((*i)[1]);
    return all;
}

inline nlohmann::json json_in(const std::filesystem::path& file) {
    return nlohmann::json::parse(rough::read_whole(file));
}

/// The result.json of a run's folder.
inline nlohmann::json result_in(const std::filesystem::path& folder) { return json_in(folder / "result.json"); }

/// The result.json in the folder of a run that ended well.
inline nlohmann::json result_of(const Ended& ended, const std::filesystem::path& folder) {
    answered(ended);
    return result_in(folder);
}

/// Runs the program with its results in the folder r; the result.json of a run that ended well.
inline nlohmann::json result_of(const Folder& folder, const std::string& words) {
    return result_of(rugosa(words + " --out r", folder.path()), folder / "r");
}

/// A value without its times, at any depth.
inline nlohmann::json without_times(nlohmann::json value) {
    if (value.is_object()) {
        value.erase("seconds");
        if (value.value("id", nlohmann::json()) == "minute") // the paper's claim on the time
            value.erase("numbers");
    }
    if (value.is_structured())
        for (auto& part : value) part = without_times(std::move(part));
    return value;
}

/// A result without its times, its threads and its command.
inline nlohmann::json timeless(nlohmann::json result) {
    result.erase("threads");
    result.erase("command");
    return without_times(std::move(result));
}

/// The result without times of a run whose results are in the subfolder "o".
inline nlohmann::json of_run(const std::filesystem::path& folder) { return timeless(result_in(folder / "o")); }
/// All curves of the database "g.db" in a folder.
inline nlohmann::json of_database(const std::filesystem::path& folder) {
    const rough::StoredCurves curves = rough::GenomeStore::open(folder / "g.db").curves(true);
    return {curves.index, curves.range, curves.pressure, curves.fraction};
}

/// The rows of numbers in a CSV file. If `header` is not empty, the file must have it.
inline std::vector<std::vector<double>> rows_of(const std::filesystem::path& file, const std::string& header = "") {
    std::istringstream text(rough::read_whole(file));
    std::string line;
    std::getline(text, line);
    if (!header.empty()) CHECK(line == header);
    std::vector<std::vector<double>> rows;
    while (std::getline(text, line)) {
        rows.emplace_back();
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
    }
    return rows;
}

/// The header of a curve's CSV file.
inline const std::string curve_header = "displacement_mm,pressure_MPa,contact_fraction,"
                                        "tangent_stiffness_MPa_per_mm,kkt_residual,"
                                        "interface_stiffness_MPa_per_mm";

/// The file of a genome of one series; each wave has its n and its phases.
inline std::string genome_text(double A, double H, double gamma, const std::map<int, std::vector<double>>& waves) {
    nlohmann::json series{{"A", A}, {"H", H}, {"gamma", gamma}, {"lambda", 0.84942}};
    for (const auto& [n, phases] : waves) series["chromosomes"].push_back({{"n", n}, {"phases", phases}});
    return nlohmann::json{{"series", nlohmann::json::array({series})}}.dump();
}
inline const std::string one_wave = genome_text(1, 0.8, 1.5, {{1, {0.3}}});

/// A text file of numbers: f(i, j) in column i of row j.
inline std::string table_text(int columns, int rows, const std::function<double(int, int)>& f,
                              const std::string& separator = " ") {
    std::string text;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) text += std::to_string(f(i, j)) + (i + 1 < columns ? separator : "\n");
    return text;
}
/// n heights, one a line.
inline std::string heights_text(int n, const std::function<double(int)>& height) {
    return table_text(1, n, [&](int, int i) { return height(i); });
}
/// n places and heights under the line `units`, e.g. "x [mm];z [um]".
inline std::string profile_text(const std::string& units, int n, double spacing,
                                const std::function<double(int)>& height) {
    const auto cell = [&](int column, int i) { return column == 0 ? spacing * i : height(i); };
    return units + "\n" + table_text(2, n, cell, ";");
}

} // namespace app::testing
