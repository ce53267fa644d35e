#include "apps/report/gnuplot.hpp"

#include "apps/external/process.hpp"
#include "domain/errors.hpp"
#include "domain/text/atomic_file.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <sstream>
#include <string_view>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace app {

namespace {

/// A file in memory that a child may read or write as its standard stream.
class MemoryFile {
  public:
    MemoryFile() : file_(memfd_create("rugosa", MFD_CLOEXEC)) {
        if (file_ < 0)
            throw rough::InputError("pictures: the system gives no file in memory, expected one to draw in");
    }
    ~MemoryFile() { close(file_); }
    MemoryFile(const MemoryFile&) = delete;

    int get() const { return file_; }
    std::string content() const { return rough::read_whole("/proc/self/fd/" + std::to_string(file_)); }
    void fill(std::string_view content) const {
        while (!content.empty()) {
            const ssize_t written = write(file_, content.data(), content.size());
            if (written < 0 && errno != EINTR)
                throw rough::InputError("pictures: no memory to draw in");
            content.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
        }
        lseek(file_, 0, SEEK_SET);
    }

  private:
    int file_;
};

/// The last line of a complaint that is more than a mark under the place.
std::string told(const std::string& complaint) {
    std::istringstream lines(complaint);
    std::string line, last;
    while (std::getline(lines, line))
        if (line.find_first_not_of(" ^\t") != std::string::npos)
            last = line;
    return last;
}

} // namespace

Drawn run_gnuplot(const std::string& script, double seconds) {
    const MemoryFile in, out, err;
    in.fill(script);
    pid_t child = 0;
    if (start_process(child, {"gnuplot", "-d"}, in.get(), out.get(), err.get()) != 0) // no start-up file
        return {"", "it is not to be found"};
    int status = 0;
    if (!process_ended_within(seconds, child, status)) {
        kill(-child, SIGKILL);
        waitpid(child, &status, 0);
        return {"", "it was not done in time"};
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        return {"", told(err.content())};
    return {out.content(), ""};
}

std::string gnuplot_text(const std::string& text) {
    std::string result = "\"";
    for (const char c : text)
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f')
            result += ' ';
        else if (c == '"' || c == '\\')
            result += std::string("\\") + c;
        else if (c == '`')
            result += "\\140\".\""; // by its number, which a digit behind it would change
        else
            result += c;
    return result + "\"";
}

} // namespace app
