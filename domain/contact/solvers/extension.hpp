#pragma once

#include "domain/numerics/aligned.hpp"

#include <vector>

namespace rough {

/// E, which continues a field known at some nodes of a grid to all of them, and its transpose. The inverse of
/// C^-1 restricted to those nodes is the least energy of C over all continuations (Schur's complement): E'CE
/// is never below it, and near it where E is good. Means over ever larger squares are blended here, each by
/// what stands in its square (hierarchical extensions: Haase, Langer, Meyer & Nepomnyaschikh 1994; the
/// pyramid: Gortler et al. 1996). The grid is taken to be periodic. E maps 1 to 1.
class Extension {
  public:
    /// From the known nodes, in increasing order.
    Extension(Extent shape, std::vector<int> nodes);
    /// E: `field` has values at the known nodes and gets them elsewhere.
    void extend(float* field);
    /// E': what `field` has elsewhere is carried over to the known nodes; elsewhere it becomes of no use.
    void transpose(float* field);

  private:
    /// Squares twice as wide as those below, whose parents they are.
    struct Level {
        Extent shape;
        std::vector<float> value;
        std::vector<float> weight; ///< of a square's mean against what wider ones say
        std::vector<float> share;  ///< of a square in its parent's mean
        explicit Level(Extent below);
    };
    /// Values in between those of `from`, linear along x and y; at weights, blended with what is there.
    void refine(const Level& from, Extent shape, const float* weight, float* into);
    /// Its transpose, which leaves behind what the weights keep.
    void coarsen(float* from, Extent shape, const float* weight, Level& into);

    Extent shape_;
    std::vector<int> nodes_, parents_;
    std::vector<float> shares_, known_; ///< of the nodes
    std::vector<Level> levels_;         ///< the last is a single square
    std::vector<float> line_, row_;     ///< to work in: a coarse row, a fine one, and a number at either end
};

} // namespace rough
