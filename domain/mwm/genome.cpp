#include "domain/mwm/genome.hpp"

#include "domain/errors.hpp"
#include "domain/mwm/stored.hpp"
#include "domain/mwm/waves.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/json.hpp"
#include "ga/variation/cross.hpp"

#include <initializer_list>

namespace rough {

using nlohmann::json;

namespace {

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
    return series.A == scale.A && series.H == scale.H && series.gamma == scale.gamma && series.lambda == scale.lambda &&
           std::ranges::count(series.chromosomes, scale.chromosomes[0].n, &Chromosome::n) == 0;
}

Genome genome_of(const std::vector<Series>& scales) {
    Genome genome;
    for (const Series& scale : scales) {
        const auto home =
            std::ranges::find_if(genome.series, [&](const Series& series) { return takes(series, scale); });
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

constexpr std::size_t max_genome_bytes = 16'000'000; // half a million phases in full digits

std::string shown(const json& value) {
    std::string text = json_text(value, true);
    return text.size() > 40 ? text.substr(0, 37) + "..." : text;
}

void expect_object(const json& value, const std::string& where, std::initializer_list<const char*> keys) {
    if (!value.is_object()) refuse(where, ": ", shown(value), " is not an object; write { ... }");
    for (const auto& [key, item] : value.items())
        if (std::find(keys.begin(), keys.end(), key) == keys.end())
            refuse(where, ": unknown key \"", key, "\"; remove it");
    for (const char* key : keys)
        if (!value.contains(key)) refuse(where, ": key \"", key, "\" is missing; add it");
}

void expect_number(const json& value, const char* name, const std::string& where) {
    if (!value.is_number()) refuse(where, ": ", name, " is ", shown(value), ", which is not a number; give one");
}

const json& array(const json& object, const char* key, const std::string& where) {
    const json& value = object.at(key);
    if (!value.is_array()) refuse(where, ": ", key, " is ", shown(value), ", which is not an array; write [ ... ]");
    return value;
}

void expect_chromosome(const json& value, const std::string& where) {
    expect_object(value, where, {"n", "phases"});
    const json& n = value.at("n");
    if (!n.is_number_integer() || n.get<double>() < 1 || n.get<double>() > 1e6)
        refuse(where, ": n is ", shown(n), ", which is out of range (a whole number from 1 to 1e6)");
    for (const json& phase : array(value, "phases", where)) expect_number(phase, "a phase (rad)", where);
}

} // namespace

void validate(const Genome& genome, const std::string& where) {
    const auto expect = [](bool good, const std::string& place, const char* what, double value, const char* expected) {
        if (!good) refuse(place, ": ", what, " is ", value, "; use a finite number", expected);
    };
    expect(std::isfinite(genome.scale) && genome.scale != 0, where, "scale", genome.scale, " other than 0");
    if (genome.series.empty()) refuse(where, ": no series; give at least one");
    for (std::size_t s = 0; s < genome.series.size(); ++s) {
        const auto& series = genome.series[s];
        const std::string place = where + ": series " + std::to_string(s + 1);
        expect(std::isfinite(series.A) && series.A != 0, place, "A", series.A, " other than 0");
        expect(std::isfinite(series.H), place, "H", series.H, "");
        expect(std::isfinite(series.gamma) && series.gamma > 1, place, "gamma", series.gamma, " greater than 1");
        expect(std::isfinite(series.lambda) && series.lambda > 0, place, "lambda", series.lambda,
               " greater than 0 (mm)");
        if (series.chromosomes.empty()) refuse(place, ": no chromosomes; give at least one");
        std::set<int> seen;
        for (const auto& chromosome : series.chromosomes) {
            if (chromosome.n < 1) refuse(place, ": a chromosome has n = ", chromosome.n, "; use n >= 1");
            if (!seen.insert(chromosome.n).second)
                refuse(place, ": chromosome n = ", chromosome.n, " is given twice; give each n once");
            if (chromosome.phases.empty())
                refuse(place, ": chromosome n = ", chromosome.n, " has no phases; give at least one");
            for (double phase : chromosome.phases) expect(std::isfinite(phase), place, "a phase", phase, " (rad)");
        }
    }
}

Genome folded(Genome genome) {
    for (auto& series : genome.series) series.A *= genome.scale;
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
    std::sort(all.begin(), all.end(),
              [&](const Series& a, const Series& b) { return std::pair(form(a), a.A) < std::pair(form(b), b.A); });
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
    const auto append = [&](auto number) { key.append(reinterpret_cast<const char*>(&number), sizeof number); };
    for (const auto& series : genome.series) {
        for (double gene : {series.A, series.H, series.gamma, series.lambda}) append(gene);
        append(series.chromosomes.size());
        for (const auto& chromosome : series.chromosomes) {
            append(chromosome.n);
            append(chromosome.phases.size());
            std::ranges::for_each(chromosome.phases, append);
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

void cross_points(Genome& a, Genome& b, std::size_t cuts, ga::Stream& stream) {
    crossed(a, b, [&](auto& left, auto& right) { ga::exchange_at_points(left, right, cuts, stream); });
}

void cross_uniform(Genome& a, Genome& b, ga::Stream& stream) {
    crossed(a, b, [&](auto& left, auto& right) {
        for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i)
            if (stream.chance(0.5)) std::swap(left[i], right[i]);
    });
}

json genome_to_json(const Genome& genome) {
    json value = folded(genome);
    value.erase("scale");
    return value;
}

Genome genome_from_json(const json& value, const std::string& where) {
    expect_object(value, where, {"series"});
    Genome genome;
    for (const json& item : array(value, "series", where)) {
        const std::string place = where + ": series " + std::to_string(genome.series.size() + 1);
        expect_object(item, place, {"A", "H", "gamma", "lambda", "chromosomes"});
        for (const char* gene : {"A", "H", "gamma", "lambda"}) expect_number(item.at(gene), gene, place);
        int count = 0;
        for (const json& chromosome : array(item, "chromosomes", place))
            expect_chromosome(chromosome, place + ", chromosome " + std::to_string(++count));
        genome.series.push_back(item.get<Series>());
    }
    validate(genome, where);
    return genome;
}

GenomeFile read_genome_file(const std::filesystem::path& file) {
    const std::string text = read_whole(file, max_genome_bytes);
    if (const auto first = text.find_first_not_of(" \t\r\n");
        first != text.npos && text[first] != '{' && text[first] != '[')
        refuse(file.string(), ", line 1: not a genome, which is a JSON object; give a measurement as a profile "
                              "or as a surface");
    json value = parsed_json(text, file.string());
    GenomeFile read;
    if (value.is_object() && value.contains("length_mm")) {
        expect_number(value.at("length_mm"), "length_mm", file.string());
        read.length = value.at("length_mm").get<double>();
        if (!(read.length > 0 && std::isfinite(read.length)))
            refuse(file.string(), ": length_mm is ", shown(value.at("length_mm")),
                   "; use a finite number greater than 0");
        value.erase("length_mm");
    }
    read.genome = genome_from_json(value, file.string());
    return read;
}

Genome read_genome(const std::filesystem::path& file) { return read_genome_file(file).genome; }

std::string genome_file_text(const Genome& genome, double length) {
    json file = genome_to_json(genome);
    if (length != standard_length) file["length_mm"] = length;
    return json_text(file) + "\n";
}

} // namespace rough
