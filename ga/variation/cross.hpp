#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// A method to cross two genomes in place. It has words() and describe() like an operator. It also has `void
/// operator()(const P&, Genome& a, Genome& b, Stream&) const`, constrained by the members of the problem that it uses.
template <class Method, class P>
concept Crosses = Problem<P> &&
    requires(const Method& method, const P& problem, typename P::Genome& genome, Stream& stream) {
    method(problem, genome, genome, stream);
};

/// Crosses neighbours: the first with the second, the third with the fourth and so on. Each pair is crossed
/// with probability `rate`. If the number of individuals is odd, the last individual is not changed. The two
/// children replace their parents, unscored. Put `random` before this stage to shuffle the pairs.
template <class Method>
struct Cross : Operator {
    Method method;   ///< method that crosses two genomes (Crosses)
    double rate = 1; ///< probability for each pair, in [0, 1]
    static constexpr const char* needs = Method::needs;
    static Words words() {
        const Words of_method = Method::words();
        return {"cross " + of_method.name, "cross-over", of_method.meaning};
    }
    static void describe(auto& self, auto visit) {
        Method::describe(self.method, visit);
        visit(self.rate, number("rate", 0, 1, "a pair's chance to be crossed").keyed().quiet());
    }
    void check(CheckState& known) const { known.scored.reset(); }

    template <class P>
    requires Crosses<Method, P> PopulationOf<P>
    operator()(PopulationOf<P> population, Context<P>& context) const {
        Stream next = context.stream(0); // computed ahead, while the processor waits for the previous one
        for (std::size_t i = 0; i + 1 < population.size(); i += 2) {
            Stream stream = std::exchange(next, context.stream(i + 2));
            if (rate < 1 && !stream.chance(rate)) continue;
            auto &a = population[i], &b = population[i + 1];
            method(context.problem(), a.genome, b.genome, stream);
            const Parents parents(a.identity, b.identity);
            context.make_child(a, parents);
            context.make_child(b, parents);
        }
        return population;
    }
};

/// The stage `cross` with a method.
/// @param rate  probability that a pair is crossed, 0 to 1
template <class Method>
Cross<Method> cross(Method method, double rate = 1) {
    return checked(Cross<Method>{{}, std::move(method), rate});
}

/// A genome that is a sequence of genes at positions, so that two genomes may exchange genes.
template <class G>
concept Positional = std::ranges::random_access_range<G> && requires(G& genome, std::size_t i) {
    genome.size();
    std::swap_ranges(genome.begin(), genome.end(), genome.begin());
    *genome.begin() = *genome.begin(); // the signature of swap does not require it
};

/// The need of operators on real genes, for the listing.
constexpr const char* real_genes = "real genes: genes and with_genes, or a vector of double";

/// Calls edit(std::span<double>), which changes a genome's real genes. If the genome is a vector of double,
/// it is changed in place.
template <HasGenes P, class Edit>
void edit_genes(const P& problem, typename P::Genome& genome, Edit edit) {
    if constexpr (ConvertsGenes<P>) {
        std::vector<double> genes = problem.genes(genome);
        edit(std::span<double>(genes));
        genome = problem.with_genes(genome, genes);
    } else {
        edit(std::span<double>(genome));
    }
}

