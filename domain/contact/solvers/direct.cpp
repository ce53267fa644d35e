#include "domain/contact/solvers/direct.hpp"

#include "domain/numerics/vector_loops.hpp"

#include <algorithm>
#include <cmath>

namespace rough {

namespace {

constexpr Index block = 64; ///< of which the loop takes whole ones

/// Multiplications that are worth one of the M log2 M turns of two transforms of M = 2 N numbers: these have
/// a cost of their own besides, and sums run through their numbers in order.
constexpr double per_turn = 4;

} // namespace

DirectOperator::DirectOperator(const Eigen::VectorXd& first_column)
    : nodes_(first_column.size()), padded_((nodes_ + block - 1) / block * block),
      most_loaded_(static_cast<Index>(per_turn * 2 * std::log2(2 * static_cast<double>(nodes_)))),
      mirrored_(nodes_ - 1 + padded_), displacement_(padded_) {
    double* centre = mirrored_.data() + (nodes_ - 1);
    for (Index i = 0; i < nodes_; ++i)
        centre[i] = centre[-i] = first_column[i];
    std::fill(centre + nodes_, centre + padded_, 0.0);
}

const double* DirectOperator::apply(const std::vector<int>& nodes, const Eigen::VectorXd& pressure) {
    vector_loops().toeplitz(mirrored_.data() + (nodes_ - 1), padded_, nodes.data(), pressure.data(),
                            static_cast<Index>(nodes.size()), displacement_.data());
    return displacement_.data();
}

} // namespace rough
