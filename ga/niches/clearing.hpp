#pragma once

#include "ga/niches/distance.hpp"
#include "ga/pipeline/stage.hpp"

namespace ga {

/// Clearing (Petrowski 1996): from the best down, each that is within `radius` of `capacity` better ones that
/// stayed goes. The others are left, best first.
struct Clearing : Operator {
    double radius = 0.1;      ///< of a niche, above 0
    std::size_t capacity = 1; ///< how many a niche holds, >= 1

    ///@{
    /// What every operator has (Operator).
    static Words words() {
        return {"clear", "niches", "the best of every niche stay, best first; the others go"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.radius, number("radius", std::nullopt, above_zero, no_limit,
                                  "of a niche: rms of genes in widths, or share of bits that differ"));
        visit(self.capacity, whole("capacity", "1", 1, "how many a niche holds").keyed().quiet());
    }
    void check(CheckState& known) const { known.need_score(text_of(*this)); }

    template <Problem P>
    requires HasDistance<P> PopulationOf<P>
    operator()(PopulationOf<P> population, Context<P>& context) const {
        PopulationOf<P> left;
        for (const std::size_t i : ranking(population)) {
            const auto near = std::count_if(left.begin(), left.end(), [&](const auto& better) {
                return distance(context.problem(), better.genome, population[i].genome) < radius;
            });
            if (static_cast<std::size_t>(near) < capacity)
                left.push_back(std::move(population[i]));
        }
        return left;
    }
    ///@}
};

/// The stage `clear radius capacity=capacity`.
inline Clearing clear(double radius, std::size_t capacity = 1) {
    return checked(Clearing{{}, radius, capacity});
}

} // namespace ga
