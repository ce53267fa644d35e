#pragma once

#include "domain/numerics/team.hpp"

namespace rough {

/// E, which continues a field known at some nodes of a grid to all of them, and its transpose. The inverse of C^-1
/// restricted to those nodes is the lowest energy of C over all continuations (Schur's complement). E'CE is never below
/// it, and near it if E is good. E blends means over wider and wider squares. The weight of a mean depends on the
/// number of nodes in its square. Sources: Haase, Langer, Meyer & Nepomnyaschikh 1994 (hierarchical extensions),
/// Gortler et al. 1996 (the pyramid). The grid is taken to be periodic. E maps 1 to 1.
class Extension {
  public:
    /// No node is known. The team shares its loops and must outlive it.
    explicit Extension(Extent shape, Team& team = Team::alone());
    /// From now on these nodes are known, in increasing order.
    void know(std::vector<int> nodes);
    const std::vector<int>& known() const { return nodes_; } ///< the known nodes
    /// E: `field` has values at the known nodes and gets them elsewhere.
    void extend(float* field);
    /// E': carries the values at all other nodes over to the known ones. The other nodes then hold no useful value.
    void transpose(float* field);

  private:
    /// Squares twice as wide as those below, whose parents they are.
    struct Level {
        Extent shape;
        std::vector<float> value;
        std::vector<float> weight; ///< weight of a square's mean against wider squares
        std::vector<float> share;  ///< share of a square in its parent's mean
        explicit Level(Extent below);
    };
    /// Sets all values to 0.
    void clear(std::vector<float>& values);
    /// Interpolates `from` linearly along x and y; with weights, blends the result with the present values.
    void refine(const Level& from, Extent shape, const float* weight, float* into);
    /// The transpose of refine; `from` keeps the part that the weights give.
    void coarsen(float* from, Extent shape, const float* weight, Level& into);
    /// change(k) for each known node; those of one parent by the same thread, in order.
    template <class Change>
    void each_node(Change change);

    Team& team_;
    Extent shape_;
    std::vector<int> nodes_, parents_;
    std::vector<std::size_t> starts_;   ///< positions of the first nodes of ranges of parents' rows
    std::vector<float> shares_, known_; ///< shares in the parents, and known values, of the nodes
    std::vector<Level> levels_;         ///< the last is a single square
    std::vector<float> work_;           ///< for each thread: a coarse row, a fine one, and numbers at their ends
};

} // namespace rough
