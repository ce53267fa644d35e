#include "domain/mwm/genome_json.hpp"

#include "domain/errors.hpp"
#include "domain/mwm/stored.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/json.hpp"

#include <initializer_list>

namespace rough {

namespace {

using nlohmann::json;

constexpr std::size_t max_genome_bytes = 16'000'000; // half a million phases in full digits

std::string shown(const json& value) {
    std::string text = json_text(value, true);
    return text.size() > 40 ? text.substr(0, 37) + "..." : text;
}

void expect_object(const json& value, const std::string& where, std::initializer_list<const char*> keys) {
    if (!value.is_object())
        refuse(where, ": ", shown(value), " is not an object; write { ... }");
    for (const auto& [key, item] : value.items())
        if (std::find(keys.begin(), keys.end(), key) == keys.end())
            refuse(where, ": unknown key \"", key, "\"; remove it");
    for (const char* key : keys)
        if (!value.contains(key))
            refuse(where, ": key \"", key, "\" is missing; add it");
}

void expect_number(const json& value, const char* name, const std::string& where) {
    if (!value.is_number())
        refuse(where, ": ", name, " is ", shown(value), ", which is not a number; give one");
}

const json& array(const json& object, const char* key, const std::string& where) {
    const json& value = object.at(key);
    if (!value.is_array())
        refuse(where, ": ", key, " is ", shown(value), ", which is not an array; write [ ... ]");
    return value;
}

void expect_chromosome(const json& value, const std::string& where) {
    expect_object(value, where, {"n", "phases"});
    const json& n = value.at("n");
    if (!n.is_number_integer() || n.get<double>() < 1 || n.get<double>() > 1e6)
        refuse(where, ": n is ", shown(n), ", which is out of range (a whole number from 1 to 1e6)");
    for (const json& phase : array(value, "phases", where))
        expect_number(phase, "a phase (rad)", where);
}

} // namespace

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
        for (const char* gene : {"A", "H", "gamma", "lambda"})
            expect_number(item.at(gene), gene, place);
        int count = 0;
        for (const json& chromosome : array(item, "chromosomes", place))
            expect_chromosome(chromosome, place + ", chromosome " + std::to_string(++count));
        genome.series.push_back(item.get<Series>());
    }
    validate(genome, where);
    return genome;
}

GenomeFile read_genome_file(const std::filesystem::path& file) {
    json value = parsed_json(read_whole(file, max_genome_bytes), file.string());
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
    if (length != standard_length)
        file["length_mm"] = length;
    return json_text(file) + "\n";
}

} // namespace rough
