#include "domain/database/codec.hpp"

#include "domain/errors.hpp"
#include "ga/base/random.hpp"

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

[[noreturn]] void refuse_changed(const std::string& problem) {
    throw InputError("genome database: " + problem + "; give a file that only this program has written");
}

} // namespace

std::uint64_t checksum(std::string_view bytes, std::uint64_t seed) {
    std::uint64_t sum = ga::mix(seed + bytes.size());
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(sum)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at, std::min(sizeof word, bytes.size() - at));
        sum = ga::mix(sum ^ word) + ga::golden_step;
    }
    return sum;
}

std::vector<double> unpacked(std::string_view bytes) {
    if (bytes.size() % sizeof(double) != 0)
        refuse_changed("numbers are cut short");
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
            refuse_changed("a genome ends early");
        return numbers[place++];
    };
    const auto count = [&](double lowest) {
        constexpr double highest = 1e6; // as in a genome file
        const double value = next();
        if (!(value >= lowest && value <= highest && value == std::floor(value)))
            refuse_changed("a genome of " + std::to_string(value) + " parts");
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
