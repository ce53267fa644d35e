#pragma once

#include "apps/commands/commands.hpp"

#include <optional>
#include <string>
#include <sys/types.h>

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

} // namespace app
