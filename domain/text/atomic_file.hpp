#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace rough {

/// Writes a file whole or not at all: to a temporary name in the same folder, flushed to the disk with the
/// folder that names it, then renamed over `path`. Readers see the old content or the new one, never a part.
/// A link there is replaced, never followed; a file that is replaced hands on its mode; a device or a pipe is
/// written to as it is. The folder must exist. Throws InputError with one line when the place cannot be
/// written; no temporary file is left behind then.
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// The file that a chain of links ends at, which need not exist: for a place that a user named, to be written
/// through a link. Throws InputError on a loop of links.
std::filesystem::path without_links(std::filesystem::path path);

/// The most bytes that a file of one kind may have: what is larger is no such file, and is refused before
/// it is read.
constexpr std::size_t most_bytes = 400'000'000;

/// The bytes of a whole file, at most so many. Throws InputError with one line when it cannot be read or is
/// larger. `expect` sees the first 4096 bytes, and may throw, before there is room for the others.
std::string read_whole(const std::filesystem::path& path, std::size_t most = most_bytes,
                       const std::function<void(std::string_view)>& expect = {});

} // namespace rough
