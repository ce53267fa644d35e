#include "domain/text/atomic_file.hpp"

#include "domain/errors.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace rough {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const char* what, int error) {
    throw InputError(path.string() + ": cannot be " + what + " (" + std::strerror(error) + ")");
}

/// An open file that is closed when it is left.
class Descriptor {
  public:
    explicit Descriptor(int file) : file_(file) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    int get() const { return file_; }
    int close() { return file_ < 0 ? 0 : ::close(std::exchange(file_, -1)); }

  private:
    int file_;
};

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

/// The mode of the file that is there, else what the user's mask leaves of a new one's.
mode_t mode_for(const std::filesystem::path& target) {
    struct stat there {};
    if (lstat(target.c_str(), &there) == 0 && S_ISREG(there.st_mode))
        return there.st_mode & 07777;
    const mode_t mask = umask(0);
    umask(mask);
    return static_cast<mode_t>(0666 & ~mask);
}

/// A rename lasts through a loss of power when the folder is on the disk too; where a file system cannot do
/// that, the rename has to do.
void flush_folder(const std::filesystem::path& folder) {
    const Descriptor open_folder(
        open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (open_folder.get() >= 0)
        fsync(open_folder.get());
}

/// A temporary file that is removed unless it was renamed to its final name.
class Draft {
  public:
    /// mkostemp opens exclusively: neither a file nor a link that is there is ever opened.
    explicit Draft(const std::filesystem::path& target)
        : name_(target.string() + ".XXXXXX"), file_(mkostemp(name_.data(), O_CLOEXEC)) {
        if (file_.get() < 0)
            refuse(target, "written", errno);
    }
    ~Draft() {
        if (!kept_)
            unlink(name_.c_str());
    }
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;

    void keep_as(const std::filesystem::path& target, std::string_view content) {
        write_all(file_.get(), content, target);
        if (fchmod(file_.get(), mode_for(target)) != 0 || fsync(file_.get()) != 0 || file_.close() != 0 ||
            std::rename(name_.c_str(), target.c_str()) != 0)
            refuse(target, "written", errno);
        kept_ = true;
        flush_folder(target.parent_path());
    }

  private:
    std::string name_;
    Descriptor file_;
    bool kept_ = false;
};

void write_through(const std::filesystem::path& device, std::string_view content) {
    const Descriptor file(open(device.c_str(), O_WRONLY | O_CLOEXEC));
    if (file.get() < 0)
        refuse(device, "written", errno);
    write_all(file.get(), content, device);
}

constexpr std::size_t first_bytes = 4096;

[[noreturn]] void refuse_size(const std::filesystem::path& path, std::size_t most) {
    throw InputError(path.string() + ": more than " + std::to_string(most) +
                     " bytes, expected a file of that size at most");
}

} // namespace

std::filesystem::path without_links(std::filesystem::path path) {
    constexpr int most_links = 40; // as the kernel
    std::error_code none;
    for (int k = 0; std::filesystem::is_symlink(path, none); ++k) {
        if (k == most_links)
            refuse(path, "written", ELOOP);
        const auto next = std::filesystem::read_symlink(path, none);
        path = path.parent_path() / next;
    }
    return path;
}

void write_atomically(const std::filesystem::path& path, std::string_view content) {
    struct stat there {};
    if (stat(path.c_str(), &there) == 0 && !S_ISREG(there.st_mode) && !S_ISDIR(there.st_mode))
        return write_through(path, content);
    Draft(path).keep_as(path, content);
}

std::string read_whole(const std::filesystem::path& path, std::size_t most,
                       const std::function<void(std::string_view)>& expect) {
    const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
    struct stat there {};
    if (file.get() < 0 || fstat(file.get(), &there) != 0)
        refuse(path, "read", errno);
    if (S_ISDIR(there.st_mode))
        throw InputError(path.string() + ": cannot be read (a folder, expected a file)");
    if (there.st_size > 0 && static_cast<std::size_t>(there.st_size) > most)
        refuse_size(path, most);
    std::string bytes;
    // Files of /proc and pipes do not say how much they hold.
    const std::size_t told = static_cast<std::size_t>(std::max<off_t>(there.st_size, 0)) + 1;
    std::size_t wanted = told == 1 ? first_bytes : std::min(told, first_bytes);
    for (std::size_t held = 0;; wanted = std::max({told, 2 * held, std::size_t{65536}})) {
        bytes.resize(std::min(wanted, most + 1));
        ssize_t got = 0;
        while (held < bytes.size() &&
               ((got = ::read(file.get(), bytes.data() + held, bytes.size() - held)) > 0 ||
                (got < 0 && errno == EINTR)))
            held += static_cast<std::size_t>(std::max<ssize_t>(got, 0));
        if (got < 0)
            refuse(path, "read", errno);
        if (held > most)
            refuse_size(path, most);
        if (expect && wanted <= first_bytes)
            expect(bytes.substr(0, held));
        if (held < bytes.size()) {
            bytes.resize(held);
            return bytes;
        }
    }
}

} // namespace rough
