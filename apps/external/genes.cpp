#include "apps/external/genes.hpp"

#include "domain/text/json.hpp"

#include <boost/algorithm/string.hpp>
#include <nlohmann/json.hpp>

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
        {{"pipeline", "", "search by this text, with objectives f1, f2, ... (see rugosa operators)"},
         search.pipeline},
        {ga::whole("evaluations", "10000", 1, "maximum number of evaluations").up_to(0x1p53),
         search.evaluations},
        {positive("seconds", "",
                  "maximum wall time of the whole search; without evaluations, the only limit"),
         search.seconds},
        {ga::number("max-failures", ga::number(search.max_failures), 0, 1,
                    "the search ends if a larger share of its evaluations fails, from 200 evaluations on"),
         search.max_failures},
        {seed_setting(), search.seed},
    };
}

constexpr const char* kinds_of_genes =
    "real:COUNT:LOWER:UPPER, int:COUNT:FROM:TO and choice:COUNT:WORD:WORD:..., "
    "separated by commas, or only bits:COUNT or permutation:COUNT";

Genes::Part part_from(const std::string& text) {
    const auto words = parts_of(text);
    const bool real = words[0] == "real", whole = words[0] == "int", choice = words[0] == "choice";
    if ((!choice || words.size() < 4) && (!(real || whole) || words.size() != 4))
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
    if (!(part.lower < part.upper) || !std::isfinite(part.upper - part.lower))
        rough::refuse("--genes: \"", text,
                      "\" is out of order; give a lower bound below the upper one, at a finite distance");
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
    const bool unlimited = settings.has("seconds") && !settings.given("evaluations");
    take(settings, bindings_of(search));
    if (unlimited)
        search.evaluations = std::numeric_limits<long>::max();
}

std::vector<ga::Variable> range_of(const Genes& genes) {
    std::vector<ga::Variable> range;
    for (const Genes::Part& part : genes.parts)
        for (std::size_t i = 0; i < part.count; ++i)
            range.push_back({range.size(), part.lower - (part.is_whole ? 0.5 : 0),
                             part.upper + (part.is_whole ? 0.5 : 0)});
    return range;
}

std::vector<double> rounded(const Genes& genes, std::vector<double> numbers) {
    std::size_t g = 0;
    for (const Genes::Part& part : genes.parts)
        for (std::size_t i = 0; i < part.count && g < numbers.size(); ++i, ++g)
            if (part.is_whole)
                numbers[g] = numbers[g] >= part.lower                                 // also if it is NaN
                                 ? std::min(std::round(numbers[g]), part.upper) + 0.0 // no -0
                                 : part.lower;
    return numbers;
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
    for (; g < values.size(); ++g)
        add(ga::number(values[g]));
    return text + "]";
}

Genes genes_from(const std::string& text) {
    const auto words = parts_of(text);
    Genes genes;
    if (words.size() == 2 && (words[0] == "bits" || words[0] == "permutation")) {
        genes.kind = words[0] == "bits" ? Genes::Kind::bits : Genes::Kind::permutation;
        genes.count =
            count_from(words[1], "--genes", genes.kind == Genes::Kind::permutation ? 2 : 1, max_genes);
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

std::vector<std::string> objective_names(std::size_t count) {
    std::vector<std::string> names;
    for (std::size_t k = 1; k <= count; ++k)
        names.push_back("f" + std::to_string(k));
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
    const std::string rate = ga::number(1 / static_cast<double>(genes.count)); // one gene per child
    const auto [cross, mutation] = genes.kind == Genes::Kind::numbers ? std::pair("sbx", " polynomial")
                                   : genes.kind == Genes::Kind::bits  ? std::pair("uniform", "")
                                                                      : std::pair("order", " reverse");
    const std::string pareto = "pareto " + boost::join(objective_names(objectives), " ");
    const std::string begin = std::string("repeat 1000000000 { tournament 2 | cross ") + cross +
                              " rate=0.9 | mutate " + rate + mutation;
    ga::Variants variants{
        {"ga", "sample 40 | score | " + begin + " | score | elite 2 } | best 1"},
        {"nsga2", "sample 100 | " + pareto + " | " + begin + " | " + pareto + " | plus 100 } | front"}};
    if (genes.kind == Genes::Kind::numbers) {
        const std::size_t individuals =
            std::clamp<std::size_t>(18 * genes.count, 20, 2000); // Tanabe and Fukunaga
        const std::string loop = " | score | repeat 1000000000 { ";
        variants["bipop-cma-es"] = "sample 1" + loop + "cma-es | score }";
        variants["ipop-cma-es"] = "sample 1" + loop + "cma-es restarts=ipop sigma=0.5 | score }";
        variants["lshade"] = "sample " + std::to_string(individuals) + loop + "l-shade | score | duel }";
    }
    return variants;
}

} // namespace app
