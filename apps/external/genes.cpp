#include "apps/external/genes.hpp"

#include "domain/text/json.hpp"
#include "ga/base/json.hpp"

#include <boost/algorithm/string.hpp>

namespace app {
namespace {

constexpr double max_genes = 1e6;

std::vector<std::string> parts_of(const std::string& text) {
    std::vector<std::string> parts;
    return boost::split(parts, text, boost::is_any_of(":"));
}

std::size_t count_from(const std::string& word, const std::string& where, double min, double max) {
    const double value = rough::number_from(word, where);
    if (value != std::floor(value) || value < min || value > max)
        rough::refuse(where, ": ", word, " is out of range (a whole number from ", ga::number(min), " to ",
                      ga::number(max), ")");
    return static_cast<std::size_t>(value);
}

Bindings bindings_of(OutsideSearch& search) {
    return {
        {Setting("variant", "",
                 "named pipeline, by default ga or, for several objectives, nsga2; others only for numbers")
             .of(names_of(outside_variants({}, 1))),
         search.variant},
        {{"pipeline", "", "search by this text, with objectives f1, f2, ... (see rugosa operators)"}, search.pipeline},
        {{"levels", "",
          "names and prices of levels of evaluation, the first of price 1, e.g. coarse:1,fine:18; an evaluation gets "
          "the level's name, and a pipeline names the objectives of the second level f1-fine, ..."},
         search.levels},
        {whole("evaluations", "10000", 1, 0x1p53,
               "maximum number of evaluations; with levels, their price in evaluations of the first"),
         search.evaluations},
        {positive("seconds", "", "maximum wall time of the whole search; without evaluations, the only limit"),
         search.seconds},
        {ga::number("max-failures", ga::number(search.max_failures), 0, 1,
                    "the search ends if a larger share of its evaluations fails, from 200 evaluations on"),
         search.max_failures},
        {seed_setting(), search.seed},
    };
}

constexpr const char* kinds_of_genes =
    "real:COUNT:LOWER:UPPER (and :log or :STEP), int:COUNT:FROM:TO and choice:COUNT:WORD:WORD:..., "
    "separated by commas, or only bits:COUNT or permutation:COUNT";

Genes::Part part_from(const std::string& text) {
    const auto words = parts_of(text);
    const bool real = words[0] == "real", whole = words[0] == "int", choice = words[0] == "choice";
    if ((!choice || words.size() < 4) && (!(real || whole) || words.size() < 4 || words.size() > (real ? 5 : 4)))
        rough::refuse("--genes: \"", text, "\" is malformed; give ", kinds_of_genes);
    Genes::Part part;
    part.count = count_from(words[1], "--genes", 1, max_genes);
    part.is_whole = !real;
    if (choice) {
        part.words.assign(words.begin() + 2, words.end());
        part.upper = static_cast<double>(part.words.size()) - 1;
        if (std::set<std::string>(part.words.begin(), part.words.end()).size() < part.words.size())
            rough::refuse("--genes: \"", text, "\" repeats a word; give different words");
        return part;
    }
    part.lower = rough::number_from(words[2], "--genes");
    part.upper = rough::number_from(words[3], "--genes");
    if (!(part.lower <= part.upper) || !std::isfinite(part.upper - part.lower))
        rough::refuse("--genes: \"", text,
                      "\" is out of order; give a lower bound that is not above the upper one, at a finite distance");
    if (words.size() == 5 && words[4] == "log") {
        part.is_log = true;
        if (!(part.lower > 0)) rough::refuse("--genes: \"", text, "\" has no logarithm; give a lower bound above 0");
    } else if (words.size() == 5) {
        part.step = rough::number_from(words[4], "--genes");
        const double steps = (part.upper - part.lower) / part.step;
        if (!(part.step > 0) || !(steps < 0x1p53) || std::abs(steps - std::round(steps)) > 1e-6)
            rough::refuse("--genes: \"", text,
                          "\" has a wrong step; give log, or a step above 0 that divides the range");
    }
    if (whole && (part.lower != std::round(part.lower) || part.upper != std::round(part.upper) ||
                  std::max(-part.lower, part.upper) > 1e15))
        rough::refuse("--genes: \"", text, "\" is out of range; give whole bounds up to 1e15");
    return part;
}

} // namespace

std::vector<Setting> outside_settings() {
    OutsideSearch usual;
    return settings_of(bindings_of(usual));
}

void take_search(const Settings& settings, OutsideSearch& search) {
    if (settings.has("variant") && settings.has("pipeline"))
        rough::refuse("optimise: ", settings.place("variant"), " and ", settings.place("pipeline"),
                      " exclude each other; give one");
    if (settings.has("levels") && !settings.has("pipeline"))
        rough::refuse("optimise: ", settings.place("levels"),
                      " without pipeline; give one that names an objective of "
                      "each level, e.g. \"sample 50 | score | best 5 | score f1-fine\"");
    const bool unlimited = settings.has("seconds") && !settings.given("evaluations");
    take(settings, bindings_of(search));
    levels_from(search.levels); // refuses a wrong text
    if (unlimited) search.evaluations = std::numeric_limits<long>::max();
}

std::vector<ga::Variable> range_of(const Genes& genes) {
    constexpr double max_choices = 8; // maximum number of integers
    std::vector<ga::Variable> range;
    for (const Genes::Part& part : genes.parts)
        for (std::size_t i = 0; i < part.count; ++i) {
            const double half = part.upper > part.lower ? (part.is_whole ? 0.5 : part.step / 2) : 0;
            ga::Variable gene{range.size(), part.lower - half, part.upper + half};
            if (part.is_log) gene.lower = std::log(part.lower), gene.upper = std::log(part.upper);
            gene.is_choice = part.is_whole && (!part.words.empty() || part.upper - part.lower < max_choices);
            range.push_back(gene);
        }
    return range;
}

std::vector<double> rounded(const Genes& genes, std::vector<double> numbers) {
    std::size_t g = 0;
    for (const Genes::Part& part : genes.parts)
        for (std::size_t i = 0; i < part.count && g < numbers.size(); ++i, ++g) {
            double& number = numbers[g];
            if (part.is_log) number = std::clamp(std::exp(number), part.lower, part.upper);
            if (const double step = part.is_whole ? 1 : part.step; step > 0)
                number = number >= part.lower // also if it is NaN
                             ? std::min(part.lower + step * std::round((number - part.lower) / step), part.upper) +
                                   0.0 // no -0
                             : part.lower;
        }
    return numbers;
}

std::vector<double> numbers_from(const Genes& genes, const std::vector<std::string>& values, const std::string& where) {
    if (values.size() != genes.count) rough::refuse(where, ": ", values.size(), " genes; give ", genes.count);
    const auto range = range_of(genes);
    std::vector<double> numbers;
    std::vector<char> seen(genes.count, 0);
    const auto number_at = [&](std::size_t g, double lower, double upper, bool whole) {
        const std::string place = where + ", gene " + std::to_string(g + 1);
        const double value = rough::number_from(values[g], place);
        if (!(value >= lower && value <= upper) || (whole && value != std::round(value)))
            rough::refuse(place, ": ", values[g], " is out of range (", whole ? "whole, " : "", ga::number(lower),
                          " to ", ga::number(upper), ")");
        return value;
    };
    for (const Genes::Part& part : genes.parts)
        for (std::size_t i = 0; i < part.count; ++i) {
            const std::size_t g = numbers.size();
            const auto word = std::ranges::find(part.words, values[g]);
            if (!part.words.empty() && word == part.words.end())
                rough::refuse(where, ", gene ", g + 1, ": \"", values[g], "\" is unknown; give ",
                              boost::join(part.words, ", "));
            const double value = part.words.empty() ? number_at(g, part.lower, part.upper, part.is_whole)
                                                    : static_cast<double>(word - part.words.begin());
            numbers.push_back(part.is_log ? std::clamp(std::log(value), range[g].lower, range[g].upper) : value);
        }
    while (numbers.size() < genes.count) {
        const bool bits = genes.kind == Genes::Kind::bits;
        const std::size_t g = numbers.size();
        numbers.push_back(number_at(g, 0, bits ? 1 : static_cast<double>(genes.count) - 1, true));
        if (const auto k = static_cast<std::size_t>(numbers.back()); !bits && std::exchange(seen[k], char{1}))
            rough::refuse(where, ", gene ", g + 1, ": ", values[g], " stands twice; give each number once");
    }
    return numbers;
}

std::size_t leading_sample(const std::string& pipeline) {
    return pipeline.starts_with("sample ") ? std::stoul(pipeline.substr(7)) : 0;
}

std::string genes_text(const Genes& genes, const std::vector<double>& numbers) {
    const std::vector<double> values = rounded(genes, numbers);
    std::string text;
    std::size_t g = 0;
    const auto add = [&](const std::string& value) { text += (text.empty() ? "[" : ",") + value; };
    for (const Genes::Part& part : genes.parts)
        for (std::size_t i = 0; i < part.count && g < values.size(); ++i, ++g)
            add(part.words.empty() ? ga::number(values[g])
                                   : rough::json_text(part.words[static_cast<std::size_t>(values[g])], true));
    for (; g < values.size(); ++g) add(ga::number(values[g]));
    return text + "]";
}

Genes genes_from(const std::string& text) {
    const auto words = parts_of(text);
    Genes genes;
    if (words.size() == 2 && (words[0] == "bits" || words[0] == "permutation")) {
        genes.kind = words[0] == "bits" ? Genes::Kind::bits : Genes::Kind::permutation;
        genes.count = count_from(words[1], "--genes", genes.kind == Genes::Kind::permutation ? 2 : 1, max_genes);
        return genes;
    }
    genes.count = 0;
    for (const std::string& part : rough::listed(text)) {
        genes.parts.push_back(part_from(part));
        genes.count += genes.parts.back().count;
    }
    if (genes.parts.empty() || static_cast<double>(genes.count) > max_genes)
        rough::refuse("--genes: \"", text, "\" is malformed; give ", kinds_of_genes);
    return genes;
}

std::vector<ga::LevelPrice> levels_from(const std::string& text) {
    constexpr std::size_t max_levels = 8; // a set of ga::bit_of has no more
    if (text.empty()) return {{}};
    std::vector<std::string> each;
    boost::split(each, text, boost::is_any_of(","));
    std::vector<ga::LevelPrice> levels;
    for (const std::string& part : each) {
        const auto words = parts_of(part);
        const bool is_named = !words[0].empty() && std::ranges::all_of(words[0], [](char c) {
            return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
        });
        if (words.size() != 2 || !is_named ||
            std::ranges::any_of(levels, [&](const ga::LevelPrice& level) { return level.name == words[0]; }))
            rough::refuse("levels: \"", text,
                          "\" is malformed; give different names with prices, e.g. coarse:1,fine:18");
        const double price = rough::number_from(words[1], "levels");
        if (!(price > 0) || !(price < 1e9) || (levels.empty() && price != 1))
            rough::refuse("levels: ", part, " has a wrong price; give 1 to the first level, and up to 1e9 to others");
        levels.push_back({words[0], price, price});
    }
    if (levels.size() > max_levels) rough::refuse("levels: ", levels.size(), " given; give up to ", max_levels);
    return levels;
}

std::vector<std::string> objective_names(std::size_t count) {
    std::vector<std::string> names;
    for (std::size_t k = 1; k <= count; ++k) names.push_back("f" + std::to_string(k));
    return names;
}

std::vector<bool> minimised(const std::string& text, std::size_t objectives) {
    std::vector<bool> all(objectives, text == "all");
    if (text != "all")
        for (const std::string& word : rough::listed(text))
            all[count_from(word, "--minimise", 1, static_cast<double>(objectives)) - 1] = true;
    return all;
}

ga::Variants outside_variants(const Genes& genes, std::size_t objectives) {
    const auto mutate = [&](double share, const char* method) { // `share` genes per child
        return " | mutate " + ga::number(share / static_cast<double>(genes.count)) + method;
    };
    const bool tours = genes.kind == Genes::Kind::permutation, bits = genes.kind == Genes::Kind::bits;
    const auto varied = [&](double share) {
        return tours  ? "cross edge rate=0.5" + mutate(0.5, " reverse") + mutate(0.5, " or_opt")
               : bits ? "cross uniform rate=0.9" + mutate(1, "")
                      : "cross sbx rate=0.9" + mutate(share, " polynomial");
    };
    const std::string pareto = "pareto " + boost::join(objective_names(objectives), " ");
    const std::string begin = "repeat 1000000000 { tournament 2";
    const std::string front =
        "sample 100 | " + pareto + " | " + begin + " draw=each | " + varied(0.5) + " | " + pareto + " | ";
    ga::Variants variants{{"ga", "sample 40 | score | " + begin + " | " + varied(1) + " | score | " +
                                     (tours ? "plus copies=none" : "elite 2") + " } | best 1"},
                          {"nsga2", front + "plus 100 } | front"},
                          {"nsga3", front + "parents | directions 100 } | front"},
                          {"sms-emoa", front + "parents | hypervolume 100 } | front"}};
    if (genes.kind == Genes::Kind::numbers) {
        const std::size_t individuals = std::clamp<std::size_t>(18 * genes.count, 20, 2000); // Tanabe and Fukunaga
        const std::string loop = " | score | repeat 1000000000 { ";
        variants["bipop-cma-es"] = "sample 1" + loop + "cma-es | score }";
        variants["ipop-cma-es"] = "sample 1" + loop + "cma-es restarts=ipop sigma=0.5 | score }";
        variants["lshade"] = "sample " + std::to_string(individuals) + loop + "l-shade | score | duel }";
    }
    return variants;
}

} // namespace app
