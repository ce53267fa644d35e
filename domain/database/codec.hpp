#pragma once

#include "domain/mwm/genome.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rough {

/// Doubles as bytes, as this machine holds them (little endian), and back.
std::string packed(const std::vector<double>& values);
/// Undoes packed(); `bytes` holds whole doubles.
std::vector<double> unpacked(std::string_view bytes);

/// Genomes one after another as doubles: series, and for each A, H, gamma, lambda, chromosomes, and for each
/// of those n, ridges and the phases. The scale is folded into the amplitudes.
std::vector<double> numbers(const std::vector<Genome>& genomes);
/// Undoes numbers(). Throws InputError where they end inside a genome.
std::vector<Genome> genomes_from(const std::vector<double>& numbers);

} // namespace rough
