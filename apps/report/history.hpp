#pragma once

#include "apps/external/solution.hpp"
#include "ga/run/evaluator.hpp"

#include <fstream>

namespace app {

/// All evaluations of a search as a CSV file, which grows by whole rows. The columns are id (from 1, in the order of
/// the requests), generation (from 1; a slash between those of nested blocks) and level. Genes x1, x2, ... and
/// objectives f1, f2, ... follow, then the sum of the positive violations, and the reason of a failure.
class History {
  public:
    History() = default; ///< no file
    /// A file that write() makes or replaces. If `resumed`, it may be one that an earlier process began.
    History(std::filesystem::path file, bool resumed) : file_(std::move(file)), resumed_(resumed) {}

    /// Adds an evaluation of genes (a JSON array). Pending ones do not count.
    void add(std::span<const std::size_t> generation, const std::string& level, const std::string& genes,
             const ga::Evaluation<Evaluation>& answer);
    /// From now on the number of objectives is known, and rows are written. Removes the first `again` added rows,
    /// which will be added again. A resumed search removes all of them.
    void begin(std::size_t objectives, std::size_t again = 0);
    /// Appends the rows that were added. First it removes rows that the checkpoint of an earlier process does not
    /// count.
    void write();

    bool is_kept() const { return !file_.empty(); } ///< whether there is a file

    /// The numbers of rows and bytes in the file. A checkpoint has to keep them.
    std::array<std::uint64_t, 2> written = {};

  private:
    void open();

    std::filesystem::path file_;
    bool resumed_ = false;
    std::size_t objectives_ = 0;
    std::string header_;
    std::vector<nlohmann::json> before_, added_; ///< rows from before begin(), and after it
    std::ofstream out_;
};

/// An evaluator whose answers go to a history, too.
template <class P>
class WithHistory : public ga::Evaluator<P> {
  public:
    WithHistory(ga::Evaluator<P>& by, History& history) : by_(by), history_(history) {}

    void outcomes(const P& problem, std::span<ga::EvaluationCall<P>> calls, const ga::Watch& watch) override {
        by_.outcomes(problem, calls, watch);
        if (!history_.is_kept()) return;
        for (const auto& call : calls)
            history_.add(call.generation, problem.name_of(call.level), problem.text_of(*call.genome), *call.answer);
        history_.write();
    }
    int threads() const override { return by_.threads(); }

  private:
    ga::Evaluator<P>& by_;
    History& history_;
};

} // namespace app
