#pragma once

#include "domain/mwm/genome.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace rough {

/// {"series":[{"A":1,"H":0.8,"gamma":1.5,"lambda":0.84942,"chromosomes":[{"n":1,"phases":[0.3]}]}]}, lengths
/// in mm; the scale is folded into the amplitudes.
nlohmann::json genome_to_json(const Genome& genome);

/// The inverse, validated. Throws InputError that begins with `where` on a missing or unknown key or a bad
/// value.
Genome genome_from_json(const nlohmann::json& json, const std::string& where);

/// Reads and validates a genome file. Throws InputError that begins with the file's name.
Genome read_genome(const std::filesystem::path& file);

} // namespace rough
