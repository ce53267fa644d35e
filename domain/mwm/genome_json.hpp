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

/// The default length of a profile, mm (the paper's).
constexpr double standard_length = 0.84942;

/// A genome file: the genome as above, and "length_mm" next to "series", the length of the profile that it
/// was made for.
struct GenomeFile {
    Genome genome;                   ///< validated
    double length = standard_length; ///< mm, > 0
};

/// Reads and validates a genome file of at most 16 MB. Throws InputError that begins with the file's name.
GenomeFile read_genome_file(const std::filesystem::path& file);
/// Reads only the genome.
Genome read_genome(const std::filesystem::path& file);

/// A genome file's text; a standard length is omitted.
std::string genome_file_text(const Genome& genome, double length);

} // namespace rough
