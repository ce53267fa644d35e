#include "domain/database/codec.hpp"

#include "domain/errors.hpp"

#include <bit>
#include <cstring>

namespace rough {

static_assert(std::endian::native == std::endian::little, "genome databases hold little-endian numbers");

std::string packed(const std::vector<double>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
}

std::vector<double> unpacked(std::string_view bytes) {
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
            throw InputError(
                "genome database: a genome ends early, expected a file that nothing else has changed");
        return numbers[place++];
    };
    std::vector<Genome> genomes;
    while (place < numbers.size()) {
        Genome genome;
        for (double series_left = next(); series_left > 0; --series_left) {
            Series series;
            series.A = next(), series.H = next(), series.gamma = next(), series.lambda = next();
            for (double left = next(); left > 0; --left) {
                Chromosome chromosome{static_cast<int>(next()), {}};
                for (double ridges = next(); ridges > 0; --ridges)
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
