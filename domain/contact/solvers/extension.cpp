#include "domain/contact/solvers/extension.hpp"

#include <cmath>

namespace rough {
namespace {

/// The sum of four squares' weights that fills the next wider square. A field of 1 on a spot falls off outside like its
/// potential. The spot's size measures the potential (2), its area would give a steeper fall (4).
const float filling = std::exp2(1.4F);
/// A full square's weight.
constexpr float firmness = 0.7F;

/// Rows of parents that one thread takes at a time.
constexpr Index rows_together = 16;

/// Calls visit(square, parent) for all of a level; those of one parent by the same thread, in order.
template <class Visit>
void each_child(Team& team, Extent shape, Visit visit) {
    const Index above = (shape.columns + 1) / 2;
    team.each_range(
        shape.rows,
        [&](Index first, Index count, int) {
            for (Index j = first; j < first + count; ++j)
                for (Index i = 0; i < shape.columns; ++i)
                    visit(static_cast<std::size_t>(j * shape.columns + i),
                          static_cast<std::size_t>(j / 2 * above + i / 2));
        },
        2 * rows_together);
}

/// The second nearest coarse row of row j of the fine grid. `rows` is the number of coarse rows, which are periodic.
Index beside(Index j, Index rows) { return (j / 2 + (j % 2 ? 1 : rows - 1)) % rows; }

constexpr float nearer = 0.75F, farther = 0.25F; // weights of the nearer and the farther of two squares

} // namespace

Extension::Level::Level(Extent below)
    : shape{(below.columns + 1) / 2, (below.rows + 1) / 2}, value(static_cast<std::size_t>(shape.nodes())),
      weight(value.size()), share(value.size()) {}

Extension::Extension(Extent shape, Team& team) : team_(team), shape_(shape), levels_{Level(shape)} {
    work_.resize(static_cast<std::size_t>((3 * levels_[0].shape.columns + 4) * team.size()));
    while (levels_.back().shape.nodes() > 1) levels_.emplace_back(levels_.back().shape);
}

void Extension::know(std::vector<int> nodes) {
    nodes_ = std::move(nodes);
    parents_.resize(nodes_.size());
    shares_.resize(nodes_.size());
    known_.resize(nodes_.size());
    const int columns = static_cast<int>(shape_.columns), above = static_cast<int>(levels_[0].shape.columns);
    starts_.clear();
    for (Index row = 0; row < shape_.rows; row += 2 * rows_together)
        starts_.push_back(static_cast<std::size_t>(
            std::lower_bound(nodes_.begin(), nodes_.end(), static_cast<int>(row) * columns) - nodes_.begin()));
    starts_.push_back(nodes_.size());
    const auto weight_above = [&](std::size_t k) -> float& {
        return levels_[0].weight[static_cast<std::size_t>(parents_[k])];
    };
    clear(levels_[0].weight);
    each_node([&](std::size_t k) {
        parents_[k] = nodes_[k] / columns / 2 * above + nodes_[k] % columns / 2;
        weight_above(k) += 1;
    });
    each_node([&](std::size_t k) { shares_[k] = 1 / weight_above(k); });
    const auto fill = [](float& weight) { weight = std::min(1.0F, weight / filling); };
    for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
        Level &level = levels_[l], &next = levels_[l + 1];
        clear(next.weight);
        each_child(team_, level.shape, [&](std::size_t k, std::size_t parent) {
            fill(level.weight[k]);
            next.weight[parent] += level.weight[k];
        });
        each_child(team_, level.shape, [&](std::size_t k, std::size_t parent) {
            level.share[k] = level.weight[k] > 0 ? level.weight[k] / next.weight[parent] : 0;
            level.weight[k] *= firmness;
        });
    }
    fill(levels_.back().weight[0]);
}

void Extension::clear(std::vector<float>& values) {
    team_.each_range(static_cast<Index>(values.size()),
                     [&](Index first, Index count, int) { std::fill_n(values.data() + first, count, 0.0F); });
}

template <class Change>
void Extension::each_node(Change change) {
    team_.each_block(static_cast<Index>(starts_.size()) - 1, [&](Index range, int) {
        const auto at = static_cast<std::size_t>(range);
        for (std::size_t k = starts_[at]; k < starts_[at + 1]; ++k) change(k);
    });
}

