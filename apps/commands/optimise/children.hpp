#pragma once

#include "apps/commands/commands.hpp"
#include "apps/external/solution.hpp"
#include "ga/run/evaluator.hpp"

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <sys/types.h>

namespace app {

/// The words of a command. As in a shell, quotes and \ keep blanks together; nothing is expanded. Throws
/// rough::InputError on an open quote or no word.
Words split_command(const std::string& command);

/// A program that reads lines and writes lines while this one runs. It has a separate process group. So a
/// Ctrl-C does not reach it, and the processes that it started end with it. SIGPIPE must be ignored.
class Child {
  public:
    /// Starts it without a shell; its standard error goes to the descriptor `log`. Throws rough::InputError
    /// if it cannot be started.
    Child(const Words& command, int log);
    /// Closes its input, gives it a moment to end, then ends it.
    ~Child();
    Child(const Child&) = delete;

    /// Sends a line and returns the next line that the child writes. Returns nothing if it closes its output,
    /// after `seconds`, and soon after `stops` returns true.
    std::optional<std::string> answer(const std::string& line, double seconds, const std::function<bool()>& stops);
    bool is_silent() const { return silent_; }              ///< whether it has closed its output
    const std::string& unfinished() const { return read_; } ///< the text after its last whole line
    /// Closes its input; a program that reads lines ends then.
    void close_input();
    /// Ends the child and what it started, after up to `patience` seconds to end by itself. Returns how it
    /// had ended: "ended with exit code 1".
    std::string end(double patience = 0);

  private:
    pid_t process_ = 0;
    int in_ = -1, out_ = -1;
    bool silent_ = false;
    std::string read_;
};

/// Copies of one program that evaluate genomes. A free copy takes the next genome. Copies are started when
/// they are needed. They are assumed to give the same answer for the same genome. The evaluation of a genome
/// fails if a copy reports it, answers with null or NaN, ends, or is silent for too long. A copy that ended
/// is started again. A hundred ends in a row are trouble, and so is any other answer.
class Children {
  public:
    /// @param command  the program, split by split_command.
    /// @param count    maximum number of copies.
    /// @param seconds  maximum time for one evaluation.
    /// @param log      file for what they write to standard error. It is removed if it stays empty. Beyond
    ///                 10 MB only its end is kept.
    Children(const std::string& command, int count, double seconds, std::filesystem::path log);
    ~Children();
    Children(const Children&) = delete;

    /// An answer, or why the evaluation failed; pending if the watch expired first or there was trouble.
    using Answer = ga::Evaluation<Evaluation>;
    /// A genome to evaluate.
    struct Request {
        std::string genes;      ///< as a JSON array
        std::string level = {}; ///< name of the level of evaluation; empty if there is one
        std::size_t number = 0; ///< number of the level
    };
    /// The answers for genomes. Before the number of objectives is known, answers end
    /// with the first evaluation that succeeds.
    std::vector<Answer> ask(std::span<const Request> requests, const ga::Watch& watch);
    /// The first error, in one line; empty without an error. Genomes are not sent after it.
    const std::string& trouble() const { return trouble_; }
    /// Number of objectives of each answer; 0 before the first one.
    std::size_t objectives() const { return first_ ? first_->objectives.size() : 0; }
    /// Why the first failed evaluation failed; empty if none has.
    const std::string& first_failure() const { return first_failure_; }
    int count() const { return static_cast<int>(children_.size()); }

    BestKnown record; ///< the best of all answers

  private:
    Answer answer_of(std::unique_ptr<Child>& child, const Request& wanted, const std::function<bool()>& stops);
    Answer read(const std::string& line, long id, std::string& fault) const;
    void give_up(const std::string& message);
    std::string log_tail() const;
    void bound_log();
    std::string log_end();

    std::string text_;
    Words command_;
    double seconds_;
    std::filesystem::path log_file_;
    int log_;
    std::vector<std::unique_ptr<Child>> children_;
    std::optional<Evaluation> first_;     ///< the first evaluation that succeeded
    std::map<std::string, Answer> known_; ///< answers until then, by genes
    std::string first_failure_;
    std::atomic<long> sent_ = 0, deaths_ = 0; ///< requests; ends of children since the last answer
    std::atomic<bool> has_trouble_ = false;
    std::mutex trouble_mutex_;
    std::string trouble_;
};

} // namespace app
