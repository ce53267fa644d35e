#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace rough {

/// Writes a file whole or not at all: to a temporary name in the same folder, flushed to the disk, then
/// renamed over `path`, or over the file that a link there names. Readers see the old content or the new one,
/// never a part. A device or a pipe is written to as it is. The folder must exist. Throws InputError with one
/// line when the place cannot be written; no temporary file is left behind then.
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// The bytes of a whole file. Throws InputError with one line when it cannot be read.
std::string read_whole(const std::filesystem::path& path);

} // namespace rough