void Extension::refine(const Level& from, Extent shape, const float* weight, float* into) {
    const Index columns = from.shape.columns;
    team_.each_range(
        shape.rows,
        [&](Index first, Index count, int worker) {
            float *line = work_.data() + worker * (3 * columns + 4) + 1, *row = line + columns + 1;
            for (Index j = first; j < first + count; ++j) {
                const float *here = from.value.data() + j / 2 * columns,
                            *there = from.value.data() + beside(j, from.shape.rows) * columns;
                for (Index i = 0; i < columns; ++i) line[i] = nearer * here[i] + farther * there[i];
                line[-1] = line[columns - 1];
                line[columns] = line[0];
                for (Index i = 0; i < columns; ++i) {
                    row[2 * i] = nearer * line[i] + farther * line[i - 1];
                    row[2 * i + 1] = nearer * line[i] + farther * line[i + 1];
                }
                float* to = into + j * shape.columns;
                if (!weight)
                    std::copy_n(row, shape.columns, to);
                else
                    for (Index i = 0; i < shape.columns; ++i)
                        to[i] = row[i] + weight[j * shape.columns + i] * (to[i] - row[i]);
            }
        },
        2 * rows_together);
}

void Extension::coarsen(float* from, Extent shape, const float* weight, Level& into) {
    const Index columns = into.shape.columns, rows = into.shape.rows;
    team_.each_range(
        rows,
        [&](Index first, Index count, int worker) {
            float *line = work_.data() + worker * (3 * columns + 4), *row = line + columns + 1;
            std::fill_n(into.value.data() + first * columns, count * columns, 0.0F);
            const auto add = [&](Index to, float share) {
                for (Index i = 0; i < columns; ++i)
                    into.value[static_cast<std::size_t>(to * columns + i)] += share * line[i];
            };
            const auto take = [&](Index j) {
                row[2 * columns - 1] = 0; // if the fine row has an odd length
                const float* at = from + j * shape.columns;
                if (!weight)
                    std::copy_n(at, shape.columns, row);
                else
                    for (Index i = 0; i < shape.columns; ++i) row[i] = at[i] - weight[j * shape.columns + i] * at[i];
                row[-1] = row[2 * columns - 1];
                row[2 * columns] = row[0];
                for (Index i = 0; i < columns; ++i)
                    line[i] = nearer * (row[2 * i] + row[2 * i + 1]) + farther * (row[2 * i - 1] + row[2 * i + 2]);
            };
            const Index end = first + count;
            // The neighbours of the range, across the ends of the grid, too; then the range itself.
            if (const Index before = 2 * (first > 0 ? first : rows) - 1; before < shape.rows) {
                take(before);
                add(first, farther);
            }
            for (Index j = 2 * first; j < std::min(2 * end, shape.rows); ++j) {
                take(j);
                add(j / 2, nearer);
                if (const Index other = j / 2 + (j % 2 ? 1 : -1); other >= first && other < end) add(other, farther);
            }
            take(2 * (end % rows));
            add(end - 1, farther);
        },
        rows_together);
    if (weight) team_.each(shape.nodes(), [&](Index k) { from[k] *= weight[k]; });
}

void Extension::extend(float* field) {
    clear(levels_[0].value);
    each_node([&](std::size_t k) {
        known_[k] = field[nodes_[k]];
        levels_[0].value[static_cast<std::size_t>(parents_[k])] += shares_[k] * known_[k];
    });
    for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
        const Level& fine = levels_[l];
        std::vector<float>& mean = levels_[l + 1].value;
        clear(mean);
        each_child(team_, fine.shape,
                   [&](std::size_t k, std::size_t parent) { mean[parent] += fine.share[k] * fine.value[k]; });
    }
    for (std::size_t l = levels_.size() - 1; l > 0; --l) {
        Level& fine = levels_[l - 1];
        refine(levels_[l], fine.shape, fine.weight.data(), fine.value.data());
    }
    refine(levels_[0], shape_, nullptr, field);
    each_node([&](std::size_t k) { field[nodes_[k]] = known_[k]; });
}

void Extension::transpose(float* field) {
    each_node([&](std::size_t k) {
        known_[k] = field[nodes_[k]];
        field[nodes_[k]] = 0;
    });
    coarsen(field, shape_, nullptr, levels_[0]);
    for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
        Level& fine = levels_[l];
        coarsen(fine.value.data(), fine.shape, fine.weight.data(), levels_[l + 1]);
    }
    for (std::size_t l = levels_.size() - 1; l > 0; --l) {
        Level& fine = levels_[l - 1];
        const std::vector<float>& mean = levels_[l].value;
        each_child(team_, fine.shape,
                   [&](std::size_t k, std::size_t parent) { fine.value[k] += fine.share[k] * mean[parent]; });
    }
    each_node([&](std::size_t k) {
        field[nodes_[k]] = known_[k] + shares_[k] * levels_[0].value[static_cast<std::size_t>(parents_[k])];
    });
}

} // namespace rough
