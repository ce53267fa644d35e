#pragma once

#include "domain/problem/response.hpp"

#include <deque>
#include <map>
#include <mutex>

namespace rough {

/// The set-up with `times` the load steps. Targets that are a measured profile's response
/// (DesignSetup::measured) are computed again in the finer steps; other targets do not change.
DesignSetup in_finer_steps(DesignSetup setup, int times);

/// The set-up with targets corrected by the difference of two curves of one genome. `here` are its misfits
/// under the problem, `finest` those in the finest model to the targets before any correction. A genome with
/// this difference that meets the corrected targets meets the given ones in the finest model (space mapping;
/// Bandler and others, IEEE Trans. Microw. Theory Tech. 52, 2004, 337).
DesignSetup corrected_targets(DesignSetup setup, const std::vector<Eigen::VectorXd>& here,
                              const std::vector<Eigen::VectorXd>& finest);

/// The factors of a finer model.
struct Refinement {
    Index nodes; ///< on the nodes along each axis
    int steps;   ///< on the load steps, about the points of the targets
};
/// The factors of the verification (domain/README.md, "Verified").
Refinement verified_refinement(const Grid& grid);

/// The four similarities of a genome: under the set-up, and on a finer grid and in finer load steps. Eq. 11
/// is applied each time. NaN: not verified, because the verifier was stopped before.
struct Verification {
    double similarity = 0; ///< similarity on the set-up's grid, in its load steps
    double refined = 0;    ///< similarity on the finer grid (verified_refinement), in the set-up's load steps
    double more_steps = 0; ///< similarity in finer load steps (in_finer_steps)
    double both = 0;       ///< similarity on the finer grid in finer load steps
    /// The similarity on the finer grid in finer load steps, less the estimated error of that curve
    /// (README.md). It is the verdict on the surface.
    double worst = 0;
    std::vector<Response> on_grid;  ///< responses on the set-up's grid in its load steps
    std::vector<Response> on_finer; ///< responses on the finer grid in the set-up's load steps
    double seconds = 0;             ///< wall time of the verification
    /// Misfits of each target, in the order of the four similarities.
    std::array<std::vector<Eigen::VectorXd>, 4> misfits;
    /// For each target, the misfits from which `worst` follows. They are those of the curve's values moved by
    /// their estimated error, up or down, whichever is larger in size.
    std::vector<Eigen::VectorXd> largest = {};
};

/// Values by keys, for several threads. A value depends only on its key, so no result depends on the memory.
template <class Value>
class KeyedMemory {
  public:
    /// A memory of the `max_count` latest keys.
    explicit KeyedMemory(std::size_t max_count = std::numeric_limits<std::size_t>::max()) : max_count_(max_count) {}

    /// The value of a key, or nothing.
    std::optional<Value> find(const std::string& key) const {
        const std::lock_guard lock(guard_);
        const auto found = known_.find(key);
        return found == known_.end() ? std::nullopt : std::optional(found->second);
    }
    /// Stores a value, unless the key already has one.
    void keep(const std::string& key, const Value& value) {
        const std::lock_guard lock(guard_);
        const auto [place, is_new] = known_.emplace(key, value);
        if (is_new) order_.push_back(place);
        if (order_.size() > max_count_) {
            known_.erase(order_.front());
            order_.pop_front();
        }
    }

  private:
    std::size_t max_count_;
    mutable std::mutex guard_;
    std::map<std::string, Value> known_;
    std::deque<typename std::map<std::string, Value>::iterator> order_; ///< oldest first
};

/// Verifies the genomes of one set-up.
class Verifier {
  public:
    /// The verifier of a set-up. It solves the load steps of a fine map on up to `threads` threads.
    explicit Verifier(DesignSetup setup, int threads = 1)
        : setup_(std::move(setup)), by_(verified_refinement(setup_.model.grid)), threads_(threads) {}

    /// Verifies one genome. On each grid, the set-up's load steps are solved first. Then two load steps about each
    /// point of the targets are solved, as close as in finer load steps (Refinement). The curve there is read between
    /// them. Each part of its estimated error (domain/README.md, "Verified") is the largest of the nearest points.
    ///
    /// If ContactOptions::stop ends the verification, the remaining similarities are NaN, and their misfits
    /// and responses are empty. Otherwise throws what respond() throws.
    Verification of(const Genome& genome) const;
    /// A genome's verification among the last 32 complete ones, or nothing.
    std::optional<Verification> known(const Genome& genome) const { return known_.find(key_of(setup_, genome)); }
    const DesignSetup& setup() const { return setup_; } ///< the set-up that was given
    /// Verification::largest. Its derivatives in the genes are those of secants four times as wide (a map: as wide).
    Rows misfit_rows(const Genome& genome) const;
    /// The set-up with the targets that its measured surface has in the finer load steps. They are solved on the first
    /// call, because most problems never verify.
    const DesignSetup& finer() const;

  private:
    /// The responses to each loading.
    struct Responses {
        std::vector<Response> own = {}; ///< in the set-up's load steps
        std::vector<Response> all = {}; ///< with those about the targets' points
    };
    Responses responses_on(const Model& model, const Genome& genome) const;
    double width() const; ///< distance of two load steps about a point, as a share of the last displacement
    void verify(const Genome& genome, Verification& result) const;

    DesignSetup setup_;
    Refinement by_;
    int threads_;
    mutable std::mutex finer_guard_; ///< not std::call_once, which an exception should not leave: a solution may stop
    mutable std::optional<DesignSetup> finer_;
    mutable KeyedMemory<Verification> known_{32}; ///< under key_of()
};

} // namespace rough
