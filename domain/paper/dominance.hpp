#pragma once

#include "domain/accuracy/respond.hpp"
#include "domain/mwm/sampling.hpp"

#include <map>
#include <mutex>

namespace rough {

/// Which chromosomes govern a genome's stiffness curve (paper, Algorithm 1).
struct Dominance {
    /// correlation[s][c]: Pearson correlation of the whole genome's K with that of chromosome c of series s
    /// alone; NaN where the chromosome has no height range or its K no variance.
    std::vector<std::vector<double>> correlation;
    std::vector<std::vector<char>> dominant; ///< same shape; at least one is set
    bool only_best = false;                  ///< none passed the threshold: the best correlated was kept

    /// Whether that chromosome, by its index in its series' list, is dominant.
    bool at(std::size_t series, std::size_t chromosome) const { return dominant[series][chromosome] != 0; }
};

/// How Algorithm 1 compares the curves. The paper does not say; pressures are our reading.
enum class DominanceReading {
    same_pressure, ///< at the whole genome's absolute pressures, K_n held constant beyond its own range
    same_step,     ///< by load step, each chromosome on its own range
};

/// Algorithm 1 with a memory, as several operators ask for the same genome. Safe to call from several
/// threads.
class DominanceRule {
  public:
    /// `threshold` is the correlation above which a chromosome is dominant (the paper: 0.95).
    explicit DominanceRule(Model model, DominanceReading reading = DominanceReading::same_pressure,
                           double threshold = 0.95)
        : model_(std::move(model)), reading_(reading), threshold_(threshold) {}

    /// One contact curve a chromosome, one for the whole. Chromosomes of equal wave number, of any series,
    /// are one.
    Dominance operator()(const Genome& genome) const;

  private:
    Dominance judged(const Genome& genome) const;

    Model model_;
    DominanceReading reading_;
    double threshold_;
    mutable std::mutex guard_;
    mutable std::map<std::string, Dominance> known_;
};

/// The genome's dominant chromosomes alone.
Genome reduced(const Genome& genome, const Dominance& dominance);

} // namespace rough
