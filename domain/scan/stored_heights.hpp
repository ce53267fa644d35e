#pragma once

#include "domain/scan/height_map.hpp"
#include "domain/text/bytes.hpp"

namespace rough {

/// A map has no more points that anything reads.
constexpr std::int64_t most_points = 50'000'000;

/// Numbers that stand row after row from a place of some bytes on, of a type as in missing_mark(); NaN for
/// `missing` and for numbers that are not finite. Throws InputError, before anything is allocated, where
/// there are none, too many, or fewer bytes than they take.
std::vector<double> stored_heights(std::string_view bytes, std::size_t at, std::int64_t columns,
                                   std::int64_t rows, int type, double missing, const std::string& file);

} // namespace rough
