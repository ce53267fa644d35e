#pragma once

#include "ga/base/held_folder.hpp"
#include "ga/base/number.hpp"
#include "ga/observers/progress.hpp"

#include <fstream>

namespace ga {

/// A table with one row per stage of a run. It is written to FILE.part, which `close` renames, so that FILE
/// is always complete. If it cannot be written, the run continues. With `checkpoints.keep("log",
/// log.position)` a resumed run continues after the row of the checkpoint.
class Log {
  public:
    /// A log in `file`, which appears when the log is closed.
    explicit Log(std::filesystem::path file)
        : name_(std::move(file)), file_(held_path(name_)), part_(file_.string() + ".part") {}
    Log(const Log&) = delete;

    std::uint64_t position = 0; ///< bytes of the table so far
    std::string trouble;        ///< why the table is incomplete; empty if it is complete

    /// The observer for `run`. The problem and this log must outlive the run.
    template <Problem P>
    Observer<typename P::Genome> observer(const P& problem) {
        return [this, &problem](const Event<typename P::Genome>& event) {
            append(event.path, event.generation, summary(problem, event.population), event.counters, event.seconds);
        };
    }

    /// Completes the table. If the run had already ended before it was resumed, its table is complete.
    void close();

  private:
    std::string cannot_be_written() const;
    void append(const std::string& path, const std::vector<std::size_t>& generation, const Summary& of,
                const Counters& counters, double seconds);
    void append(const std::string& text);
    /// Cuts the table after the row of the checkpoint. An interrupted run has already renamed it.
    void take_up();
    void put(const std::string& text);

    std::filesystem::path name_, file_, part_;
    std::ofstream stream_;
};

} // namespace ga
