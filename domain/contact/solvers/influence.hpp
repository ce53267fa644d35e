#pragma once

#include "domain/numerics/aligned.hpp"
#include "domain/numerics/vector_loops.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rough {

/// H's entries by the offset of two nodes, laid out for loops along x. Each node has a place, and the entry
/// of two nodes is stored at the difference of their places from the centre. The places of a line are its
/// nodes. Rows of a map are so far apart that no offset along x reaches the next row.
class Influence {
  public:
    /// From the first column of N entries.
    Influence(const Eigen::VectorXd& first_column, Extent shape)
        : shape_(shape), padded_((shape_.columns + block - 1) / block * block), stride_(shape_.columns - 1 + padded_),
          table_((2 * shape_.rows - 1) * stride_) {
        std::fill_n(table_.data(), (2 * shape_.rows - 1) * stride_, 0.0);
        double* middle = table_.data() + (shape_.rows - 1) * stride_ + shape_.columns - 1;
        for (Index j = 0; j < shape_.rows; ++j)
            for (Index i = 0; i < shape_.columns; ++i)
                for (double* row : {middle + j * stride_, middle - j * stride_})
                    row[i] = row[-i] = first_column[j * shape_.columns + i];
        centre_ = middle;
    }

    static constexpr Index block = 64; ///< loops over a row take whole blocks of this many numbers

    Extent shape() const { return shape_; }          ///< N_x, N_y
    Index padded_columns() const { return padded_; } ///< N_x in whole blocks, which may all be read
    Index stride() const { return stride_; }         ///< places from one row to the next
    /// The entry of the offset 0.
    const double* centre() const { return centre_; }
    /// The place of a node.
    int place(int node) const {
        const int columns = static_cast<int>(shape_.columns);
        return shape_.rows == 1 ? node : node + node / columns * (static_cast<int>(stride_) - columns);
    }

  private:
    Extent shape_;
    Index padded_, stride_;
    AlignedBuffer<double> table_;
    const double* centre_;
};

/// u = H p by its sums, for pressures on few nodes: there a transform would mostly turn zeros. One object
/// serves one thread at a time.
class DirectOperator {
  public:
    /// `influence` must outlive it.
    explicit DirectOperator(const Influence& influence)
        : influence_(influence), displacement_(influence.shape().nodes() + influence.padded_columns()) {}

    /// Pressures on these nodes, in this order; u at every node (N entries), valid until the next call.
    const double* apply(const std::vector<int>& nodes, const Eigen::VectorXd& pressure) {
        places_.clear();
        for (const int node : nodes) places_.push_back(influence_.place(node));
        const Index columns = influence_.shape().columns;
        for (Index j = 0; j < influence_.shape().rows; ++j) // each row's end is the next one's to write
            vector_loops().toeplitz(influence_.centre() + j * influence_.stride(), influence_.padded_columns(),
                                    places_.data(), pressure.data(), static_cast<Index>(nodes.size()),
                                    displacement_.data() + j * columns);
        return displacement_.data();
    }

    /// Whether direct sums over `loaded` nodes cost less than a Fourier operator's two transforms of M = 2 N numbers.
    /// The rule is fixed: each of the M log2 M operations of a transform costs as much as four multiplications.
    bool pays(std::size_t loaded) const {
        return static_cast<double>(loaded) <= 4 * 2 * std::log2(2 * static_cast<double>(influence_.shape().nodes()));
    }

  private:
    const Influence& influence_;
    AlignedBuffer<double> displacement_; ///< and room for a row in whole blocks
    std::vector<int> places_;
};

} // namespace rough
