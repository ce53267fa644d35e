#include "apps/external/genes.hpp"

#include "domain/errors.hpp"
#include "domain/text/words.hpp"
#include "ga/base/number.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace app {

using rough::InputError;

namespace {

constexpr double most_genes = 1e6;

std::vector<std::string> parts_of(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, ':');)
        parts.push_back(part);
    if (text.ends_with(':'))
        parts.emplace_back();
    return parts;
}

std::size_t count_from(const std::string& word, const std::string& where, double least, double most) {
    const double value = rough::number_from(word, where);
    if (value != std::floor(value) || value < least || value > most)
        throw InputError(where + ": " + word + " given, expected a whole number from " + ga::number(least) +
                         " to " + ga::number(most));
    return static_cast<std::size_t>(value);
}

} // namespace

std::vector<ga::Variable> range_of(const Genes& genes) {
    std::vector<ga::Variable> range;
    if (genes.kind == Genes::Kind::real)
        for (std::size_t i = 0; i < genes.count; ++i)
            range.push_back({i, genes.lower, genes.upper});
    return range;
}

Genes genes_from(const std::string& text) {
    const auto parts = parts_of(text);
    const std::string kind = parts.empty() ? "" : parts.front();
    const bool real = kind == "real";
    if ((!real && kind != "bits" && kind != "permutation") || parts.size() != (real ? 4u : 2u))
        throw InputError("--genes: \"" + text +
                         "\" given, expected real:COUNT:LOWER:UPPER, bits:COUNT or permutation:COUNT");
    Genes genes;
    genes.kind = real ? Genes::Kind::real : kind == "bits" ? Genes::Kind::bits : Genes::Kind::permutation;
    genes.count = count_from(parts[1], "--genes", genes.kind == Genes::Kind::permutation ? 2 : 1, most_genes);
    if (real) {
        genes.lower = rough::number_from(parts[2], "--genes");
        genes.upper = rough::number_from(parts[3], "--genes");
        if (!(genes.lower < genes.upper) || !std::isfinite(genes.upper - genes.lower))
            throw InputError("--genes: \"" + text +
                             "\" given, expected a lower bound below the upper one, a finite way apart");
    }
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
    const std::string rate = ga::number(1 / static_cast<double>(genes.count)); // one gene a child
    std::string vary = "tournament 2 | ";
    switch (genes.kind) {
    case Genes::Kind::real:
        vary += "cross sbx rate=0.9 | mutate " + rate + " polynomial";
        break;
    case Genes::Kind::bits:
        vary += "cross uniform rate=0.9 | mutate " + rate;
        break;
    case Genes::Kind::permutation:
        vary += "cross order rate=0.9 | mutate " + rate + " reverse";
        break;
    }
    std::string pareto = "pareto";
    for (const std::string& name : objective_names(objectives))
        pareto += " " + name;
    const std::string on = "repeat 1000000000 { " + vary;
    ga::Variants variants{
        {"ga", "sample 40 | score | " + on + " | score | elite 2 } | best 1"},
        {"nsga2", "sample 100 | " + pareto + " | " + on + " | " + pareto + " | plus 100 } | front"}};
    if (genes.kind == Genes::Kind::real) {
        const std::size_t many = std::clamp<std::size_t>(18 * genes.count, 20, 2000); // Tanabe and Fukunaga
        const std::string ever = " | score | repeat 1000000000 { ";
        variants["bipop-cma-es"] = "sample 1" + ever + "cma-es | score }";
        variants["lshade"] = "sample " + std::to_string(many) + ever + "l-shade | score | duel }";
    }
    return variants;
}

} // namespace app
