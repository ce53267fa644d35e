#pragma once

#include "ga/base/held_folder.hpp"
#include "ga/base/number.hpp"
#include "ga/observers/progress.hpp"

#include <fstream>

namespace ga {

/// A table with one row per stage of a run: path, generation, individuals, best, median, diversity, asked,
/// evaluations, gradients, failures, seconds. The table is written to FILE.part, which `close` renames, so
/// that FILE is always complete. If it cannot be written, the run continues. With `checkpoints.keep("log",
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
            const Summary of = summary(problem, event.population);
            const auto cell = [](const std::optional<double>& value) {
                return value ? number(*value) : std::string();
            };
            const Counters& counters = event.counters;
            std::string generation;
            for (const std::size_t each : event.generation)
                generation += (generation.empty() ? "" : ".") + std::to_string(each);
            std::string row = event.path + "," + generation;
            for (const std::string& text :
                 {std::to_string(of.individuals), cell(of.best), cell(of.median), number(of.diversity),
                  std::to_string(counters.requested), std::to_string(counters.evaluations),
                  std::to_string(counters.gradients), std::to_string(counters.failures),
                  number(counters.price), number(event.seconds)})
                row += "," + text;
            append(row + "\n");
        };
    }

    /// Completes the table. If the run had already ended before it was resumed, its table is complete.
    void close() {
        if (position == 0)
            append("");
        stream_.close();
        std::error_code error;
        if (trouble.empty() && std::filesystem::exists(part_, error))
            std::filesystem::rename(part_, file_, error);
        if (trouble.empty() && (error || !std::filesystem::exists(file_, error)))
            trouble = cannot_be_written();
    }

  private:
    std::string cannot_be_written() const {
        return "log '" + name_.string() + "' cannot be written; the run continued without it";
    }
    void append(const std::string& text) {
        if (!trouble.empty())
            return;
        const std::uint64_t whole = position;
        if (!stream_.is_open()) {
            if (position > 0)
                take_up();
            stream_.open(part_, position > 0 ? std::ios::app : std::ios::trunc);
            if (position == 0)
                put("path,generation,individuals,best,median,diversity,requested,evaluations,gradients,"
                    "failures,price,seconds\n");
        }
        put(text);
        stream_.flush();
        if (!stream_) {
            trouble = cannot_be_written();
            position = whole;
        }
    }
    /// Cuts the table after the row of the checkpoint. An interrupted run has already renamed it.
    void take_up() {
        std::error_code error;
        if (!std::filesystem::exists(part_))
            std::filesystem::rename(file_, part_, error);
        if (!error && std::filesystem::file_size(part_, error) < position)
            error = std::make_error_code(std::errc::invalid_seek);
        if (!error)
            std::filesystem::resize_file(part_, position, error);
        if (error)
            throw UsageError("log '" + name_.string() + "' cannot be continued (" + error.message() +
                             "); use the one that was written with the checkpoint");
    }
    void put(const std::string& text) {
        stream_ << text;
        position += text.size();
    }

    std::filesystem::path name_, file_, part_;
    std::ofstream stream_;
};

} // namespace ga
