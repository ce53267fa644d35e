#pragma once

#include "domain/accuracy/respond.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/response/curve.hpp"

#include <map>
#include <mutex>
#include <optional>

namespace rough {

/// How Algorithm 1 compares the curves. The paper does not say; pressures are our reading.
enum class DominanceReading {
    same_pressure, ///< at the whole's absolute pressures, each part's curve held constant beyond its own
                   ///< range
    same_step,     ///< by load step, each part on its own range
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

/// Algorithm 1 on genomes, with a memory, as several operators ask for the same genome. Safe to call from
/// several threads.
class DominanceRule {
  public:
    /// Under a model; accuracy is its own for the whole genome, parts are solved throughout. An area's grid is
    /// halved while it has more than 64 nodes a side: curves are correlated here, not scored.
    explicit DominanceRule(Model model, DominanceReading reading = DominanceReading::same_pressure);

    /// One contact curve a chromosome, one for the whole. Chromosomes of equal wave number, of any series,
    /// are one.
    Dominance operator()(const Genome& genome) const;

  private:
    Dominance judged(const Genome& genome) const;

    Model model_;
    DominanceReading reading_;
    mutable std::mutex guard_;
    mutable std::map<std::string, Dominance> known_;
};

/// The genome's dominant chromosomes alone.
Genome reduced(const Genome& genome, const Dominance& dominance);

} // namespace rough