/// The genes that may move, with their bounds: the problem's list, or all genes without bounds.
template <HasGenes P>
decltype(auto) variables_of(const P& problem, const typename P::Genome& genome) {
    if constexpr (Bounded<P>) {
        return checked_bounds(problem, genome);
    } else {
        std::vector<Variable> all(genes_of(problem, genome).size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = {i, -HUGE_VAL, HUGE_VAL};
        return all;
    }
}

/// Calls cross(x, y, variable) for the real genes that may move in both parents. The variable has the bounds that both
/// parents allow, widened to include the parents' genes. Choices are exchanged with probability 1/2.
template <HasGenes P, class Cross>
void cross_genes(const P& problem, typename P::Genome& a, typename P::Genome& b, Stream& stream, Cross cross) {
    const auto& of_first = variables_of(problem, a);
    const auto& of_second = variables_of(problem, b);
    edit_genes(problem, a, [&](std::span<double> first) {
        edit_genes(problem, b, [&](std::span<double> second) {
            std::size_t other = 0;
            for (Variable variable : of_first) {
                while (other < of_second.size() && of_second[other].gene < variable.gene) ++other;
                if (variable.gene >= first.size() || variable.gene >= second.size() || other == of_second.size() ||
                    of_second[other].gene != variable.gene)
                    continue;
                double &x = first[variable.gene], &y = second[variable.gene];
                if (variable.is_choice) {
                    if (stream.chance(0.5)) std::swap(x, y);
                    continue;
                }
                variable.lower = std::min({std::max(variable.lower, of_second[other].lower), x, y});
                variable.upper = std::max({std::min(variable.upper, of_second[other].upper), x, y});
                cross(x, y, variable);
            }
        });
    });
}

/// Cuts two sequences at the same n different places and exchanges every second piece. Only the length of the
/// shorter sequence is used. If this is too short for n cuts, there are as many cuts as fit.
template <class Sequence>
void exchange_at_points(Sequence& a, Sequence& b, std::size_t n, Stream& stream) {
    const std::size_t length = std::min<std::size_t>(a.size(), b.size());
    if (length < 2) return;
    const auto exchange = [&](std::size_t from, std::size_t to) {
        const auto first = static_cast<std::ptrdiff_t>(from), last = static_cast<std::ptrdiff_t>(to);
        std::swap_ranges(a.begin() + first, a.begin() + last, b.begin() + first);
    };
    if (n == 1) return exchange(1 + stream.below(length - 1), length);
    std::vector<std::size_t> cuts(length - 1);
    std::iota(cuts.begin(), cuts.end(), std::size_t{1});
    const std::size_t count = std::min(n, cuts.size());
    for (std::size_t i = 0; i < count; ++i) std::swap(cuts[i], cuts[i + stream.below(cuts.size() - i)]);
    cuts.resize(count);
    std::sort(cuts.begin(), cuts.end());
    cuts.push_back(length);
    for (std::size_t i = 0; i + 1 < cuts.size(); i += 2) exchange(cuts[i], cuts[i + 1]);
}

/// n-point cross-over of genomes (Holland 1975; De Jong 1975) by exchange_at_points, or by the problem's
/// `cross_points`.
struct Points {
    std::size_t n = 2; ///< number of cuts, >= 1

    static constexpr const char* needs = "genes at positions: a random-access range";
    static Words words() { return {"n_points", "cross-over", "exchanges every other piece between n cuts"}; }
    static void describe(auto& self, auto visit) { visit(self.n, whole("n", 1, "cuts")); }

    template <Problem P>
    requires(CrossesAtPoints<P> || Positional<typename P::Genome>) void
    operator()(const P& problem, typename P::Genome& a, typename P::Genome& b, Stream& stream) const {
        if constexpr (CrossesAtPoints<P>)
            problem.cross_points(a, b, n, stream);
        else
            exchange_at_points(a, b, n, stream);
    }
};

/// Cross-over with one cut.
struct OnePoint : Points {
    OnePoint() : Points{1} {} ///< a cut at one place
    static Words words() { return {"one_point", "cross-over", "exchanges what lies beyond one cut"}; }
    static void describe(auto&, auto) {}
};

/// Exchanges the genes at each position with probability 1/2 (Syswerda 1989), up to the length of the shorter genome.
struct Uniform : NoParameters {
    static constexpr const char* needs = Points::needs;
    static Words words() { return {"uniform", "cross-over", "exchanges each position with probability 1/2"}; }

    template <Problem P>
    requires(CrossesUniformly<P> || Positional<typename P::Genome>) void
    operator()(const P& problem, typename P::Genome& a, typename P::Genome& b, Stream& stream) const {
        if constexpr (CrossesUniformly<P>) {
            problem.cross_uniform(a, b, stream);
        } else {
            const std::size_t length = std::min<std::size_t>(a.size(), b.size());
            std::uint64_t coins = 0;
            for (std::size_t i = 0; i < length; ++i, coins >>= 1) {
                if (i % 64 == 0) coins = stream();
                if (coins & 1) {
                    auto kept = a[i]; // elements of vector<bool> cannot be swapped by reference
                    a[i] = b[i];
                    b[i] = kept;
                }
            }
        }
    }
};

/// Cross-over of permutations that keeps a piece of one parent at its position in each child.
///
/// Order cross-over (Davis 1985): the other numbers follow from the end of that piece, in the order of the
/// other parent. Partially mapped cross-over (Goldberg and Lingle 1985): they stay at their positions in the
/// other parent. A number that the piece contains is replaced by the one that the piece has displaced.
///
/// Permutations of unequal length stay as they are.
template <bool mapped>
struct KeepPiece : NoParameters {
    static constexpr const char* needs = "a permutation for a genome";
    static Words words() {
        if (mapped)
            return {"pmx", "cross-over",
                    "keeps a piece of one permutation and the other's positions elsewhere (partially mapped)"};
        return {"order", "cross-over", "keeps a piece of one permutation in place and the other's order elsewhere"};
    }

    template <Problem P>
    requires std::same_as<typename P::Genome, Permutation>
    void operator()(const P&, Permutation& a, Permutation& b, Stream& stream) const {
        const std::size_t n = a.size();
        if (n != b.size() || n < 2) return;
        std::size_t from = stream.below(n), to = stream.below(n);
        if (from > to) std::swap(from, to);
        const Permutation first = child(a, b, from, to + 1);
        b = child(b, a, from, to + 1);
        a = first;
    }

  private:
    static Permutation child(const Permutation& keeper, const Permutation& other, std::size_t from, std::size_t to) {
        const std::size_t n = keeper.size();
        Permutation child = keeper;
        std::vector<std::size_t> kept(n, n); // positions of the piece's numbers
        for (std::size_t i = from; i < to; ++i) kept[keeper.order[i]] = i;
        std::size_t place = to % n;
        for (std::size_t i = 0; i < n; ++i) {
            std::uint32_t next = other.order[(to + i) % n];
            if (mapped && i < n - (to - from)) {
                while (kept[next] < n) next = other.order[kept[next]];
            } else if (mapped || kept[next] < n) {
                continue;
            }
            child.order[place] = next;
            place = (place + 1) % n;
        }
        return child;
    }
};
using Order = KeepPiece<false>;          ///< the method of `cross order`
using PartiallyMapped = KeepPiece<true>; ///< the method of `cross pmx`

/// Edge recombination (Whitley, Starkweather and Fuquay 1989) of permutations that are closed tours. A child
/// continues with a neighbour that its last number has in a parent. It prefers a neighbour in both parents
/// (Starkweather et al. 1991), then the one with the fewest neighbours left. If its last number has none, the
/// child continues at its other end (Mathias and Whitley 1992), or with any number. Each child begins like
/// one parent. Permutations of unequal length stay as they are.
struct EdgeRecombination : NoParameters {
    static constexpr const char* needs = Order::needs;
    static Words words() { return {"edge", "cross-over", "makes tours of edges of both tours (edge recombination)"}; }

    template <Problem P>
    requires std::same_as<typename P::Genome, Permutation>
    void operator()(const P&, Permutation& a, Permutation& b, Stream& stream) const {
        if (a.size() != b.size() || a.size() < 2) return;
        const Permutation first = child(a, b, stream);
        b = child(b, a, stream);
        a = first;
    }

  private:
    static Permutation child(const Permutation& a, const Permutation& b, Stream& stream) {
        const std::size_t n = a.size();
        std::vector<std::array<std::uint32_t, 4>> neighbours(n); // in a, then in b
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
            neighbours[a.order[i]][0] = a.order[before], neighbours[a.order[i]][1] = a.order[after];
            neighbours[b.order[i]][2] = b.order[before], neighbours[b.order[i]][3] = b.order[after];
        }
        std::vector<std::uint32_t> left = a.order; // numbers that the child lacks
        std::vector<std::size_t> places(n);        // positions there, n for a number that the child has
        for (std::size_t i = 0; i < n; ++i) places[left[i]] = i;
        Permutation child;
        child.order.reserve(n);
        const auto append = [&](std::uint32_t number) {
            left[places[number]] = left.back();
            places[left.back()] = places[number];
            left.pop_back();
            places[number] = n;
            child.order.push_back(number);
        };
        const auto next = [&]() -> std::optional<std::uint32_t> {
            std::optional<std::uint32_t> chosen;
            std::size_t fewest = 0, ties = 0;
            for (const std::uint32_t each : neighbours[child.order.back()]) {
                if (places[each] == n) continue;
                std::size_t count = 0; // number of its neighbours that are left; 0 for one in both parents
                if (std::ranges::count(neighbours[child.order.back()], each) == 1)
                    count = 1 + static_cast<std::size_t>(std::ranges::count_if(
                                    neighbours[each], [&](std::uint32_t other) { return places[other] < n; }));
                if (!chosen || count < fewest) ties = 0;
                if (!chosen || count <= fewest) {
                    fewest = count;
                    if (stream.below(++ties) == 0) chosen = each;
                }
            }
            return chosen;
        };
        append(a.order[0]);
        while (!left.empty()) {
            std::optional<std::uint32_t> number = next();
            if (!number) {
                std::ranges::reverse(child.order);
                number = next();
            }
            append(number ? *number : left[stream.below(left.size())]);
        }
        return child;
    }
};

