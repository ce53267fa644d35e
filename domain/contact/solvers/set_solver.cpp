#include "domain/contact/solvers/set_solver.hpp"

#include <Eigen/Cholesky>

#include <cmath>

namespace rough {
namespace {

/// Largest error of a product in single precision over its largest entry: twice the largest seen, on 512 to
/// 262,144 nodes.
constexpr double single_rounding = 5e-6;
/// The fall of the residual after which it is recomputed, because products in single precision then err by a
/// hundredth of it.
constexpr double single_depth = 1e-4;
/// The rise of the residual after which the directions are taken to be lost by rounding.
constexpr double lost = 1e6;
/// A stiffness whose H w was improved in single precision is good to this: ten times the largest error seen.
constexpr double single_stiffness = 3e-7;
/// Maximum number of iterations for the tangent, far above the number ever needed.
constexpr long max_tangent_iterations = 5000;

/// A cut step is taken whole if the energy's minimum along it is beyond this share. Half would do, because
/// there the energy is that of the start again.
constexpr double whole_step = 0.75;
/// Least length of the usual step.
constexpr double shortest_step = 0.5;
/// Corrections of a cut step's sum. Each may cut a few more nodes.
constexpr int max_corrections = 3;

constexpr Index max_columns = 64; ///< largest number of columns of a deflation

/// Half-open ranges of positions in `nodes` whose nodes are neighbours.
std::vector<std::pair<Index, Index>> runs_of(const std::vector<int>& nodes) {
    std::vector<std::pair<Index, Index>> runs;
    const Index count = static_cast<Index>(nodes.size());
    for (Index first = 0; first < count;) {
        Index last = first + 1;
        while (last < count && nodes[static_cast<std::size_t>(last)] == nodes[static_cast<std::size_t>(last - 1)] + 1)
            ++last;
        runs.emplace_back(first, last);
        first = last;
    }
    return runs;
}

/// Sums of h_|k| from k = -(N-1) up to x, at N + x for x = -N .. N-1, of the first column h_0 .. h_(N-1).
Eigen::VectorXd cumulative(const Eigen::VectorXd& column) {
    const Index n = column.size();
    Eigen::VectorXd sums(2 * n);
    double sum = sums[0] = 0;
    for (Index k = 1; k < 2 * n; ++k) sums[k] = sum += column[std::abs(k - n)];
    return sums;
}

/// Deflates the mean pressure of each run of neighbouring contact nodes, through which distant runs influence each
/// other and which a circulant preconditioner cannot see. Deflated conjugate gradients (Saad, Yeung, Erhel & Guyomarc'h
/// 2000) keep their residual free of it, which halves the iterations. The columns of W are indicators of runs, so HW
/// needs only sums of H's first column. Each run has a column; above 64 runs, neighbouring runs share one.
class Deflation {
  public:
    /// `nodes` sorted; `sums` from cumulative(), or empty for no deflation.
    Deflation(const std::vector<int>& nodes, const Eigen::VectorXd& sums) {
        const auto runs = sums.size() > 0 ? runs_of(nodes) : std::vector<std::pair<Index, Index>>();
        const Index count = static_cast<Index>(nodes.size()), many = static_cast<Index>(runs.size());
        const Index columns = std::min(max_columns, many), n = sums.size() / 2;
        const auto node = [&](Index k) { return static_cast<Index>(nodes[static_cast<std::size_t>(k)]); };
        image_.resize(count, columns);
        for (Index run = 0; run < many; ++run) {
            const auto [begin, end] = runs[static_cast<std::size_t>(run)];
            const Index target = run * columns / many;
            if (target == static_cast<Index>(parts_.size())) {
                parts_.push_back({begin, 0});
                image_.col(target).setZero();
            }
            parts_.back().count = end - parts_.back().begin;
            // The sum of h_|i - j| over the run's j is that from i - last to i - first.
            const Index first = node(begin), last = node(end - 1);
            for (const auto& [from, to] : runs) {
                const Index length = to - from, i = node(from) + n;
                image_.col(target).segment(from, length) +=
                    sums.segment(i - first, length) - sums.segment(i - last - 1, length);
            }
        }
        Eigen::MatrixXd energy(columns, columns);
        for (Index c = 0; c < columns; ++c) {
            const Part part = parts_[static_cast<std::size_t>(c)];
            energy.row(c) = image_.middleRows(part.begin, part.count).colwise().sum();
        }
        if (columns > 0) energy_.compute(energy);
        usable_ = columns > 0 && energy_.info() == Eigen::Success;
    }

