#include "domain/database/codec.hpp"

#include "domain/errors.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace rough {

static_assert(std::endian::native == std::endian::little, "genome databases hold little-endian numbers");

std::string packed(const std::vector<double>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
}

namespace {

constexpr const char* unchanged = ", expected a file that nothing else has changed";

/// A bijection of words: SplitMix64's last step (Steele, Lea & Flood 2014).
std::uint64_t mixed(std::uint64_t word) {
    word = (word ^ (word >> 30)) * 0xBF58476D1CE4E5B9ULL;
    word = (word ^ (word >> 27)) * 0x94D049BB133111EBULL;
    return word ^ (word >> 31);
}

} // namespace

std::uint64_t checksum(std::string_view bytes, std::uint64_t seed) {
    std::uint64_t sum = mixed(seed + bytes.size());
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(sum)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at, std::min(sizeof word, bytes.size() - at));
        sum = mixed(sum ^ word) + 0x9E3779B97F4A7C15ULL;
    }
    return sum;
}

std::vector<double> unpacked(std::string_view bytes) {
    if (bytes.size() % sizeof(double) != 0)
        throw InputError(std::string("genome database: numbers are cut short") + unchanged);
    std::vector<double> values(bytes.size() / sizeof(double));
    if (!values.empty())
        std::memcpy(values.data(), bytes.data(), values.size() * sizeof(double));
    return values;
}

std::vector<double> numbers(const std::vector<Genome>& genomes) {
    std::vector<double> values;
    for (const Genome& scaled : genomes) {
        const Genome genome = folded(scaled);
        values.push_back(static_cast<double>(genome.series.size()));
        for (const Series& series : genome.series) {
            for (const double gene : {series.A, series.H, series.gamma, series.lambda})
                values.push_back(gene);
            values.push_back(static_cast<double>(series.chromosomes.size()));
            for (const Chromosome& chromosome : series.chromosomes) {
                values.push_back(chromosome.n);
                values.push_back(static_cast<double>(chromosome.phases.size()));
                values.insert(values.end(), chromosome.phases.begin(), chromosome.phases.end());
            }
        }
    }
    return values;
}

std::vector<Genome> genomes_from(const std::vector<double>& numbers) {
    std::size_t place = 0;
    const auto next = [&] {
        if (place == numbers.size())
            throw InputError(std::string("genome database: a genome ends early") + unchanged);
        return numbers[place++];
    };
    const auto count = [&](double least) {
        constexpr double most = 1e6; // as in a genome file
        const double value = next();
        if (!(value >= least && value <= most && value == std::floor(value)))
            throw InputError(std::string("genome database: a genome of ") + std::to_string(value) + " parts" +
                             unchanged);
        return static_cast<int>(value);
    };
    std::vector<Genome> genomes;
    while (place < numbers.size()) {
        Genome genome;
        for (int series_left = count(0); series_left > 0; --series_left) {
            Series series;
            series.A = next(), series.H = next(), series.gamma = next(), series.lambda = next();
            for (int left = count(0); left > 0; --left) {
                Chromosome chromosome{count(1), {}};
                for (int ridges = count(0); ridges > 0; --ridges)
                    chromosome.phases.push_back(next());
                series.chromosomes.push_back(std::move(chromosome));
            }
            genome.series.push_back(std::move(series));
        }
        genomes.push_back(std::move(genome));
    }
    return genomes;
}

} // namespace rough
