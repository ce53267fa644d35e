#pragma once

#include "domain/mwm/genome.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rough {

/// Doubles as bytes, as this machine holds them (little endian), and back.
std::string packed(const std::vector<double>& values);
/// Undoes packed(). Throws InputError where `bytes` are no whole doubles.
std::vector<double> unpacked(std::string_view bytes);

/// 64 bits that change with every single changed byte of `bytes`, and with nearly every other change.
std::uint64_t checksum(std::string_view bytes, std::uint64_t seed = 0);

/// Genomes one after another as doubles: series, and for each A, H, gamma, lambda, chromosomes, and for each
/// of those n, ridges and the phases. The scale is folded into the amplitudes.
std::vector<double> numbers(const std::vector<Genome>& genomes);
/// Undoes numbers(). Throws InputError where they end inside a genome or are none.
std::vector<Genome> genomes_from(const std::vector<double>& numbers);

} // namespace rough
