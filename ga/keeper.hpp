#pragma once

#include "ga/door.hpp"
#include "ga/kept.hpp"

namespace ga {

/// Keeps a run on its way so that it can go on after its process has ended.
template <Problem P>
class Keeper {
  public:
    using Genome = typename P::Genome; ///< of the problem
    using Taken = Snapshot<Genome>;    ///< a run between two stages

    virtual ~Keeper() = default;
    /// Called before the pipeline starts, with the run's identity: what was kept of it, if anything was; the
    /// ledger gets its memory back.
    virtual std::optional<Taken> begin(Ledger<P>& ledger, std::uint64_t run) = 0;
    /// The pipeline's answer, when the run that `begin` found had ended already.
    virtual std::optional<Population<Genome>> answer() const = 0;
    /// Whether it is time to write the run down, so many seconds after it began.
    virtual bool due(double seconds) const = 0;
    /// Writes the run down; with its answer when it is done.
    virtual void write(const Taken& snapshot, const Ledger<P>& ledger,
                       const Population<Genome>* answer = nullptr) = 0;
    /// What could not be kept, in words; empty when all was.
    virtual std::string trouble() const { return {}; }
};

} // namespace ga
