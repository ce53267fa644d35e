#include "ga/observers/coco.hpp"

#include "ga/base/number.hpp"

#include <fstream>

namespace ga {

void write_coco(const std::filesystem::path& folder, const std::string& algorithm,
                const std::vector<CocoFunction>& functions) {
    const auto write = [](const std::filesystem::path& file, const std::string& text) {
        std::ofstream stream(file, std::ios::binary);
        if (!(stream << text) || !stream.flush())
            throw UsageError(file.string() + ": cannot be written; choose another folder");
    };
    std::filesystem::create_directories(folder);
    std::map<int, std::string> infos;
    for (const CocoFunction& function : functions) {
        const std::string id = "f" + std::to_string(function.id);
        const std::string name = "data_" + id + "/bbobexp_" + id + "_DIM" + std::to_string(function.dimension);
        std::string rows, runs;
        for (const CocoRun& run : function.runs) {
            rows += "% function evaluation | noise-free fitness - Fopt (0.000000000000e+00) | best noise-free "
                    "fitness - Fopt | measured fitness | best measured fitness\n";
            const auto row = [&](long evaluations, double precision) {
                rows += std::to_string(evaluations);
                for (int column = 0; column < 4; ++column) rows += " " + number(precision);
                rows += "\n";
            };
            for (const auto& [evaluations, precision] : run.found) row(evaluations, precision);
            const double last = run.found.empty() ? HUGE_VAL : run.found.back().second;
            if (!run.found.empty() && run.found.back().first < run.evaluations) row(run.evaluations, last);
            runs += ", " + std::to_string(run.instance) + ":" + std::to_string(run.evaluations) + "|" + number(last);
        }
        std::filesystem::create_directories((folder / name).parent_path());
        for (const char* ending : {".dat", ".tdat"}) write(folder / (name + ending), rows);
        infos[function.id] += "funcId = " + std::to_string(function.id) +
                              ", DIM = " + std::to_string(function.dimension) + ", Precision = 1.000e-08, algId = '" +
                              algorithm + "'\n% written by rugosa\n" + name + ".dat" + runs + "\n";
    }
    for (const auto& [id, text] : infos) write(folder / ("bbobexp_f" + std::to_string(id) + ".info"), text);
}

} // namespace ga
