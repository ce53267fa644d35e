#pragma once

#include "domain/database/store.hpp"

#include <vector>

namespace rough {

/// Puts the genomes of several databases of one set-up, law and version into a new file, which appears under
/// its name when it is whole; one that is there is replaced. Of a genome in several of them the first copy is
/// taken. Gives how many genomes it holds. Throws InputError on databases that differ, on a genome that is
/// not its law's, and on one that was altered.
std::uint64_t merge(const std::vector<std::filesystem::path>& files, const std::filesystem::path& out);

} // namespace rough
