#pragma once

#include "domain/contact/solvers/extension.hpp"
#include "domain/contact/solvers/problem.hpp"

namespace rough {

/// A contact set during an iterative solution: sorted nodes, and the same as a mask over all nodes.
class ContactSet {
  public:
    /// Nothing touches. The team shares loops over all nodes.
    explicit ContactSet(Index nodes, Team& team = Team::alone())
        : team_(team), touching_(static_cast<std::size_t>(nodes), 0) {}
    const std::vector<int>& nodes() const { return nodes_; } ///< increasing; as of the last collect()
    /// N entries, 1 if the node touches; up to date at any time.
    const std::vector<char>& touching() const { return touching_; }
    ///@{
    /// Whether a node touches, and changes of it. collect() is to be called after the last change.
    bool holds(Index node) const { return touching_[static_cast<std::size_t>(node)] != 0; }
    void insert(Index node) { touching_[static_cast<std::size_t>(node)] = 1; }
    void erase(Index node) { touching_[static_cast<std::size_t>(node)] = 0; }
    void collect();
    ///@}
    /// Puts exactly those nodes into contact for which touches(node) is true.
    template <class Touches>
    void assign(Touches touches) {
        team_.each(static_cast<Index>(touching_.size()),
                   [&](Index i) { touching_[static_cast<std::size_t>(i)] = touches(i); });
        collect();
    }

  private:
    Team& team_;
    std::vector<int> nodes_;
    std::vector<char> touching_;
};

/// A vector that is zero off the contact set, and H times it at every node.
struct SurfaceState {
    Eigen::VectorXd pressure;     ///< p, N entries, in the problem's units
    Eigen::VectorXd displacement; ///< u = H p as of its last update by the solver, N entries
    /// The pressures whose product the displacements are, so that only the product of a change is needed.
    /// Empty if that is not wanted.
    Eigen::VectorXd updated;
    double displacement_error = 0; ///< bound of the displacements' error by products in single precision
    /// No load.
    explicit SurfaceState(Index nodes) : pressure(Eigen::VectorXd::Zero(nodes)), displacement(pressure) {}
};

/// Condition at which an improvement may end: the residual or, if given, a low enough energy.
struct Enough {
    double residual = 0;                     ///< largest |b - H x| on A
    std::function<bool(double)> energy = {}; ///< called with r' M^-1 r, the error's energy; M is the preconditioner
};

/// Conjugate gradients for H_AA x = b on a fixed contact set A, with H applied by FFT. The preconditioner is
/// the inverse of the circulant nearest to H (T. Chan 1988), restricted to A. Off A the residual is taken as
/// zero on a line, and is continued on a map (extension.hpp). Directions are multiplied in single precision,
/// or in double if that gains nothing; the residual is recomputed in double (Carson & Higham 2018).
class SetSolver {
  public:
    /// Transforms the problem's first column and its preconditioner's once.
    explicit SetSolver(const ContactProblem& problem);

    /// Recomputes u = H p.
    void update(SurfaceState& x);
    /// Updates u = H p with an error of at most `accuracy` at each node. If that is accurate enough, it adds
    /// the product of the change since the last update, in single precision.
    void update(SurfaceState& x, double accuracy);
    /// Improves x, whose displacements must be up to date, until it is good enough. On a map the
    /// displacements are then up to date at every node. On a line they are so on A, or not changed if
    /// x.updated is kept. Returns false if `limit` iterations are not enough or rounding stops it.
    ///
    /// With a `level`, on a map only, the sum of x is kept. b is met up to a constant, which is written to `level`: b -
    /// level = H x. The gradients sum to zero (Gould, Hribar & Nocedal 2001). If `projected`, no pressure then falls
    /// below zero: the improvement ends with a step that would take one there. This step has the usual length and is
    /// projected, so that those pressures become 0 (projected Newton's method, Bertsekas 1982). One product serves the
    /// step and the nodes that leave contact. Afterwards the sum has to be restored.
    bool improve(const ContactSet& set, const std::function<double(Index)>& target, SurfaceState& x,
                 const Enough& enough, long limit, double* level = nullptr, bool projected = true);
    /// Solves H_AA w = 1 from any w: as well as `stiffness` needs it to have `tolerance`, or each of its
    /// entries. On a map w.displacement is then up to date at every node.
    void tangent(const ContactSet& set, double tolerance, bool each_entry, SurfaceState& w);

    long applies() const { return applies_; } ///< products with H so far, in either precision

  private:
    /// image = M v on the nodes only, which stand at `places` of M; `scale` is about the size of v. With an
    /// extension E, E'M E.
    template <typename Real>
    void multiply(BasicFourierOperator<Real>& matrix, const std::vector<int>& places, const Eigen::VectorXd& v,
                  double scale, Eigen::VectorXd& image, Extension* extension = nullptr) const;
    /// Places of nodes on the preconditioner's grid.
    std::vector<int> inverse_places(const std::vector<int>& nodes) const;
    bool is_2d() const { return sums_.size() == 0; }

    Team& team_;
    Extent shape_;
    Eigen::VectorXd sums_; ///< sums of H's first column, for the deflation; empty on a map
    FourierOperator forward_;
    SingleFourierOperator single_;
    Extent inverse_shape_; ///< grid of the circulant; the surface is a part at its origin
    SingleFourierOperator inverse_;
    std::optional<Extension> extension_; ///< on a map
    long applies_ = 0;
    double usual_step_ = 0.9; ///< length of the first step of the last improvement with a level
};

/// Error of the load sum p that the remaining residual r on A causes: w'r.
double missing_load(const ContactProblem& problem, double approach, const ContactSet& set, const SurfaceState& load,
                    const SurfaceState& tangent);

/// A step's solution from vectors over all nodes. K = 2 sum w - w'Hw: its error is the square of w's.
StepSolution step_solution(const ContactSet& set, const SurfaceState& load, const SurfaceState& tangent,
                           bool with_tangent);

} // namespace rough
