#include "domain/text/atomic_file.hpp"

#include "domain/errors.hpp"
#include "ga/base/held_folder.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <map>
#include <mutex>
#include <sys/stat.h>
#include <sys/sysmacros.h>

namespace rough {
namespace {

[[noreturn]] void refuse_path(const std::filesystem::path& path, const char* what, int error) {
    throw InputError(path.string() + ": cannot be " + what + " (" + std::strerror(error) + "); check the path");
}

/// An open file, closed at the end of its scope.
class Descriptor {
  public:
    /// Throws InputError if the file is not open: `path` cannot be `what` ("read").
    Descriptor(int file, const std::filesystem::path& path, const char* what) : file_(file) {
        if (file_ < 0) refuse_path(path, what, errno);
    }
    ~Descriptor() { ::close(file_); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const { return file_; }

  private:
    int file_;
};

void write_all(int file, std::string_view content, const std::filesystem::path& target) {
    while (!content.empty()) {
        const ssize_t written = ::write(file, content.data(), content.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) refuse_path(target, "written", errno);
        content.remove_prefix(static_cast<std::size_t>(written));
    }
}

/// The mode of an existing file, or that of a new file under the user's mask.
mode_t mode_for(const std::filesystem::path& target) {
    struct stat there {};
    if (lstat(target.c_str(), &there) == 0 && S_ISREG(there.st_mode)) return there.st_mode & 07777;
    const mode_t mask = umask(0);
    umask(mask);
    return static_cast<mode_t>(0666 & ~mask);
}

constexpr std::size_t first_bytes = 4096, max_pipe_bytes = 40'000'000;

[[noreturn]] void refuse_size(const std::filesystem::path& path, std::size_t max) {
    throw InputError(path.string() + ": has more than " + std::to_string(max) + " bytes; give a smaller file");
}

/// The bytes of an open file that `there` describes.
std::string read_open(const Descriptor& file, const struct stat& there, const std::filesystem::path& path,
                      std::size_t max, const std::function<void(std::string_view)>& expect) {
    // Files of /proc and pipes do not state their size.
    const auto size = static_cast<std::size_t>(std::max<off_t>(there.st_size, 0));
    if (size > max) refuse_size(path, max);
    std::string bytes;
    std::size_t used = 0;
    for (std::size_t room = first_bytes;; room = std::max({size + 1, 2 * used, std::size_t{65536}})) {
        bytes.resize(std::min(room, max + 1));
        ssize_t got = 0;
        while (used < bytes.size() && ((got = ::read(file.get(), bytes.data() + used, bytes.size() - used)) > 0 ||
                                       (got < 0 && errno == EINTR)))
            used += static_cast<std::size_t>(std::max<ssize_t>(got, 0));
        if (got < 0) refuse_path(path, "read", errno);
        if (used > max) refuse_size(path, max);
        if (expect && room == first_bytes) expect(std::string_view(bytes).substr(0, used));
        if (used < bytes.size()) {
            bytes.resize(used);
            return bytes;
        }
    }
}

} // namespace

std::filesystem::path without_links(std::filesystem::path path) {
    constexpr int max_links = 40; // as in the kernel
    std::error_code none;
    for (int k = 0; std::filesystem::is_symlink(path, none); ++k) {
        if (k == max_links) refuse_path(path, "written", ELOOP);
        const auto next = std::filesystem::read_symlink(path, none);
        path = path.parent_path() / next;
    }
    return path;
}

void write_atomically(const std::filesystem::path& name, std::string_view content) {
    const std::filesystem::path path = ga::held_path(name);
    struct stat there {};
    if (stat(path.c_str(), &there) == 0 && !S_ISREG(there.st_mode) && !S_ISDIR(there.st_mode)) {
        const Descriptor device(open(path.c_str(), O_WRONLY | O_CLOEXEC), name, "written");
        return write_all(device.get(), content, name);
    }
    std::string draft = path.string() + ".XXXXXX";
    // mkostemp opens exclusively: it never opens an existing file or link.
    const Descriptor file(mkostemp(draft.data(), O_CLOEXEC), name, "written");
    try {
        write_all(file.get(), content, name);
        if (fchmod(file.get(), mode_for(path)) != 0 || fsync(file.get()) != 0 ||
            std::rename(draft.c_str(), path.c_str()) != 0)
            refuse_path(name, "written", errno);
    } catch (...) {
        unlink(draft.c_str());
        throw;
    }
    // The rename survives a loss of power once the folder is on the disk. Not every file system can do that.
    const std::filesystem::path folder = path.parent_path();
    const int opened = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (opened >= 0) fsync(opened), ::close(opened);
}

std::string read_whole(const std::filesystem::path& path, std::size_t max,
                       const std::function<void(std::string_view)>& expect) {
    // A pipe can be read once. Its bytes are stored under its device and number for later calls.
    static std::map<std::pair<dev_t, ino_t>, std::string> pipes;
    static std::mutex one_at_a_time;
    const std::filesystem::path name = ga::held_path(path);
    struct stat there {};
    const auto expect_readable = [&](int failed) {
        if (failed != 0) refuse_path(path, "read", errno);
        if (S_ISDIR(there.st_mode)) throw InputError(path.string() + ": is a folder; give a file");
        if ((S_ISCHR(there.st_mode) || S_ISBLK(there.st_mode)) && there.st_rdev != makedev(1, 3)) // /dev/null
            throw InputError(path.string() + ": is a device; give a file or a pipe");
    };
    const auto content = [&](std::size_t most) {
        const Descriptor file(open(name.c_str(), O_RDONLY | O_CLOEXEC), path, "read");
        expect_readable(fstat(file.get(), &there));
        return read_open(file, there, path, most, expect);
    };
    // Opening a pipe that was read waits for another writer, so its status comes first.
    expect_readable(stat(name.c_str(), &there));
    if (!S_ISFIFO(there.st_mode)) return content(max);
    const std::lock_guard lock(one_at_a_time);
    const std::pair key(there.st_dev, there.st_ino);
    auto known = pipes.find(key);
    if (known == pipes.end()) known = pipes.emplace(key, content(std::min(max, max_pipe_bytes))).first;
    return known->second;
}

} // namespace rough
