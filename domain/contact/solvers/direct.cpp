#include "domain/contact/solvers/direct.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace rough {

namespace {

constexpr Index width = 8, strands = 8, block = width * strands;
typedef double Lanes __attribute__((vector_size(width * sizeof(double))));

Lanes loaded(const double* p) {
    Lanes x;
    std::memcpy(&x, p, sizeof x);
    return x;
}

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
    const double* centre = mirrored_.data() + (nodes_ - 1);
    for (Index first = 0; first < padded_; first += block) {
        Lanes sums[strands] = {};
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            const double p = pressure[static_cast<Index>(k)];
            const double* h = centre + (first - nodes[k]);
            for (Index s = 0; s < strands; ++s)
                sums[s] += loaded(h + width * s) * p;
        }
        std::memcpy(displacement_.data() + first, sums, sizeof sums);
    }
    return displacement_.data();
}

} // namespace rough
