#include "domain/mwm/genome.hpp"

#include "domain/errors.hpp"
#include "domain/mwm/waves.hpp"
#include "ga/variation/cross.hpp"

namespace rough {

namespace {

void append_bits(std::string& key, const void* value, std::size_t size) {
    key.append(static_cast<const char*>(value), size);
}

/// Visits every gene in the order of gene_places.
template <class G, class Visit>
void for_each_gene(G& genome, Visit visit) {
    using Kind = GenePlace::Kind;
    for (std::size_t s = 0; s < genome.series.size(); ++s) {
        auto& series = genome.series[s];
        visit(series.A, GenePlace{Kind::A, s});
        visit(series.H, GenePlace{Kind::H, s});
        visit(series.gamma, GenePlace{Kind::gamma, s});
        visit(series.lambda, GenePlace{Kind::lambda, s});
        for (std::size_t c = 0; c < series.chromosomes.size(); ++c)
            for (std::size_t m = 0; m < series.chromosomes[c].phases.size(); ++m)
                visit(series.chromosomes[c].phases[m], GenePlace{Kind::phase, s, c, m});
    }
}

} // namespace

void validate(const Genome& genome, const std::string& where) {
    const auto expect = [](bool good, const std::string& place, const char* what, double value,
                           const char* expected) {
        if (!good)
            refuse(place, ": ", what, " is ", value, "; use a finite number", expected);
    };
    expect(std::isfinite(genome.scale) && genome.scale != 0, where, "scale", genome.scale, " other than 0");
    if (genome.series.empty())
        refuse(where, ": no series; give at least one");
    for (std::size_t s = 0; s < genome.series.size(); ++s) {
        const auto& series = genome.series[s];
        const std::string place = where + ": series " + std::to_string(s + 1);
        expect(std::isfinite(series.A) && series.A != 0, place, "A", series.A, " other than 0");
        expect(std::isfinite(series.H), place, "H", series.H, "");
        expect(std::isfinite(series.gamma) && series.gamma > 1, place, "gamma", series.gamma,
               " greater than 1");
        expect(std::isfinite(series.lambda) && series.lambda > 0, place, "lambda", series.lambda,
               " greater than 0 (mm)");
        if (series.chromosomes.empty())
            refuse(place, ": no chromosomes; give at least one");
        std::set<int> seen;
        for (const auto& chromosome : series.chromosomes) {
            if (chromosome.n < 1)
                refuse(place, ": a chromosome has n = ", chromosome.n, "; use n >= 1");
            if (!seen.insert(chromosome.n).second)
                refuse(place, ": chromosome n = ", chromosome.n, " is given twice; give each n once");
            if (chromosome.phases.empty())
                refuse(place, ": chromosome n = ", chromosome.n, " has no phases; give at least one");
            for (double phase : chromosome.phases)
                expect(std::isfinite(phase), place, "a phase", phase, " (rad)");
        }
    }
}

Genome folded(Genome genome) {
    for (auto& series : genome.series)
        series.A *= genome.scale;
    genome.scale = 1;
    return genome;
}

Genome sum(const Genome& left, const Genome& right) {
    const auto form = [](const Series& series) {
        std::vector<double> numbers{series.H, series.gamma, series.lambda};
        for (const auto& chromosome : series.chromosomes) {
            numbers.push_back(chromosome.n);
            numbers.insert(numbers.end(), chromosome.phases.begin(), chromosome.phases.end());
        }
        return numbers;
    };
    std::vector<Series> all = folded(left).series;
    const std::vector<Series> others = folded(right).series;
    all.insert(all.end(), others.begin(), others.end());
    std::sort(all.begin(), all.end(), [&](const Series& a, const Series& b) {
        return std::pair(form(a), a.A) < std::pair(form(b), b.A);
    });
    Genome child{1, {}};
    for (const auto& series : all)
        if (!child.series.empty() && form(child.series.back()) == form(series))
            child.series.back().A += series.A;
        else
            child.series.push_back(series);
    std::erase_if(child.series, [](const Series& series) { return series.A == 0; });
    return child;
}

std::string shape_key(const Genome& genome) {
    std::string key;
    for (const auto& series : genome.series) {
        for (double gene : {series.A, series.H, series.gamma, series.lambda})
            append_bits(key, &gene, sizeof gene);
        const auto count = series.chromosomes.size();
        append_bits(key, &count, sizeof count);
        for (const auto& chromosome : series.chromosomes) {
            append_bits(key, &chromosome.n, sizeof chromosome.n);
            const auto ridges = chromosome.phases.size();
            append_bits(key, &ridges, sizeof ridges);
            append_bits(key, chromosome.phases.data(), ridges * sizeof(double));
        }
    }
    return key;
}

std::vector<GenePlace> gene_places(const Genome& genome) {
    std::vector<GenePlace> places;
    for_each_gene(genome, [&](double, const GenePlace& place) { places.push_back(place); });
    return places;
}

std::vector<double> genes(const Genome& genome) {
    std::vector<double> values;
    for_each_gene(genome, [&](double value, const GenePlace&) { values.push_back(value); });
    return values;
}

Genome with_genes(Genome genome, const std::vector<double>& values) {
    auto next = values.begin();
    for_each_gene(genome, [&](double& gene, const GenePlace&) { gene = *next++; });
    return genome;
}

namespace {

/// The chromosomes of a genome from the longest wavelength to the shortest, each as one series.
std::vector<Series> by_wave_length(const Genome& genome) {
    std::vector<Series> scales;
    for (const Series& series : folded(genome).series)
        for (const Chromosome& chromosome : series.chromosomes)
            scales.push_back({series.A, series.H, series.gamma, series.lambda, {chromosome}});
    std::stable_sort(scales.begin(), scales.end(), [](const Series& a, const Series& b) {
        return wave_length(a, a.chromosomes[0].n) > wave_length(b, b.chromosomes[0].n);
    });
    return scales;
}

/// Whether a series has the genes of a scale, and its place n free.
bool takes(const Series& series, const Series& scale) {
    return series.A == scale.A && series.H == scale.H && series.gamma == scale.gamma &&
           series.lambda == scale.lambda &&
           std::none_of(series.chromosomes.begin(), series.chromosomes.end(),
                        [&](const Chromosome& other) { return other.n == scale.chromosomes[0].n; });
}

Genome genome_of(const std::vector<Series>& scales) {
    Genome genome;
    for (const Series& scale : scales) {
        const auto home = std::find_if(genome.series.begin(), genome.series.end(),
                                       [&](const Series& series) { return takes(series, scale); });
        if (home == genome.series.end())
            genome.series.push_back(scale);
        else
            home->chromosomes.push_back(scale.chromosomes[0]);
    }
    return genome;
}

template <class Exchange>
void crossed(Genome& a, Genome& b, Exchange exchange) {
    auto left = by_wave_length(a), right = by_wave_length(b);
    exchange(left, right);
    a = genome_of(left);
    b = genome_of(right);
}

} // namespace

void cross_points(Genome& a, Genome& b, std::size_t cuts, ga::Stream& stream) {
    crossed(a, b, [&](auto& left, auto& right) { ga::exchange_at_points(left, right, cuts, stream); });
}

void cross_uniform(Genome& a, Genome& b, ga::Stream& stream) {
    crossed(a, b, [&](auto& left, auto& right) {
        for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i)
            if (stream.chance(0.5))
                std::swap(left[i], right[i]);
    });
}

} // namespace rough
