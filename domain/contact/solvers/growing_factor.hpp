#pragma once

#include "domain/contact/solvers/influence.hpp"

namespace rough {

/// Cholesky factor L of H_AA on a contact set A that is appended to and cut at its tail, never rebuilt. It also has z =
/// L^-1 1 and v = L^-1 g0_A. Then H_AA p = Delta - g0_A is solved by p = L^-T (Delta z - v), and sum H_AA^-1 1 = z.z. L
/// is stored as panels of eight rows, columns first, so that eight rows are eliminated together.
class GrowingFactor {
  public:
    /// An empty contact set. `gap` is g0 at every node (N entries, in a ContactProblem's units); both must
    /// outlive the factor.
    GrowingFactor(const Influence& influence, const Eigen::VectorXd& gap) : influence_(influence), gap_(gap) {}

    const std::vector<int>& nodes() const { return nodes_; }         ///< A in the order of its rows
    Index size() const { return static_cast<Index>(nodes_.size()); } ///< rows of the factor

    /// Appends nodes; stops before the first whose pivot is not positive. Returns how many were appended.
    Index append(const std::vector<int>& nodes);
    /// Removes the nodes at these positions (increasing). The rows below the first keep their columns left of it.
    void remove(const std::vector<Index>& positions);

    /// p = L^-T (approach z - v), size() entries
    void pressures(double approach, Eigen::VectorXd& p);
    /// The approach at which the pressures add up to `load`: (load + z.v)/z.z; the set must not be empty.
    double approach_at(double load) const;
    /// w = H_AA^-1 1, size() entries
    void tangent(Eigen::VectorXd& w);
    /// sum of w
    double stiffness() const;
    /// Bytes of a factor with `size` rows.
    static double bytes(Index size) { return 4.0 * static_cast<double>(size + 8) * static_cast<double>(size + 8); }

  private:
    void resize();
    void cut(Index size);
    void move_row_heads(Index panel, const std::vector<Index>& sources, Index columns);
    Index build_panel(Index panel, Index first_block);
    void fill_influence(Index panel, Index first_column);
    void back_substitute(Eigen::VectorXd padded, Eigen::VectorXd& x);
    PanelFactor factor();

    const Influence& influence_;
    const Eigen::VectorXd& gap_;
    std::vector<int> nodes_, places_;
    std::vector<AlignedBuffer<double>> panels_;              ///< panel b: 8 (b + 1) columns of 8 rows
    std::vector<double*> rows_;                              ///< data of each panel
    std::vector<double> inverse_diagonal_, one_, gap_image_; ///< 1/L_ii, z, v, padded to whole panels
};

} // namespace rough
