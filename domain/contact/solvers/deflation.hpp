#pragma once

#include "domain/contact/solvers/problem.hpp"

#include <Eigen/Cholesky>

namespace rough {

/// What a circulant preconditioner cannot see: the mean pressure of each run of neighbouring contact nodes,
/// through which distant runs feel each other. Deflated conjugate gradients (Saad, Yeung, Erhel & Guyomarc'h
/// 2000) keep their residual free of it, which halves the iterations. W's columns are indicators of runs, so
/// HW needs only sums of H's first column. Short of 64 columns each run has its own; otherwise neighbouring
/// runs share one.
class Deflation {
  public:
    /// `nodes` sorted; `sums` from cumulative(), or nothing, which deflates nothing.
    Deflation(const std::vector<int>& nodes, const Eigen::VectorXd& sums);

    /// Returns what is to be added to x to make the residual orthogonal to W, and makes it so.
    Eigen::VectorXd project(Eigen::VectorXd& residual) const;
    /// Takes from z what would bring W into the search.
    void purge(Eigen::VectorXd& z) const;

  private:
    Eigen::VectorXd reduced(const Eigen::VectorXd& v) const;           ///< W'v
    void subtract(const Eigen::VectorXd& c, Eigen::VectorXd& v) const; ///< v -= W c

    std::vector<Index> begins_; ///< where each column's nodes begin, and the end
    Eigen::MatrixXd image_;     ///< HW on the contact set
    Eigen::LLT<Eigen::MatrixXd> energy_;
    bool usable_;
};

/// Of the first column h_0 .. h_(N-1) the sums of h_|k| from k = -(N-1) up to x, at N + x for x = -N .. N-1.
Eigen::VectorXd cumulative(const Eigen::VectorXd& column);

} // namespace rough
