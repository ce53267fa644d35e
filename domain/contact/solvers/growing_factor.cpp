#include "domain/contact/solvers/growing_factor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rough {

namespace {

constexpr Index width = 8;
/// Over the diagonal of H. Pivots of a contact set are some hundredths of it; only all nodes of a periodic
/// profile together, a singular matrix, leave nothing but rounding.
constexpr double least_pivot = 1e-10;
/// Eight rows of one column; the compiler maps it to whatever vectors the processor has.
typedef double Lanes __attribute__((vector_size(width * sizeof(double)), may_alias));

const Lanes& lanes(const double* p) { return *reinterpret_cast<const Lanes*>(p); }
Lanes& lanes(double* p) { return *reinterpret_cast<Lanes*>(p); }

/// columns[c] -= sum_{i < depth} panel(:, i) head(c, i), c = 0..7
inline void eliminate(const double* panel, const double* head, Index depth, Lanes columns[width]) {
    Lanes c0 = columns[0], c1 = columns[1], c2 = columns[2], c3 = columns[3], c4 = columns[4],
          c5 = columns[5], c6 = columns[6], c7 = columns[7];
    for (Index i = 0; i < depth; ++i) {
        const Lanes x = lanes(panel + width * i);
        const double* h = head + width * i;
        c0 -= x * h[0];
        c1 -= x * h[1];
        c2 -= x * h[2];
        c3 -= x * h[3];
        c4 -= x * h[4];
        c5 -= x * h[5];
        c6 -= x * h[6];
        c7 -= x * h[7];
    }
    columns[0] = c0, columns[1] = c1, columns[2] = c2, columns[3] = c3, columns[4] = c4, columns[5] = c5,
    columns[6] = c6, columns[7] = c7;
}

/// one -= sum_{i < depth} panel(:, i) z_i, gap -= sum panel(:, i) v_i; in four strands that need not wait for
/// each other
inline void eliminate(const double* panel, const double* z, const double* v, Index depth, Lanes& one,
                      Lanes& gap) {
    Lanes ones[4] = {one}, gaps[4] = {gap};
    for (Index i = 0; i < depth; i += 4)
        for (Index k = 0; k < 4; ++k) {
            const Lanes x = lanes(panel + width * (i + k));
            ones[k] -= x * z[i + k];
            gaps[k] -= x * v[i + k];
        }
    one = (ones[0] + ones[1]) + (ones[2] + ones[3]);
    gap = (gaps[0] + gaps[1]) + (gaps[2] + gaps[3]);
}

/// The sum of each of eight vectors, by three rounds of halving.
inline Lanes sum_each(const Lanes v[width]) {
    Lanes pairs[4], fours[2];
    for (int k = 0; k < 4; ++k)
        pairs[k] = __builtin_shufflevector(v[2 * k], v[2 * k + 1], 0, 8, 2, 10, 4, 12, 6, 14) +
                   __builtin_shufflevector(v[2 * k], v[2 * k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
    for (int k = 0; k < 2; ++k)
        fours[k] = __builtin_shufflevector(pairs[2 * k], pairs[2 * k + 1], 0, 1, 8, 9, 4, 5, 12, 13) +
                   __builtin_shufflevector(pairs[2 * k], pairs[2 * k + 1], 2, 3, 10, 11, 6, 7, 14, 15);
    return __builtin_shufflevector(fours[0], fours[1], 0, 1, 2, 3, 8, 9, 10, 11) +
           __builtin_shufflevector(fours[0], fours[1], 4, 5, 6, 7, 12, 13, 14, 15);
}

} // namespace

GrowingFactor::GrowingFactor(const Eigen::VectorXd& influence_column, const Eigen::VectorXd& gap)
    : influence_(static_cast<std::size_t>(2 * influence_column.size() - 1)), gap_(gap) {
    const Index n = influence_column.size();
    double* centre = influence_.data() + (n - 1);
    for (Index i = 0; i < n; ++i)
        centre[i] = centre[-i] = influence_column[i];
    centre_ = centre;
}

Index GrowingFactor::append(const std::vector<int>& nodes) {
    const Index before = size();
    nodes_.insert(nodes_.end(), nodes.begin(), nodes.end());
    const Index count = size(), panels = (count + width - 1) / width;
    resize_vectors();
    while (static_cast<Index>(panels_.size()) < panels)
        panels_.emplace_back(width * width * (static_cast<Index>(panels_.size()) + 1));
    for (Index panel = before / width; panel < panels; ++panel) {
        const Index failed = build_panel(panel, 0);
        if (failed < width) {
            cut(std::max(before, width * panel + failed));
            break;
        }
    }
    return size() - before;
}

void GrowingFactor::resize_vectors() {
    const auto padded = static_cast<std::size_t>((size() + width - 1) / width * width);
    inverse_diagonal_.resize(padded);
    one_.resize(padded);
    gap_image_.resize(padded);
}

void GrowingFactor::cut(Index size) {
    nodes_.resize(static_cast<std::size_t>(size));
    resize_vectors();
    const auto padded = one_.size();
    if (size % width == 0)
        return;
    // Rows past the end of the last panel become rows of the identity, so that whole panels can be worked on.
    double* last = panels_[padded / width - 1].data();
    for (Index row = size % width; row < width; ++row) {
        const std::size_t index = padded - width + static_cast<std::size_t>(row);
        for (std::size_t column = 0; column < padded; ++column)
            last[column * width + static_cast<std::size_t>(row)] = column == index;
        inverse_diagonal_[index] = 1;
        one_[index] = gap_image_[index] = 0;
    }
}

void GrowingFactor::remove(const std::vector<Index>& positions) {
    const Index head = positions.front() / width; // panels before it stay as they are
    std::vector<Index> sources;                   // where each row from panel `head` on comes from
    std::vector<int> kept;
    auto removed = positions.begin();
    for (Index row = head * width; row < size(); ++row) {
        if (removed != positions.end() && *removed == row) {
            ++removed;
        } else {
            sources.push_back(row);
            kept.push_back(nodes_[static_cast<std::size_t>(row)]);
        }
    }
    cut(head * width);
    nodes_.insert(nodes_.end(), kept.begin(), kept.end());
    resize_vectors();
    const Index panels = static_cast<Index>(one_.size()) / width;
    for (Index panel = head; panel < panels; ++panel)
        move_row_heads(panel, sources, head * width);
    for (Index panel = head; panel < panels; ++panel)
        build_panel(panel, head);
}

/// The rows of `panel` take the first `columns` columns of the rows they come from.
void GrowingFactor::move_row_heads(Index panel, const std::vector<Index>& sources, Index columns) {
    const Index first = panel * width - columns;
    const Index filled = std::min(width, static_cast<Index>(sources.size()) - first);
    const double* from[width];
    for (Index r = 0; r < filled; ++r) {
        const Index source = sources[static_cast<std::size_t>(first + r)];
        from[r] = panels_[static_cast<std::size_t>(source / width)].data() + source % width;
    }
    double* target = panels_[static_cast<std::size_t>(panel)].data();
    for (Index j = 0; j < columns; ++j) {
        Lanes row{};
        for (Index r = 0; r < filled; ++r)
            row[r] = from[r][width * j];
        lanes(target + width * j) = row;
    }
}

/// H's entries of a panel's rows from `first_column` on, and rows of the identity past the end.
void GrowingFactor::fill_influence(Index panel, Index first_column) {
    double* rows = panels_[static_cast<std::size_t>(panel)].data();
    const Index first = panel * width, filled = std::min(width, size() - first), columns = first + width;
    std::ptrdiff_t own[width] = {};
    for (Index r = 0; r < filled; ++r)
        own[r] = nodes_[static_cast<std::size_t>(first + r)];
    for (Index j = first_column; j < std::min(columns, size()); ++j) {
        const double* h = centre_ + nodes_[static_cast<std::size_t>(j)];
        double* entry = rows + width * j;
        if (filled == width)
            for (Index r = 0; r < width; ++r)
                entry[r] = h[-own[r]];
        else
            for (Index r = 0; r < width; ++r)
                entry[r] = r < filled ? h[-own[r]] : 0;
    }
    for (Index j = size(); j < columns; ++j)
        for (Index r = 0; r < width; ++r)
            rows[width * j + r] = first + r == j;
}

/// Eliminates a panel's rows; the blocks of columns before `first_block` are already those of L.
/// Returns the first row whose pivot is not positive, or `width`.
Index GrowingFactor::build_panel(Index panel, Index first_block) {
    double* rows = panels_[static_cast<std::size_t>(panel)].data();
    const Index first = panel * width, filled = std::min(width, size() - first);
    fill_influence(panel, first_block * width);

    Lanes block[width];
    for (Index b = first_block; b < panel; ++b) {
        const double* head = panels_[static_cast<std::size_t>(b)].data();
        double* target = rows + width * width * b;
        for (Index c = 0; c < width; ++c)
            block[c] = lanes(target + width * c);
        eliminate(rows, head, width * b, block);
        const double* diagonal = head + width * width * b;
        const double* inverse = inverse_diagonal_.data() + width * b;
        for (Index c = 0; c < width; ++c) {
            for (Index k = 0; k < c; ++k)
                block[c] -= block[k] * diagonal[width * k + c];
            block[c] *= inverse[c];
            lanes(target + width * c) = block[c];
        }
    }

    Lanes one{}, gap{};
    for (Index r = 0; r < filled; ++r) {
        one[r] = 1;
        gap[r] = gap_[nodes_[static_cast<std::size_t>(first + r)]];
    }
    eliminate(rows, one_.data(), gap_image_.data(), first, one, gap);

    double* target = rows + width * first;
    double original[width];
    for (Index c = 0; c < width; ++c) {
        block[c] = lanes(target + width * c);
        original[c] = block[c][c];
    }
    eliminate(rows, rows, first, block);
    for (Index c = 0; c < width; ++c) {
        const double pivot = block[c][c];
        if (!(pivot > least_pivot * original[c]))
            return c;
        const auto index = static_cast<std::size_t>(first + c);
        const double inverse = 1 / std::sqrt(pivot);
        inverse_diagonal_[index] = inverse;
        Lanes column = block[c] * inverse;
        for (Index r = 0; r < c; ++r)
            column[r] = 0;
        lanes(target + width * c) = column;
        for (Index k = c + 1; k < width; ++k)
            block[k] -= column * column[k];
        one_[index] = one[c] * inverse;
        gap_image_[index] = gap[c] * inverse;
        one -= column * one_[index];
        gap -= column * gap_image_[index];
    }
    return width;
}

void GrowingFactor::back_substitute(Eigen::VectorXd& x) const {
    const Index panels = x.size() / width;
    for (Index b = panels - 1; b >= 0; --b) {
        Lanes sums[width] = {};
        for (Index below = b + 1; below < panels; ++below) {
            const double* rows = panels_[static_cast<std::size_t>(below)].data() + width * width * b;
            Lanes known;
            for (Index r = 0; r < width; ++r)
                known[r] = x[width * below + r];
            for (Index c = 0; c < width; ++c)
                sums[c] += lanes(rows + width * c) * known;
        }
        const double* diagonal = panels_[static_cast<std::size_t>(b)].data() + width * width * b;
        const Lanes sum = sum_each(sums);
        for (Index c = width - 1; c >= 0; --c) {
            double value = x[width * b + c] - sum[c];
            for (Index r = width - 1; r > c; --r) // the latest last, so that only it is waited for
                value -= diagonal[width * c + r] * x[width * b + r];
            x[width * b + c] = value * inverse_diagonal_[static_cast<std::size_t>(width * b + c)];
        }
    }
}

void GrowingFactor::pressures(double approach, Eigen::VectorXd& p) {
    const auto padded = static_cast<Index>(one_.size());
    padded_ = approach * Eigen::Map<const Eigen::VectorXd>(one_.data(), padded) -
              Eigen::Map<const Eigen::VectorXd>(gap_image_.data(), padded);
    back_substitute(padded_);
    p = padded_.head(size());
}

void GrowingFactor::tangent(Eigen::VectorXd& w) {
    padded_ = Eigen::Map<const Eigen::VectorXd>(one_.data(), static_cast<Index>(one_.size()));
    back_substitute(padded_);
    w = padded_.head(size());
}

double GrowingFactor::stiffness() const {
    return Eigen::Map<const Eigen::VectorXd>(one_.data(), static_cast<Index>(one_.size())).squaredNorm();
}

} // namespace rough
