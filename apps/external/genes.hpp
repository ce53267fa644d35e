#pragma once

#include "apps/prompt/settings.hpp"
#include "ga/text/parser.hpp"

namespace app {

/// The genes of a genome, as in --genes: bits:40, permutation:20, or parts of numbers and words, as in
/// real:5:-5:5,real:2:1e-6:1:log,real:2:0:1:0.25,int:3:0:120,choice:2:a:b:c.
struct Genes {
    enum class Kind { numbers, bits, permutation };
    /// Genes of one range. Integers, words and stepped numbers are real genes that are rounded for the evaluation. On a
    /// logarithmic scale the search sees the natural logarithm. If both bounds are equal, the genes are fixed.
    struct Part {
        std::size_t count = 1;
        double lower = 0, upper = 1;         ///< bounds of each gene; for words, of their index
        bool is_whole = false;               ///< whether the genes are integers or words
        bool is_log = false;                 ///< whether the scale is logarithmic
        double step = 0;                     ///< distance of allowed numbers from `lower` on; 0 for any
        std::vector<std::string> words = {}; ///< words to choose from
    };
    Kind kind = Kind::numbers;
    std::size_t count = 1;        ///< number of all genes
    std::vector<Part> parts = {}; ///< parts of Kind::numbers
};

/// A search whose genomes are evaluated by another program or by Python, and its result except the answers.
struct OutsideSearch {
    Genes genes = {};
    std::string variant = {}, pipeline = {}; ///< one of them; by default ga, or nsga2 for several objectives
    std::string levels = {};                 ///< levels of evaluation and their prices (levels_from)
    /// Genomes to begin with (numbers_from). A leading `sample n` of the pipeline draws only the missing ones.
    std::vector<std::vector<double>> start = {};
    std::uint64_t seed = 1;
    long evaluations = std::numeric_limits<long>::max();      ///< maximum number
    double seconds = std::numeric_limits<double>::infinity(); ///< maximum time of the whole search
    double max_failures = ga::Budget().max_failures;          ///< see ga::Budget

    std::string searched = {};           ///< the pipeline that ran
    long spent = 0;                      ///< number of evaluations
    double price = 0;                    ///< their price, in evaluations of the first level
    long failures = 0;                   ///< number of requested evaluations that failed
    std::string stopped = {};            ///< why it ended before its pipeline did; "" if it did not
    bool is_dead_end = false;            ///< see ga::Result
    std::vector<std::string> notes = {}; ///< the engine's remarks
};
/// The parameters that the program and Python share: variant, pipeline, evaluations, seconds, max-failures and seed.
std::vector<Setting> outside_settings();
/// Reads them. If only `seconds` is given, evaluations are unlimited. Throws rough::InputError.
void take_search(const Settings& settings, OutsideSearch& search);

/// The bounds of each number in the search, extended by half a step on both sides for numbers that are
/// rounded. Words and integers of up to eight values are choices. Empty for other kinds.
std::vector<ga::Variable> range_of(const Genes& genes);
/// The numbers to evaluate: rounded, within their bounds, and on the scale of the user.
std::vector<double> rounded(const Genes& genes, std::vector<double> numbers);
/// The genes in the search for the values that a user writes, the inverse of `rounded`. Bits are 0 or 1,
/// words may be in quotes. Throws rough::InputError, which begins with `where`, on a wrong number of values
/// and on a value of a wrong kind or out of bounds.
std::vector<double> numbers_from(const Genes& genes, const std::vector<std::string>& values, const std::string& where);
/// The number of individuals that a pipeline's leading `sample n` draws; 0 without one.
std::size_t leading_sample(const std::string& pipeline);
/// The genes as a JSON array, "[0.5,3,\"a\"]", with as many digits as are needed to read the same numbers.
std::string genes_text(const Genes& genes, const std::vector<double>& numbers);

/// The genes of a text as in --genes. Throws rough::InputError if it is malformed.
Genes genes_from(const std::string& text);

/// The names of the objectives in pipelines: "f1", "f2", ...
std::vector<std::string> objective_names(std::size_t count);

/// The levels of "coarse:1,fine:18": a name, and the price in evaluations of the first level; one without a
/// name for an empty text. Throws rough::InputError.
std::vector<ga::LevelPrice> levels_from(const std::string& text);

/// Which objectives are minimised, from the value of --minimise: "" for none, "all", or numbers from 1.
/// Throws rough::InputError.
std::vector<bool> minimised(const std::string& text, std::size_t objectives);

/// The named pipelines: ga (one objective), nsga2, nsga3 and sms-emoa (several), and for real genes
/// bipop-cma-es, ipop-cma-es and lshade. They end with the run's budget.
ga::Variants outside_variants(const Genes& genes, std::size_t objectives);

} // namespace app
