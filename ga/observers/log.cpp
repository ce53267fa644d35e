#include "ga/observers/log.hpp"

namespace ga {

void Log::close() {
    if (position == 0) append("");
    stream_.close();
    std::error_code error;
    if (trouble.empty() && std::filesystem::exists(part_, error)) std::filesystem::rename(part_, file_, error);
    if (trouble.empty() && (error || !std::filesystem::exists(file_, error))) trouble = cannot_be_written();
}

std::string Log::cannot_be_written() const {
    return "log '" + name_.string() + "' cannot be written; the run continued without it";
}

void Log::append(const std::string& text) {
    if (!trouble.empty()) return;
    const std::uint64_t whole = position;
    if (!stream_.is_open()) {
        if (position > 0) take_up();
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

void Log::take_up() {
    std::error_code error;
    if (!std::filesystem::exists(part_)) std::filesystem::rename(file_, part_, error);
    if (!error && std::filesystem::file_size(part_, error) < position)
        error = std::make_error_code(std::errc::invalid_seek);
    if (!error) std::filesystem::resize_file(part_, position, error);
    if (error)
        throw UsageError("log '" + name_.string() + "' cannot be continued (" + error.message() +
                         "); use the one that was written with the checkpoint");
}

void Log::put(const std::string& text) {
    stream_ << text;
    position += text.size();
}

void Log::append(const std::string& path, const std::vector<std::size_t>& generations, const Summary& of,
                 const Counters& counters, double seconds) {
    const auto cell = [](const std::optional<double>& value) { return value ? number(*value) : std::string(); };
    std::string generation;
    for (const std::size_t each : generations) generation += (generation.empty() ? "" : ".") + std::to_string(each);
    std::string row = path + "," + generation;
    for (const std::string& text :
         {std::to_string(of.individuals), cell(of.best), cell(of.median), number(of.diversity),
          std::to_string(counters.requested), std::to_string(counters.evaluations), std::to_string(counters.gradients),
          std::to_string(counters.failures), number(counters.price), number(seconds)})
        row += "," + text;
    append(row + "\n");
}

} // namespace ga
