#pragma once

#include <filesystem>
#include <string>
#include <vector>

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

/// Writes the runs of one algorithm in the format of COCO (Hansen et al. 2021, COCO: a platform for comparing
/// continuous optimizers in a black-box setting), which cocopp and IOHanalyzer read. There is FOLDER/bbobexp_fN.info
/// for each function, and FOLDER/data_fN/bbobexp_fN_DIMd.dat and .tdat for each dimension. Rows have no genes. Throws
/// std::filesystem::filesystem_error or UsageError if a file cannot be written.
void write_coco(const std::filesystem::path& folder, const std::string& algorithm,
                const std::vector<CocoFunction>& functions);

} // namespace ga
