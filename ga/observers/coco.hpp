#pragma once

#include "ga/base/number.hpp"
#include "ga/run/context.hpp"

#include <filesystem>
#include <fstream>

namespace ga {

/// One run on one instance of a function of a benchmark suite.
struct CocoRun {
    int instance = 1;                           ///< number of the instance, from 1
    std::vector<std::pair<long, double>> found; ///< evaluations, and the best f - f_opt after them, falling
    long evaluations = 0;                       ///< number of all evaluations in the run
};

/// All runs on a function in one dimension.
struct CocoFunction {
    int id = 1;                ///< number in the suite, from 1
    std::size_t dimension = 1; ///< number of genes
    std::vector<CocoRun> runs; ///< one run for each instance
};

/// An observer that adds every improvement to a run. `optimum` is f_opt, `run` must outlive it.
template <class G>
Observer<G> coco_observer(CocoRun& run, double optimum) {
    return [&run, optimum](const Event<G>& event) {
        run.evaluations = event.counters.evaluations;
        for (const auto& individual : event.population) {
            if (event.derived || !individual.fitness.has_value())
                continue;
            const double precision = std::abs(individual.value() - optimum);
            if (run.found.empty() || precision < run.found.back().second)
                run.found.emplace_back(run.evaluations, precision);
        }
    };
}

/// Writes the runs of one algorithm in the format of COCO (Hansen et al. 2021, COCO: a platform for comparing
/// continuous optimizers in a black-box setting), which cocopp and IOHanalyzer read. There is
/// FOLDER/bbobexp_fN.info for each function, and FOLDER/data_fN/bbobexp_fN_DIMd.dat and .tdat for each
/// dimension. Rows have no genes. Throws std::filesystem::filesystem_error or UsageError if a file cannot be
/// written.
inline void write_coco(const std::filesystem::path& folder, const std::string& algorithm,
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
        const std::string name =
            "data_" + id + "/bbobexp_" + id + "_DIM" + std::to_string(function.dimension);
        std::string rows, runs;
        for (const CocoRun& run : function.runs) {
            rows +=
                "% function evaluation | noise-free fitness - Fopt (0.000000000000e+00) | best noise-free "
                "fitness - Fopt | measured fitness | best measured fitness\n";
            const auto row = [&](long evaluations, double precision) {
                rows += std::to_string(evaluations);
                for (int column = 0; column < 4; ++column)
                    rows += " " + number(precision);
                rows += "\n";
            };
            for (const auto& [evaluations, precision] : run.found)
                row(evaluations, precision);
            const double last = run.found.empty() ? HUGE_VAL : run.found.back().second;
            if (!run.found.empty() && run.found.back().first < run.evaluations)
                row(run.evaluations, last);
            runs += ", " + std::to_string(run.instance) + ":" + std::to_string(run.evaluations) + "|" +
                    number(last);
        }
        std::filesystem::create_directories((folder / name).parent_path());
        for (const char* ending : {".dat", ".tdat"})
            write(folder / (name + ending), rows);
        infos[function.id] += "funcId = " + std::to_string(function.id) +
                              ", DIM = " + std::to_string(function.dimension) +
                              ", Precision = 1.000e-08, algId = '" + algorithm + "'\n% written by rugosa\n" +
                              name + ".dat" + runs + "\n";
    }
    for (const auto& [id, text] : infos)
        write(folder / ("bbobexp_f" + std::to_string(id) + ".info"), text);
}

} // namespace ga
