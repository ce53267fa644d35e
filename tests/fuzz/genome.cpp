#include "domain/mwm/genome.hpp"

#include "tests/fuzz/reader.hpp"

FUZZ(genome) { rough::read_genome_file(fuzz::as_file(bytes)); }