    /// Returns the change of x that makes the residual orthogonal to W, and applies it to the residual.
    Eigen::VectorXd project(Eigen::VectorXd& residual) const {
        Eigen::VectorXd change = Eigen::VectorXd::Zero(residual.size());
        if (usable_) {
            Eigen::VectorXd sums(image_.cols()); // W'r
            for (Index c = 0; c < sums.size(); ++c) {
                const Part part = parts_[static_cast<std::size_t>(c)];
                sums[c] = residual.segment(part.begin, part.count).sum();
            }
            const Eigen::VectorXd c = energy_.solve(sums);
            subtract(-c, change);
            residual.noalias() -= image_ * c;
        }
        return change;
    }

    /// Removes from z the part that would bring W into the search.
    void purge(Eigen::VectorXd& z) const {
        if (usable_) subtract(energy_.solve(image_.transpose() * z), z);
    }

  private:
    /// v -= W c
    void subtract(const Eigen::VectorXd& c, Eigen::VectorXd& v) const {
        for (Index k = 0; k < c.size(); ++k) {
            const Part part = parts_[static_cast<std::size_t>(k)];
            v.segment(part.begin, part.count).array() -= c[k];
        }
    }

    struct Part {
        Index begin, count;
    };
    std::vector<Part> parts_; ///< positions of each column's nodes
    Eigen::MatrixXd image_;   ///< HW on the contact set
    Eigen::LLT<Eigen::MatrixXd> energy_;
    bool usable_;
};

/// Eigenvalues 1/S_k of the inverse of T. Chan's circulant, whose first column is ((M - j) h_j + j
/// h_(M-j))/M; on an area so along both axes.
Eigen::VectorXd inverse_circulant(const ContactProblem& problem, Extent shape) {
    Eigen::VectorXd eigenvalues;
    if (problem.kernel == Kernel::periodic) {
        eigenvalues = periodic_spectrum(problem, shape);
    } else {
        const Eigen::VectorXd h = extended_column(problem, problem.column, problem.shape, shape, *problem.team);
        Eigen::ArrayXXd column(shape.columns, shape.rows);
        // Blends h with its mirror image; the first entry has none.
        const auto blended = [](const auto& entry, Index j, Index m) {
            const double share = static_cast<double>(j) / static_cast<double>(m);
            return j == 0 ? entry(0) : (1 - share) * entry(j) + share * entry(m - j);
        };
        for (Index j = 0; j < shape.rows; ++j)
            for (Index i = 0; i < shape.columns; ++i)
                column(i, j) = blended(
                    [&](Index row) {
                        return blended([&](Index k) { return h[row * shape.columns + k]; }, i, shape.columns);
                    },
                    j, shape.rows);
        eigenvalues = fourier_transform(column).real().reshaped();
    }
    // A datum near its limit, or none, leaves the mean without a usable stiffness.
    if (eigenvalues.size() > 1) eigenvalues[0] = std::max(eigenvalues[0], eigenvalues[1]);
    return eigenvalues.cwiseInverse();
}

/// A periodic matrix is circulant itself. If its length is slow to transform, a longer circulant serves as
/// well as it does for the other kernels. That of a free area is longer by an eighth, because its opposite
/// edges are not neighbours.
Extent circulant_shape(const ContactProblem& problem) {
    const auto [columns, rows] = problem.shape;
    if (problem.kernel == Kernel::periodic && is_good_fourier_length(columns) && is_good_fourier_length(rows))
        return problem.shape;
    if (rows == 1) return {fast_fourier_length(columns)};
    const auto longer = [&](Index n) {
        return fast_fourier_length(problem.kernel == Kernel::periodic ? n : n + n / 8);
    };
    return {longer(columns), longer(rows)};
}

/// Adds factor x to y, and returns the largest |x|. A plain loop, because Eigen casts one number at a time.
double add(Team& team, double factor, const float* x, Eigen::VectorXd& y) {
    double* into = y.data();
    return team.largest(y.size(), [=](Index first, Index count) {
        for (Index i = first; i < first + count; ++i) into[i] += factor * static_cast<double>(x[i]);
        return static_cast<double>(Eigen::VectorXf::Map(x + first, count).cwiseAbs().maxCoeff());
    });
}

double dot(Team& team, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return team.sum(a.size(),
                    [&](Index first, Index count) { return a.segment(first, count).dot(b.segment(first, count)); });
}

double largest(Team& team, const Eigen::VectorXd& a) {
    return team.largest(a.size(),
                        [&](Index first, Index count) { return a.segment(first, count).cwiseAbs().maxCoeff(); });
}

} // namespace

void ContactSet::collect() {
    nodes_ = team_.where(static_cast<Index>(touching_.size()), [&](Index i) { return holds(i); });
}

SetSolver::SetSolver(const ContactProblem& problem)
    : team_(*problem.team), shape_(problem.shape),
      sums_(problem.is_2d() ? Eigen::VectorXd() : cumulative(problem.column)), forward_(fourier_operator(problem)),
      single_(forward_), inverse_shape_(circulant_shape(problem)),
      inverse_(SingleFourierOperator::circulant(inverse_shape_, inverse_circulant(problem, inverse_shape_), team_)) {
    if (problem.is_2d()) extension_.emplace(inverse_shape_, team_);
}

void SetSolver::update(SurfaceState& x) {
    forward_.apply(x.pressure.data(), x.displacement.data());
    if (x.updated.size() > 0) team_.copy(x.pressure, x.updated);
    x.displacement_error = 0;
    ++applies_;
}

void SetSolver::update(SurfaceState& x, double accuracy) {
    const Index n = x.pressure.size();
    if (x.updated.size() == n && x.displacement_error < accuracy) {
        const double scale = team_.largest(n, [&](Index first, Index count) {
            return (x.pressure.segment(first, count) - x.updated.segment(first, count)).cwiseAbs().maxCoeff();
        });
        if (scale > 0) {
            const double inverse = 1 / scale;
            float* input = single_.input();
            team_.each_range(n, [&](Index first, Index count, int) {
                for (Index i = first; i < first + count; ++i)
                    input[i] = static_cast<float>((x.pressure[i] - x.updated[i]) * inverse);
                std::copy_n(x.pressure.data() + first, count, x.updated.data() + first);
            });
            x.displacement_error += single_rounding * scale * add(team_, scale, single_.apply(), x.displacement);
            ++applies_;
        }
        if (x.displacement_error <= accuracy) // false for NaN
            return;
    }
    x.updated.resize(n);
    update(x);
}

std::vector<int> SetSolver::inverse_places(const std::vector<int>& nodes) const {
    std::vector<int> places = nodes;
    const int columns = static_cast<int>(shape_.columns),
              longer = static_cast<int>(inverse_shape_.columns) - columns; // difference of the rows' lengths
    if (longer > 0)
        for (int& place : places) place += place / columns * longer;
    return places;
}

template <typename Real>
void SetSolver::multiply(BasicFourierOperator<Real>& matrix, const std::vector<int>& places, const Eigen::VectorXd& v,
                         double scale, Eigen::VectorXd& image, Extension* extension) const {
    Real* full = matrix.input();
    const Index m = v.size();
    const double inverse = 1 / scale;
    team_.each_range(matrix.nodes(), [=](Index first, Index count, int) { std::fill_n(full + first, count, Real(0)); });
    team_.each(m, [&](Index k) { full[places[static_cast<std::size_t>(k)]] = static_cast<Real>(v[k] * inverse); });
    if constexpr (std::is_same_v<Real, float>)
        if (extension) extension->extend(full);
    const Real* product = matrix.apply();
    if constexpr (std::is_same_v<Real, float>)
        if (extension) extension->transpose(full);
    team_.each(m,
               [&](Index k) { image[k] = scale * static_cast<double>(product[places[static_cast<std::size_t>(k)]]); });
}

bool SetSolver::improve(const ContactSet& set, const std::function<double(Index)>& target, SurfaceState& x,
                        const Enough& enough, long limit, double* level, bool projected) {
    const auto& nodes = set.nodes();
    const Index m = static_cast<Index>(nodes.size());
    if (m == 0) return true;
    const Deflation deflation(nodes, sums_);
    std::vector<int> inverse = inverse_places(nodes);
    Extension* const extension = is_2d() ? &*extension_ : nullptr;
    if (extension) extension->know(std::move(inverse));
    const std::vector<int>& places = extension ? extension->known() : inverse;
    const auto each = [&](auto change) { team_.each(m, change); };
    Eigen::VectorXd r(m), z(m), q = Eigen::VectorXd::Zero(m), hq(m),
                                even; // even: like what the preconditioner makes of a constant
    if (level) {                      // continued it is a constant, and so is a circulant times it
        float* full = inverse_.input();
        team_.each_range(inverse_.nodes(),
                         [=](Index first, Index count, int) { std::fill_n(full + first, count, 1.0F); });
        extension->transpose(full);
        even.resize(m);
        each([&](Index k) { even[k] = static_cast<double>(full[places[static_cast<std::size_t>(k)]]); });
    }
    const double even_sum = even.sum();
    double offset = 0; // subtracted from r, which any constant may be
    const auto centre = [&] {
        if (!level) return;
        const auto most = [&](double sign) {
            return sign * team_.largest(
                              m, [&](Index first, Index count) { return (sign * r.segment(first, count)).maxCoeff(); });
        };
        const double middle = (most(1) + most(-1)) / 2;
        each([&](Index k) { r[k] -= middle; });
        offset += middle;
    };
    const auto pressure = [&](Index k) -> double& { return x.pressure[nodes[static_cast<std::size_t>(k)]]; };
    const auto sum = [&](auto value) { return team_.sum_of(m, value); };
    // Makes q the usual step along q, cut so that no pressure falls below 0. The nodes that are not cut make
    // up for it, so that the step sums nearly to zero. False, and q stays, if no pressure would fall below 0.
    const auto cut = [&] {
        if (!(team_.largest_of(m, [&](Index k) { return -(pressure(k) + usual_step_ * q[k]); }) > 0)) return false;
        const auto is_free = [&](Index k) { return q[k] > -pressure(k); };
        each([&](Index k) { q[k] = std::max(usual_step_ * q[k], -pressure(k)); });
        for (int round = 0; round < max_corrections; ++round) {
            const double excess =
                sum([&](Index k) { return q[k]; }) / sum([&](Index k) { return is_free(k) ? even[k] : 0; });
            each([&](Index k) {
                if (is_free(k)) q[k] = std::max(q[k] - excess * even[k], -pressure(k));
            });
        }
        return true;
    };
    bool solved = false, is_cut = false, exact = false;
    double before = std::numeric_limits<double>::infinity();
    Eigen::VectorXd start; // the pressures at which `before` was the residual
    for (long iteration = 0;;) {
        each([&](Index k) {
            const Index i = nodes[static_cast<std::size_t>(k)];
            r[k] = target(i) - x.displacement[i];
        });
        if (!is_2d()) x.pressure(nodes) += deflation.project(r);
        offset = 0;
        centre();
        const double scale = largest(team_, r);
        // Written so that a NaN residual ends the loop, too.
        const bool progress = scale < 0.5 * before;
        if (!is_2d() && !progress && !exact && !(scale <= enough.residual)) {
            exact = true; // H on A is too badly conditioned for single precision
            if (!(scale < before)) each([&](Index k) { pressure(k) = start[k]; });
            before = std::numeric_limits<double>::infinity();
            update(x);
            continue;
        }
        before = scale;
        if (!is_2d()) start = x.pressure(nodes);
        double rz = 1;
        for (bool first = true;; first = false, ++iteration) {
            const double residual = largest(team_, r);
            // On a few nodes the residual falls in one step below the resolution of single precision.
            if (residual <= enough.residual && !first && enough.residual < single_rounding * scale) break;
            solved = residual <= enough.residual;
            if (solved) break;
            multiply(inverse_, places, r, scale > 0 ? scale : 1, z, extension);
            if (level) {
                const double share = sum([&](Index k) { return z[k]; }) / even_sum;
                each([&](Index k) { z[k] -= share * even[k]; });
            }
            const double energy = dot(team_, r, z);
            solved = std::isfinite(energy) && enough.energy && enough.energy(energy);
            if (solved || iteration >= limit || !progress || !(energy > 0) || residual <= single_depth * scale ||
                (!exact && !is_2d() && residual > lost * scale))
                break;
            deflation.purge(z);
            each([&, growth = first ? 0 : energy / rz](Index k) { q[k] = z[k] + growth * q[k]; });
            rz = energy;
            is_cut = level && projected && cut();
            exact ? multiply(forward_, nodes, q, scale, hq) : multiply(single_, nodes, q, scale, hq);
            ++applies_;
            const double curvature = dot(team_, q, hq);
            if (!(curvature > 0)) break;
            double step = (is_cut ? dot(team_, r, q) : rz) / curvature;
            if (level && first) usual_step_ = std::clamp(is_cut ? step * usual_step_ : step, shortest_step, 1.0);
            if (is_cut && step > whole_step) step = 1;
            if (is_2d() && !exact)
                x.displacement_error += single_rounding * std::abs(step * scale) *
                                        add(team_, step * scale, single_.applied(), x.displacement);
            each([&](Index k) {
                r[k] -= step * hq[k];
                pressure(k) += step * q[k];
            });
            centre();
            if (is_cut) break;
        }
        const bool kept = x.updated.size() > 0;
        if (is_2d() || !kept)
            each([&](Index k) {
                const Index i = nodes[static_cast<std::size_t>(k)];
                x.displacement[i] = target(i) - r[k] - offset;
            });
        if (level) *level = offset;
        if (is_2d() && kept) team_.copy(x.pressure, x.updated);
        const bool ends = solved || is_cut || iteration >= limit || !progress;
        if (!ends || (is_2d() && exact)) update(x);
        if (ends) return solved;
    }
}

void SetSolver::tangent(const ContactSet& set, double tolerance, bool each_entry, SurfaceState& w) {
    const Index n = w.pressure.size();
    team_.each(n, [&](Index i) {
        if (!set.holds(i)) w.pressure[i] = 0;
    });
    if (w.pressure.isZero(0))
        w.displacement.setZero(), w.displacement_error = 0;
    else
        update(w);
    const auto good = [&](double energy) {
        return energy <= 0.5 * tolerance * team_.sum(n, [&](Index first, Index count) {
            return w.pressure.segment(first, count).sum();
        });
    };
    improve(
        set, [](Index) { return 1.0; }, w, each_entry ? Enough{0.1 * tolerance} : Enough{0, good},
        max_tangent_iterations);
    if (tolerance < single_stiffness) update(w);
}

double missing_load(const ContactProblem& problem, double approach, const ContactSet& set, const SurfaceState& load,
                    const SurfaceState& tangent) {
    double missing = 0;
    for (const int i : set.nodes()) missing += tangent.pressure[i] * (approach - problem.gap[i] - load.displacement[i]);
    return missing;
}

StepSolution step_solution(const ContactSet& set, const SurfaceState& load, const SurfaceState& tangent,
                           bool with_tangent) {
    StepSolution step;
    step.nodes = set.nodes();
    step.pressure = load.pressure(step.nodes);
    for (const int i : step.nodes) step.stiffness += tangent.pressure[i] * (2 - tangent.displacement[i]);
    if (with_tangent) step.tangent = tangent.pressure(step.nodes);
    return step;
}

} // namespace rough
