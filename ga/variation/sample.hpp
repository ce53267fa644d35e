#pragma once

#include "ga/variation/mutate.hpp"

namespace ga {

/// Replaces the population by n new individuals, which the problem draws at random.
struct Sample : Operator {
    std::size_t n = 1; ///< number of individuals, >= 1
    static constexpr bool begins = true;
    static constexpr bool keeps_size = true; ///< the number of individuals is known
    static constexpr const char* needs = "a problem that samples genomes";
    static Words words() {
        return {"sample", "mutation", "n new individuals drawn at random in the population's place"};
    }
    static void describe(auto& self, auto visit) { visit(self.n, whole("n", std::nullopt, 1, "how many")); }
    void check(CheckState& known) const {
        known.scored.reset();
        known.at_most = n;
    }

    template <Sampled P>
    PopulationOf<P> operator()(PopulationOf<P>, Context<P>& context) const {
        PopulationOf<P> fresh;
        std::vector<Work> work(1);
        for (std::size_t i = 0; i < n; ++i) {
            Stream stream = context.stream(i);
            fresh.push_back({sampled(context.problem(), stream, work[i]), context.new_identity(), {}, {}, {}});
            if (i > 0) continue;
            context.need_room(n, {}, &fresh.front().genome);
            fresh.reserve(n);
            work.resize(n);
        }
        context.charge(work);
        return fresh;
    }
};

/// n points of Sobol's sequence in the unit cube (Sobol 1967; numbers by Joe and Kuo 2008), with a random
/// digital shift. Throws UsageError for more dimensions than the table has (3,667).
std::vector<Point> sobol_points(std::size_t n, std::size_t dimensions, Stream& stream);
/// n points of a Latin hypercube (McKay, Beckman and Conover 1979). Each coordinate has one point in each of
/// n intervals of equal width, at a random place in it.
std::vector<Point> latin_points(std::size_t n, std::size_t dimensions, Stream& stream);

/// Replaces the population by n new individuals whose real genes fill the bounds evenly, by Sobol's sequence
/// or a Latin hypercube. The problem draws everything else, and genes with an infinite bound.
template <bool latin>
struct SampleEvenly : Operator {
    std::size_t n = 1;                       ///< number of individuals, >= 1
    static constexpr bool begins = true;     ///< as Sample
    static constexpr bool keeps_size = true; ///< as Sample
    static constexpr const char* needs = "a problem that samples genomes, with bounded real genes";
    static Words words() {
        if (latin) return {"sample latin", "mutation", "n new individuals by a Latin hypercube of their real genes"};
        return {"sample sobol", "mutation", "n new individuals by Sobol's sequence of their real genes"};
    }
    static void describe(auto& self, auto visit) { Sample::describe(self, visit); }
    std::string text() const { return "sample " + std::to_string(n) + (latin ? " latin" : " sobol"); }
    void check(CheckState& known) const { Sample{{}, n}.check(known); }

    template <Sampled P>
    requires(Bounded<P>&& HasGenes<P>) PopulationOf<P>
    operator()(PopulationOf<P>, Context<P>& context) const {
        const P& problem = context.problem();
        PopulationOf<P> fresh = Sample{{}, n}({}, context);
        Stream stream = context.stream(n);
        const std::size_t dimensions = checked_bounds(problem, fresh.front().genome).size();
        const auto points = (latin ? latin_points : sobol_points)(n, dimensions, stream);
        for (std::size_t i = 0; i < n; ++i)
            edit_genes(problem, fresh[i].genome, [&](std::span<double> genes) {
                const auto& variables = checked_bounds(problem, fresh[i].genome);
                for (std::size_t k = 0; k < std::min<std::size_t>(variables.size(), dimensions); ++k)
                    if (const Variable& v = variables[k]; v.gene < genes.size() && std::isfinite(v.upper - v.lower))
                        genes[v.gene] = std::min(v.upper, v.lower + points[i][k] * (v.upper - v.lower));
            });
        return fresh;
    }
};

///@{ The stages `sample n`, `sample n sobol` and `sample n latin`.
inline Sample sample(std::size_t n) { return checked(Sample{{}, n}); }
inline SampleEvenly<false> sample_sobol(std::size_t n) { return checked(SampleEvenly<false>{{}, n}); }
inline SampleEvenly<true> sample_latin(std::size_t n) { return checked(SampleEvenly<true>{{}, n}); }
///@}

} // namespace ga
