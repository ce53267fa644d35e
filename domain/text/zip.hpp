#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rough {

/// A zip archive in memory, to be read.
class Zip {
  public:
    /// `bytes` must outlive it; `file` begins the messages. Throws InputError on what is no zip archive.
    Zip(const std::string& bytes, std::string file);
    ~Zip();
    Zip(const Zip&) = delete;
    Zip& operator=(const Zip&) = delete;

    /// Hands an entry's bytes to `take`, piece by piece; false if there is no such entry. Throws InputError
    /// on an entry of more than `max_size` bytes, before it is unpacked, and on a damaged one.
    bool read(const std::string& name, std::size_t max_size,
              const std::function<void(std::string_view)>& take) const;
    /// An entry's bytes, or nothing, as read().
    std::optional<std::string> entry(const std::string& name, std::size_t max_size) const;

  private:
    struct Archive;
    std::unique_ptr<Archive> archive_;
    std::string file_;
};

/// The bytes of a zip archive of these entries, name and content each, dated 1980-01-01 so that the same
/// entries give the same bytes.
std::string zipped(const std::vector<std::pair<std::string, std::string>>& entries);

} // namespace rough
