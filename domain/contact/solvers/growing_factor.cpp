#include "domain/contact/solvers/growing_factor.hpp"

#include "domain/numerics/vector_loops.hpp"

#include <algorithm>

namespace rough {

namespace {

constexpr Index width = panel_width;
/// Over the diagonal of H. Pivots of a contact set are some hundredths of it; only all nodes of a periodic
/// profile together, a singular matrix, leave nothing but rounding.
constexpr double least_pivot = 1e-10;

} // namespace

Index GrowingFactor::append(const std::vector<int>& nodes) {
    const Index before = size();
    nodes_.insert(nodes_.end(), nodes.begin(), nodes.end());
    const Index count = size(), panels = (count + width - 1) / width;
    resize();
    while (static_cast<Index>(panels_.size()) < panels) {
        panels_.emplace_back(width * width * (static_cast<Index>(panels_.size()) + 1));
        rows_.push_back(panels_.back().data());
    }
    for (Index panel = before / width; panel < panels; ++panel) {
        const Index failed = build_panel(panel, 0);
        if (failed < width) {
            cut(std::max(before, width * panel + failed));
            break;
        }
    }
    return size() - before;
}

/// What goes with the nodes follows them.
void GrowingFactor::resize() {
    const std::size_t known = std::min(places_.size(), nodes_.size());
    places_.resize(nodes_.size());
    for (std::size_t k = known; k < nodes_.size(); ++k)
        places_[k] = influence_.place(nodes_[k]);
    const auto padded = static_cast<std::size_t>((size() + width - 1) / width * width);
    inverse_diagonal_.resize(padded);
    one_.resize(padded);
    gap_image_.resize(padded);
}

void GrowingFactor::cut(Index size) {
    nodes_.resize(static_cast<std::size_t>(size));
    resize();
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
    if (positions.empty())
        return;
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
    resize();
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
    const double* from[width] = {};
    for (Index r = 0; r < filled; ++r) {
        const Index source = sources[static_cast<std::size_t>(first + r)];
        from[r] = panels_[static_cast<std::size_t>(source / width)].data() + source % width;
    }
    double* target = panels_[static_cast<std::size_t>(panel)].data();
    vector_loops().move_rows(from, filled, columns, target);
}

/// H's entries of a panel's rows from `first_column` on, and rows of the identity past the end.
void GrowingFactor::fill_influence(Index panel, Index first_column) {
    double* rows = panels_[static_cast<std::size_t>(panel)].data();
    const Index first = panel * width, filled = std::min(width, size() - first), columns = first + width;
    if (const Index last = std::min(columns, size()); last > first_column)
        vector_loops().fill(influence_.centre(), places_.data() + first, filled,
                            places_.data() + first_column, last - first_column, rows + width * first_column);
    for (Index j = size(); j < columns; ++j)
        for (Index r = 0; r < width; ++r)
            rows[width * j + r] = first + r == j;
}

/// Eliminates a panel's rows; the blocks of columns before `first_block` are already those of L.
/// Returns the first row whose pivot is not positive, or `width`.
Index GrowingFactor::build_panel(Index panel, Index first_block) {
    const Index first = panel * width, filled = std::min(width, size() - first);
    fill_influence(panel, first_block * width);
    double one[width] = {}, gap[width] = {};
    for (Index r = 0; r < filled; ++r) {
        one[r] = 1;
        gap[r] = gap_[nodes_[static_cast<std::size_t>(first + r)]];
    }
    return vector_loops().eliminate({rows_.data(), inverse_diagonal_.data(), one_.data(), gap_image_.data()},
                                    panel, first_block, one, gap, least_pivot);
}

void GrowingFactor::back_substitute(Eigen::VectorXd& x) {
    vector_loops().back_substitute({rows_.data(), inverse_diagonal_.data(), one_.data(), gap_image_.data()},
                                   x.size() / width, x.data());
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

double GrowingFactor::approach_at(double load) const {
    const auto padded = static_cast<Index>(one_.size());
    const double moment = Eigen::Map<const Eigen::VectorXd>(one_.data(), padded)
                              .dot(Eigen::Map<const Eigen::VectorXd>(gap_image_.data(), padded));
    return (load + moment) / stiffness();
}

double GrowingFactor::stiffness() const {
    return Eigen::Map<const Eigen::VectorXd>(one_.data(), static_cast<Index>(one_.size())).squaredNorm();
}

} // namespace rough
