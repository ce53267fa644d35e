#include "domain/mwm/genome_json.hpp"

#include "domain/errors.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/json.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace rough {

namespace {

using nlohmann::json;

constexpr std::size_t most_genome_bytes = 16'000'000; // half a million phases in full digits

std::string shown(const json& value) {
    std::string text = json_text(value, true);
    return text.size() > 40 ? text.substr(0, 37) + "..." : text;
}

void expect_object(const json& value, const std::string& where, std::initializer_list<const char*> keys) {
    if (!value.is_object())
        throw InputError(where + ": " + shown(value) + " given, expected an object");
    for (const auto& [key, item] : value.items())
        if (std::find(keys.begin(), keys.end(), key) == keys.end())
            throw InputError(where + ": unknown key \"" + key + "\"");
    for (const char* key : keys)
        if (!value.contains(key))
            throw InputError(where + ": key \"" + std::string(key) + "\" is missing");
}

double number(const json& object, const char* key, const std::string& where) {
    const json& value = object.at(key);
    if (!value.is_number())
        throw InputError(where + ": " + key + " is " + shown(value) + ", expected a number");
    return value.get<double>();
}

const json& array(const json& object, const char* key, const std::string& where) {
    const json& value = object.at(key);
    if (!value.is_array())
        throw InputError(where + ": " + key + " is " + shown(value) + ", expected an array");
    return value;
}

Chromosome chromosome_from(const json& value, const std::string& where) {
    expect_object(value, where, {"n", "phases"});
    Chromosome chromosome;
    const json& n = value.at("n");
    if (!n.is_number_integer() || n.get<double>() < 1 || n.get<double>() > 1e6)
        throw InputError(where + ": n is " + shown(n) + ", expected a whole number >= 1");
    chromosome.n = n.get<int>();
    for (const json& phase : array(value, "phases", where)) {
        if (!phase.is_number())
            throw InputError(where + ": a phase is " + shown(phase) + ", expected a number (rad)");
        chromosome.phases.push_back(phase.get<double>());
    }
    return chromosome;
}

} // namespace

json genome_to_json(const Genome& genome) {
    json list = json::array();
    for (const auto& series : folded(genome).series) {
        json chromosomes = json::array();
        for (const auto& chromosome : series.chromosomes)
            chromosomes.push_back({{"n", chromosome.n}, {"phases", chromosome.phases}});
        list.push_back({{"A", series.A},
                        {"H", series.H},
                        {"gamma", series.gamma},
                        {"lambda", series.lambda},
                        {"chromosomes", std::move(chromosomes)}});
    }
    return {{"series", std::move(list)}};
}

Genome genome_from_json(const json& value, const std::string& where) {
    expect_object(value, where, {"series"});
    Genome genome;
    for (const json& item : array(value, "series", where)) {
        const std::string place = where + ": series " + std::to_string(genome.series.size() + 1);
        expect_object(item, place, {"A", "H", "gamma", "lambda", "chromosomes"});
        Series series{number(item, "A", place),
                      number(item, "H", place),
                      number(item, "gamma", place),
                      number(item, "lambda", place),
                      {}};
        for (const json& chromosome : array(item, "chromosomes", place))
            series.chromosomes.push_back(chromosome_from(
                chromosome, place + ", chromosome " + std::to_string(series.chromosomes.size() + 1)));
        genome.series.push_back(std::move(series));
    }
    validate(genome, where);
    return genome;
}

GenomeFile read_genome_file(const std::filesystem::path& file) {
    json value = parsed_json(read_whole(file, most_genome_bytes), file.string());
    GenomeFile read;
    if (value.is_object() && value.contains("length_mm")) {
        read.length = number(value, "length_mm", file.string());
        if (!(read.length > 0 && std::isfinite(read.length)))
            throw InputError(file.string() + ": length_mm is " + shown(value.at("length_mm")) +
                             ", expected a finite number greater than 0");
        value.erase("length_mm");
    }
    read.genome = genome_from_json(value, file.string());
    return read;
}

Genome read_genome(const std::filesystem::path& file) { return read_genome_file(file).genome; }

std::string genome_file_text(const Genome& genome, double length) {
    json file = genome_to_json(genome);
    if (length != standard_length)
        file["length_mm"] = length;
    return json_text(file) + "\n";
}

} // namespace rough
