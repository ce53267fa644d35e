#pragma once

#include "domain/numerics/aligned.hpp"

#include <vector>

namespace rough {

/// u = H p by its sums, for pressures on few nodes: there a transform would mostly turn zeros. One object
/// serves one thread at a time.
class DirectOperator {
  public:
    /// Symmetric Toeplitz or circulant from its first column of N entries.
    explicit DirectOperator(const Eigen::VectorXd& first_column);

    /// Pressures on these nodes, in this order; u at every node (N entries), valid until the next call.
    const double* apply(const std::vector<int>& nodes, const Eigen::VectorXd& pressure);
    /// Whether so many loaded nodes cost less than a Fourier operator's two transforms; a fixed rule.
    bool pays(std::size_t loaded) const { return static_cast<Index>(loaded) <= most_loaded_; }

  private:
    Index nodes_, padded_, most_loaded_;
    AlignedBuffer<double> mirrored_; ///< h[|i|], i = -(N-1) .. N-1, and zeros
    AlignedBuffer<double> displacement_;
};

} // namespace rough
