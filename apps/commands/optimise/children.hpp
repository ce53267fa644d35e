#pragma once

#include "apps/commands/optimise/child.hpp"
#include "apps/external/solution.hpp"
#include "ga/base/budget.hpp"
#include "ga/base/stopwatch.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace app {

/// Copies of one program that evaluate genomes: each takes the next when it is free. They are started when
/// they are needed, and are assumed to answer the same genome alike.
class Children {
  public:
    /// @param command  the program, split by split_command
    /// @param count    how many at most run beside each other
    /// @param seconds  that one evaluation may take
    /// @param log      where what they say on standard error goes; goes itself when it stayed empty
    Children(const std::string& command, int count, double seconds, std::filesystem::path log);
    ~Children();
    Children(const Children&) = delete;

    /// The answers to genomes, given as JSON arrays; none where the watch expired first or there was trouble.
    std::vector<std::optional<Answer>> ask(std::span<const std::string> genes, const ga::Watch& watch);
    /// What went wrong, in a line; nothing is asked any more then. Empty while all is well.
    const std::string& trouble() const { return trouble_; }
    /// Of every answer; 0 before the first one.
    std::size_t objectives() const { return first_.answer.objectives.size(); }
    int count() const { return static_cast<int>(children_.size()); }

    /// Every answer is taken into it.
    BestKnown record;

  private:
    struct Worker {
        std::unique_ptr<Child> child = {};
        std::size_t call = 0; ///< place among the genomes that are asked for
        long id = 0;          ///< of the call that it works on, 0 for none
        ga::Stopwatch since = {};
    };
    void begin(Worker& worker, std::size_t call, const std::string& genes);
    /// The answer, if it has come.
    std::optional<Answer> hear(Worker& worker, const std::string& genes);
    std::optional<Answer> read(const std::string& line, long id, std::string& fault) const;
    void wait() const;
    void give_up(const std::string& message);
    std::string log_end() const;

    std::string text_;
    Words command_;
    double seconds_;
    std::filesystem::path log_file_;
    int log_;
    long asked_ = 0;
    std::vector<Worker> children_;
    Solution first_;
    std::string trouble_;
};

} // namespace app
