#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace rough {

/// Writes a file completely or not at all. A temporary file in the same folder is flushed to the disk and
/// then renamed to `path`. So readers see the old or the new content. A symbolic link there is replaced, not
/// followed, and the mode of a replaced file is kept. Devices and pipes are written to directly. The folder
/// must exist. Throws InputError with one line if the file cannot be written; no temporary file is left.
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// The end of a chain of symbolic links, which need not exist. A file that the user named is written there.
/// Throws InputError on a loop of links.
std::filesystem::path without_links(std::filesystem::path path);

/// Default maximum size of a file. A larger file is refused before it is read.
constexpr std::size_t max_file_bytes = 400'000'000;

/// The bytes of a file, at most `max`. A pipe, of at most 40 MB, is read once; later calls return the same
/// bytes. Throws InputError with one line on a device, and if the file cannot be read or is larger.
/// `expect` is given the first 4096 bytes; it may throw before the remaining file is read.
std::string read_whole(const std::filesystem::path& path, std::size_t max = max_file_bytes,
                       const std::function<void(std::string_view)>& expect = {});

} // namespace rough
