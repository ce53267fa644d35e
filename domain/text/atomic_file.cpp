#include "domain/text/atomic_file.hpp"

#include "domain/errors.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <memory>
#include <sstream>
#include <sys/stat.h>
#include <unistd.h>

namespace rough {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const char* what, int error) {
    throw InputError(path.string() + ": cannot be " + what + " (" + std::strerror(error) + ")");
}

void write_all(int file, std::string_view content, const std::filesystem::path& target) {
    while (!content.empty()) {
        const ssize_t written = ::write(file, content.data(), content.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            refuse(target, "written", errno);
        content.remove_prefix(static_cast<std::size_t>(written));
    }
}

/// A temporary file that is removed unless it was renamed to its final name.
class Draft {
  public:
    explicit Draft(const std::filesystem::path& target) : name(target.string() + ".XXXXXX") {
        file = mkstemp(name.data());
        if (file < 0)
            refuse(target, "written", errno);
    }
    ~Draft() {
        if (file >= 0)
            close(file);
        if (!kept)
            unlink(name.c_str());
    }
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;

    void write(std::string_view content, const std::filesystem::path& target) const {
        write_all(file, content, target);
    }

    void keep_as(const std::filesystem::path& target) {
        // mkstemp makes files that only the owner reads; give back what the user's mask allows.
        const mode_t mask = umask(0);
        umask(mask);
        if (fchmod(file, static_cast<mode_t>(0666 & ~mask)) != 0 || fsync(file) != 0 || close_file() != 0 ||
            std::rename(name.c_str(), target.c_str()) != 0)
            refuse(target, "written", errno);
        kept = true;
    }

  private:
    int close_file() {
        const int closed = close(file);
        file = -1;
        return closed;
    }

    std::string name;
    int file = -1;
    bool kept = false;
};

void write_through(const std::filesystem::path& device, std::string_view content) {
    const int file = open(device.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0)
        refuse(device, "written", errno);
    const std::unique_ptr<const int, void (*)(const int*)> guard(&file, [](const int* f) { close(*f); });
    write_all(file, content, device);
}

/// The file that a chain of links ends at, which need not exist.
std::filesystem::path without_links(std::filesystem::path path) {
    constexpr int most_links = 40; // as the kernel
    for (int k = 0; std::filesystem::is_symlink(path); ++k) {
        if (k == most_links)
            refuse(path, "written", ELOOP);
        path = path.parent_path() / std::filesystem::read_symlink(path);
    }
    return path;
}

} // namespace

void write_atomically(const std::filesystem::path& path, std::string_view content) {
    if (std::filesystem::exists(path) && !std::filesystem::is_regular_file(path) &&
        !std::filesystem::is_directory(path))
        return write_through(path, content);
    const std::filesystem::path target = without_links(path);
    Draft draft(target);
    draft.write(content, target);
    draft.keep_as(target);
}

std::string read_whole(const std::filesystem::path& path) {
    if (std::filesystem::is_directory(path))
        throw InputError(path.string() + ": cannot be read (a folder, expected a file)");
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    if (!in)
        refuse(path, "read", errno);
    std::ostringstream bytes;
    bytes << in.rdbuf();
    if (in.bad() || (bytes.fail() && in.peek() != std::ifstream::traits_type::eof()))
        refuse(path, "read", errno ? errno : EIO);
    return std::move(bytes).str();
}

} // namespace rough
