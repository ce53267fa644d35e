#pragma once

#include "domain/mwm/genome.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rough {

/// Doubles as bytes, little endian.
std::string packed(const std::vector<double>& values);
/// Undoes packed(). Throws InputError if `bytes` end inside a double.
std::vector<double> unpacked(std::string_view bytes);

/// 64 bits that change with every single changed byte of `bytes`, and with nearly every other change.
std::uint64_t checksum(std::string_view bytes, std::uint64_t seed = 0);

/// Genomes one after another as doubles: series, and for each A, H, gamma, lambda, chromosomes, and for each
/// of those n, ridges and the phases. The scale is folded into the amplitudes.
std::vector<double> numbers(const std::vector<Genome>& genomes);
/// Inverse of numbers(). Throws InputError if the numbers end before a genome is complete, or contain an
/// impossible count.
std::vector<Genome> genomes_from(const std::vector<double>& numbers);

} // namespace rough