/// BLX-alpha (Eshelman and Schaffer 1993): each child's gene is uniform in an interval around both parents'
/// genes. It extends alpha times their distance beyond each of them, and is cut at the bounds.
struct Blend {
    double alpha = 0.5; ///< extension of the interval relative to the parents' distance, >= 0

    static constexpr const char* needs = real_genes;
    static Words words() {
        return {"blend", "cross-over", "draws each gene uniformly around the parents' (BLX-alpha)"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.alpha, number("alpha", 0, no_limit, "how far beyond, in their distance"));
    }

    template <HasGenes P>
    void operator()(const P& problem, typename P::Genome& a, typename P::Genome& b, Stream& stream) const {
        cross_genes(problem, a, b, stream, [&](double& x, double& y, const Variable& variable) {
            const double low = std::min(x, y), high = std::max(x, y), reach = alpha * (high - low);
            for (double* child : {&x, &y})
                *child = std::clamp(stream.uniform(low - reach, high + reach), variable.lower, variable.upper);
        });
    }
};

/// Simulated binary cross-over (Deb and Agrawal 1995, with bounds as in NSGA-II's code). Each gene is crossed
/// with probability 1/2. Children lie symmetrically about the parents' mean. They spread as the children of
/// binary strings do after one-point cross-over.
struct SimulatedBinary {
    double eta = 15; ///< distribution index, >= 0; greater values put children nearer to their parents

