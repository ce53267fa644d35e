#pragma once

#include "apps/commands/commands.hpp"
#include "apps/external/solution.hpp"
#include "ga/base/budget.hpp"
#include "ga/base/stopwatch.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <sys/types.h>
#include <vector>

namespace app {

/// The words of a command, as a shell would split them and do no more: 'as it stands', "with \" and \\", and
/// \ before a letter that is to stand for itself. Throws rough::InputError on an open quote or no word.
Words split_command(const std::string& command);

/// A program that runs beside this one, reads lines and writes lines. It is in a process group of its own: a
/// Ctrl-C is not for it, and what it started ends with it. SIGPIPE must be ignored.
class Child {
  public:
    /// Starts it without a shell; its standard error goes to the descriptor `log`. Throws rough::InputError
    /// where there is no such program.
    Child(const Words& command, int log);
    /// Waits a moment for it to end by itself, as its input has, then ends it.
    ~Child();
    Child(const Child&) = delete;

    /// Writes as much of these lines as it takes now, and keeps the rest for `push`.
    void send(const std::string& lines);
    void push();                                       ///< writes on; what nobody reads is dropped
    bool is_sending() const { return !rest_.empty(); } ///< whether `push` has work left
    int to() const { return in_; }                     ///< descriptor to wait at while it is sending
    int from() const { return out_; }                  ///< descriptor to wait at for an answer
    /// The next line it has written, if a whole one is here.
    std::optional<std::string> line();
    bool is_silent() const { return silent_; } ///< whether it will write no more
    /// What it wrote after its last whole line.
    const std::string& unfinished() const { return read_; }
    /// Lets go of its input: a program that reads lines ends then.
    void close_input();
    /// Ends it and what it started, and tells how it had ended, if it had: "ended with exit code 1".
    std::string end();

  private:
    bool ended_within(double seconds);

    pid_t process_ = 0;
    int in_ = -1, out_ = -1, status_ = 0;
    bool ended_ = false, silent_ = false;
    std::string rest_, read_;
};

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
