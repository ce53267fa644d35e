#pragma once

#include "domain/contact/solvers/influence.hpp"

#include <vector>

namespace rough {

/// u = H p by its sums, for pressures on few nodes: there a transform would mostly turn zeros. One object
/// serves one thread at a time.
class DirectOperator {
  public:
    /// `influence` must outlive it.
    explicit DirectOperator(const Influence& influence);

    /// Pressures on these nodes, in this order; u at every node (N entries), valid until the next call.
    const double* apply(const std::vector<int>& nodes, const Eigen::VectorXd& pressure);
    /// Whether so many loaded nodes cost less than a Fourier operator's two transforms; a fixed rule.
    bool pays(std::size_t loaded) const { return static_cast<Index>(loaded) <= most_loaded_; }

  private:
    const Influence& influence_;
    Index most_loaded_;
    AlignedBuffer<double> displacement_; ///< and room for a row in whole blocks
    std::vector<int> places_;
};

} // namespace rough
