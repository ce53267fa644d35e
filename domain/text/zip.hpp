#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

struct zip;

namespace rough {

/// Reads a zip archive in memory.
class Zip {
  public:
    /// `bytes` must outlive the archive; `file` begins the messages. Throws InputError on a damaged archive.
    Zip(const std::string& bytes, std::string file);

    /// An entry's bytes, or nothing if it does not exist. Throws InputError if the entry is damaged. Also
    /// throws, before unpacking, if the entry has more than `max_size` bytes, or more than the larger of
    /// 40 MB and 20 times the archive.
    std::optional<std::string> entry(const std::string& name, std::size_t max_size) const;

    /// The folder of an entry, with a slash at its end: "" if the entry is at the top or does not exist.
    std::string folder_of(const std::string& name) const;

  private:
    std::unique_ptr<zip, void (*)(zip*)> archive_;
    std::string file_;
    std::size_t max_unpacked_;
};

/// The bytes of a zip archive of entries (name, content), dated 1980-01-01: equal entries give equal bytes.
std::string zipped(const std::vector<std::pair<std::string, std::string>>& entries);

} // namespace rough
