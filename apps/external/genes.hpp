#pragma once

#include "apps/prompt/settings.hpp"
#include "ga/problem/problem.hpp"
#include "ga/text/parser.hpp"

#include <limits>
#include <string>
#include <vector>

namespace app {

/// What a genome is made of, as --genes says it: bits:40, permutation:20, or numbers and words in several
/// parts, real:5:-5:5,int:3:0:120,choice:2:a:b:c.
struct Genes {
    enum class Kind { numbers, bits, permutation };
    /// Genes of one range. A whole number and a word are genes like others, rounded when they are evaluated.
    struct Part {
        std::size_t count = 1;
        double lower = 0, upper = 1;         ///< of each; a word's place in `words`
        bool is_whole = false;               ///< an integer or a word
        std::vector<std::string> words = {}; ///< that the gene chooses from
    };
    Kind kind = Kind::numbers;
    std::size_t count = 1;        ///< of all genes
    std::vector<Part> parts = {}; ///< of numbers

    /// Whether every gene is a real number.
    bool all_real() const;
};

/// What is asked of a search whose genomes are evaluated outside, and what came of it beside the best.
struct OutsideSearch {
    Genes genes = {};
    std::string variant = {}, pipeline = {}; ///< one of them, or none for ga or, of several objectives, nsga2
    std::uint64_t seed = 1;
    long evaluations = std::numeric_limits<long>::max();      ///< at most
    double seconds = std::numeric_limits<double>::infinity(); ///< at most, from the call on

    std::string searched = {};           ///< the pipeline as it was run
    long spent = 0;                      ///< evaluations
    std::string stopped = {};            ///< why it ended before its pipeline; empty when it did not
    std::vector<std::string> notes = {}; ///< the engine's remarks
};
/// Its parameters that the program and Python share: variant, pipeline, evaluations, seconds and seed.
std::vector<Setting> outside_settings();
/// Reads them. Seconds alone take the place of evaluations. Throws rough::InputError.
void take_search(const Settings& settings, OutsideSearch& search);

/// The range of every number, half a unit more on both sides of a whole one; none of other kinds.
std::vector<ga::Variable> range_of(const Genes& genes);
/// The numbers as they are evaluated: whole ones rounded, within their range.
std::vector<double> rounded(const Genes& genes, std::vector<double> numbers);
/// As a JSON array, "[0.5,3,\"a\"]": 17 digits where they are needed.
std::string genes_text(const Genes& genes, const std::vector<double>& numbers);

/// Throws rough::InputError on anything else.
Genes genes_from(const std::string& text);

/// "f1", "f2", ...: what pipelines call the objectives.
std::vector<std::string> objective_names(std::size_t count);

/// Whether less is better, by the value of --minimise: "" for none, "all", or numbers from 1. Throws
/// rough::InputError on others.
std::vector<bool> minimised(const std::string& text, std::size_t objectives);

/// The pipelines that have a name: ga (one objective) and nsga2 (several), for real genes bipop-cma-es,
/// ipop-cma-es and lshade. They end with the run's budget.
ga::Variants outside_variants(const Genes& genes, std::size_t objectives);

} // namespace app
