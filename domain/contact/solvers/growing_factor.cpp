#include "domain/contact/solvers/growing_factor.hpp"

namespace rough {
namespace {

constexpr Index width = panel_width;
/// Smallest accepted pivot over the diagonal of H. Pivots of a contact set are some hundredths of it. Only
/// those of all nodes of a periodic profile, whose matrix is singular, are of the size of rounding.
constexpr double min_pivot = 1e-10;

Eigen::Map<const Eigen::VectorXd> vector(const std::vector<double>& values) {
    return {values.data(), static_cast<Index>(values.size())};
}

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

/// Fits the arrays that belong to the nodes to their number.
void GrowingFactor::resize() {
    const std::size_t known = std::min(places_.size(), nodes_.size());
    places_.resize(nodes_.size());
    for (std::size_t k = known; k < nodes_.size(); ++k) places_[k] = influence_.place(nodes_[k]);
    const auto padded = static_cast<std::size_t>((size() + width - 1) / width * width);
    inverse_diagonal_.resize(padded);
    one_.resize(padded);
    gap_image_.resize(padded);
}

void GrowingFactor::cut(Index size) {
    nodes_.resize(static_cast<std::size_t>(size));
    resize();
    const auto padded = one_.size();
    if (size % width == 0) return;
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
    if (positions.empty()) return;
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
    for (Index panel = head; panel < panels; ++panel) move_row_heads(panel, sources, head * width);
    for (Index panel = head; panel < panels; ++panel) build_panel(panel, head);
}

/// The rows of `panel` take the first `columns` columns of the rows they come from.
void GrowingFactor::move_row_heads(Index panel, const std::vector<Index>& sources, Index columns) {
    const Index first = panel * width - columns;
    const Index filled = std::min(width, static_cast<Index>(sources.size()) - first);
    double* target = rows_[static_cast<std::size_t>(panel)];
    for (Index r = 0; r < width; ++r) {
        const Index source = r < filled ? sources[static_cast<std::size_t>(first + r)] : 0;
        const double* from = rows_[static_cast<std::size_t>(source / width)] + source % width;
        for (Index j = 0; j < columns; ++j) target[width * j + r] = r < filled ? from[width * j] : 0;
    }
}

/// H's entries of a panel's rows from `first_column` on, and rows of the identity past the end.
void GrowingFactor::fill_influence(Index panel, Index first_column) {
    double* rows = rows_[static_cast<std::size_t>(panel)];
    const Index first = panel * width, filled = std::min(width, size() - first), columns = first + width;
    for (Index j = first_column; j < std::min(columns, size()); ++j) {
        const double* h = influence_.centre() + places_[static_cast<std::size_t>(j)];
        for (Index r = 0; r < width; ++r)
            rows[width * j + r] = r < filled ? h[-places_[static_cast<std::size_t>(first + r)]] : 0;
    }
    for (Index j = size(); j < columns; ++j)
        for (Index r = 0; r < width; ++r) rows[width * j + r] = first + r == j;
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
    return vector_loops().eliminate(factor(), panel, first_block, one, gap, min_pivot);
}

PanelFactor GrowingFactor::factor() { return {rows_.data(), inverse_diagonal_.data(), one_.data(), gap_image_.data()}; }

/// Sets x to the first size() entries of L^-T `padded`, which has an entry for each row of whole panels.
void GrowingFactor::back_substitute(Eigen::VectorXd padded, Eigen::VectorXd& x) {
    vector_loops().back_substitute(factor(), padded.size() / width, padded.data());
    x = padded.head(size());
}

void GrowingFactor::pressures(double approach, Eigen::VectorXd& p) {
    back_substitute(approach * vector(one_) - vector(gap_image_), p);
}

void GrowingFactor::tangent(Eigen::VectorXd& w) { back_substitute(vector(one_), w); }

double GrowingFactor::approach_at(double load) const {
    return (load + vector(one_).dot(vector(gap_image_))) / stiffness();
}

double GrowingFactor::stiffness() const { return vector(one_).squaredNorm(); }

} // namespace rough
