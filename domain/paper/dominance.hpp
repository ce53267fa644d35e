#pragma once

#include "domain/accuracy/respond.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/problem/setup.hpp"
#include "domain/response/curve.hpp"

#include <map>
#include <memory>
#include <mutex>
#include <optional>

namespace rough {

/// How Algorithm 1 compares the curves. The paper does not say; pressures are our reading.
enum class DominanceReading {
    same_pressure, ///< at the whole's absolute pressures, each part's curve held constant beyond its own
                   ///< range
    same_step,     ///< by load step, each part on its own range
    raw,           ///< the tangents as the solver gives them, by load step
};

/// The correlation above which a part is dominant (the paper).
constexpr double dominance_threshold = 0.95;

/// Which parts of a profile govern its curve (paper, Algorithm 1).
struct DominantParts {
    std::vector<double> correlation; ///< Pearson's, of the whole's values with each part's; NaN: undefined
    std::vector<char> dominant;      ///< one a part; at least one is set
    bool only_best = false;          ///< none passed the threshold: the best correlated was kept
};
/// Algorithm 1 for curves of any kind: `parts` are those of each part alone, empty where it has no height
/// range or no answer. Of none that is defined all are kept.
DominantParts dominant_parts(const Curve& whole, const std::vector<std::optional<Curve>>& parts,
                             double threshold = dominance_threshold,
                             DominanceReading reading = DominanceReading::same_pressure);

/// The curve of a response that a reading compares.
Curve compared_curve(const Response& response, DominanceReading reading);

/// Which chromosomes govern a genome's stiffness curve.
struct Dominance {
    /// correlation[s][c]: of the whole genome's K with that of chromosome c of series s alone; NaN where the
    /// chromosome has no height range or its K no variance.
    std::vector<std::vector<double>> correlation;
    std::vector<std::vector<char>> dominant; ///< same shape; at least one is set
    bool only_best = false;                  ///< none passed the threshold: the best correlated was kept

    /// Whether that chromosome, by its index in its series' list, is dominant.
    bool at(std::size_t series, std::size_t chromosome) const { return dominant[series][chromosome] != 0; }
};

/// Algorithm 1 on genomes. It remembers the responses of each genome and of its length scales alone, for
/// every reading. Safe to call from several threads.
class DominanceRule {
  public:
    /// Under a model; its accuracy holds for whole genomes, length scales alone are solved throughout. An
    /// area's grid is halved while it has more than 64 nodes a side: curves are correlated here, not scored.
    explicit DominanceRule(Model model, DominanceReading reading = DominanceReading::same_pressure,
                           double threshold = dominance_threshold);

    /// Chromosomes of equal wave number, of any series, are one.
    Dominance operator()(const Genome& genome) const { return (*this)(genome, reading_); }
    /// The same under another reading.
    Dominance operator()(const Genome& genome, DominanceReading reading) const;

  private:
    struct Known {
        Response whole;
        std::vector<std::optional<Response>> parts; ///< one a length scale; empty where that is flat
    };
    std::shared_ptr<const Known> responses_of(const Genome& genome) const;

    Model model_;
    DominanceReading reading_;
    double threshold_;
    mutable std::mutex guard_;
    mutable std::map<std::string, std::shared_ptr<const Known>> known_;
};

/// The genome's dominant chromosomes alone.
Genome reduced(const Genome& genome, const Dominance& dominance);

/// The genome's length scales that by themselves follow a target: the curve of one alone, in the genome's own
/// amplitude and loaded as far as the target goes, correlates with the target's at its points by more than
/// the threshold (Pearson). The best correlated where none does, all where none has an answer. After Cinat,
/// Paggi and Gnecco (2019), who keep such chromosomes for each of two targets.
Genome reduced_to_target(const DesignSetup& setup, const Genome& genome, std::size_t target,
                         double threshold = dominance_threshold);

} // namespace rough
