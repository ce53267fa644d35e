#include "domain/contact/solvers/influence.hpp"

#include "domain/numerics/vector_loops.hpp"

#include <algorithm>
#include <cmath>

namespace rough {

namespace {

/// Multiplications that are worth one of the M log2 M turns of two transforms of M = 2 N numbers: these have
/// a cost of their own besides, and sums run through their numbers in order.
constexpr double per_turn = 4;

} // namespace

DirectOperator::DirectOperator(const Influence& influence)
    : influence_(influence),
      most_loaded_(
          static_cast<Index>(per_turn * 2 * std::log2(2 * static_cast<double>(influence.shape().nodes())))),
      displacement_(influence.shape().nodes() + influence.padded_columns()) {}

const double* DirectOperator::apply(const std::vector<int>& nodes, const Eigen::VectorXd& pressure) {
    places_.clear();
    for (const int node : nodes)
        places_.push_back(influence_.place(node));
    const Index columns = influence_.shape().columns;
    for (Index j = 0; j < influence_.shape().rows; ++j) // each row's end is the next one's to write
        vector_loops().toeplitz(influence_.centre() + j * influence_.stride(), influence_.padded_columns(),
                                places_.data(), pressure.data(), static_cast<Index>(nodes.size()),
                                displacement_.data() + j * columns);
    return displacement_.data();
}

} // namespace rough