    static constexpr const char* needs = real_genes;
    static Words words() {
        return {"sbx", "cross-over", "simulated binary cross-over, symmetric about the parents' mean"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.eta, number("eta", 0, no_limit, "the greater, the nearer to the parents"));
    }

    template <HasGenes P>
    void operator()(const P& problem, typename P::Genome& a, typename P::Genome& b, Stream& stream) const {
        cross_genes(problem, a, b, stream, [&](double& x, double& y, const Variable& variable) {
            if (stream.chance(0.5)) cross(x, y, variable, stream);
        });
    }

  private:
    void cross(double& x, double& y, const Variable& variable, Stream& stream) const {
        const double low = std::min(x, y), high = std::max(x, y), distance = high - low;
        const double u = stream.uniform();
        const bool exchanged = stream.chance(0.5);
        if (!(distance > 1e-14 * std::max(1.0, std::abs(low) + std::abs(high)))) return;
        // The density of the spread is cut at the bounds.
        const auto spread = [&](double room) {
            const double alpha = 2 - std::pow(1 + 2 * room / distance, -(eta + 1)); // 2 without a bound
            return std::pow(u <= 1 / alpha ? u * alpha : 1 / (2 - u * alpha), 1 / (eta + 1));
        };
        const auto inside = [&](double gene) { return std::clamp(gene, variable.lower, variable.upper); };
        const double middle = (low + high) / 2;
        const double below = inside(middle - spread(low - variable.lower) * distance / 2);
        const double above = inside(middle + spread(variable.upper - high) * distance / 2);
        x = exchanged ? above : below;
        y = exchanged ? below : above;
    }
};

///@{ The methods for `cross`.
inline OnePoint one_point() { return {}; }
inline Points n_points(std::size_t n) { return {n}; }
inline Uniform uniform() { return {}; }
inline Order order() { return {}; }
inline PartiallyMapped pmx() { return {}; }
inline EdgeRecombination edge() { return {}; }
inline Blend blend(double alpha = 0.5) { return {alpha}; }
inline SimulatedBinary sbx(double eta = 15) { return {eta}; }
///@}

} // namespace ga
