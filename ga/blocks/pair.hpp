#pragma once

#include "ga/pipeline/stage.hpp"

namespace ga {

/// A function that makes a child of two individuals, or none.
template <class G>
using Combine = NamedFunction<std::optional<G>, const Individual<G>&, const Individual<G>&>;

/// Runs two pipelines on the same population. Combines every individual of the left result with every
/// individual of the right result. One of several equal children is kept, for example of the children of (i,
/// j) and (j, i). Children are unscored and have the identities of both parents.
template <class Left, class Right, class G>
struct Pair : Operator {
    Left left;          ///< pipeline that gives the first parents
    Right right;        ///< pipeline that gives the second parents
    Combine<G> combine; ///< function that makes a child of two parents

    /// The block as one stage (Operator).
    template <Problem P>
    Stage<P> stage() const {
        const auto on_left = std::make_shared<const Pipeline<P>>(left),
                   on_right = std::make_shared<const Pipeline<P>>(right);
        const Name left_name("left"), right_name("right");
        return {"pair(" + on_left->text() + ", " + on_right->text() + ", " + combine.name + ")",
                [=](CheckState& known) {
                    CheckState other = known;
                    on_left->check(known);
                    on_right->check(other);
                    known.scored.reset();
                },
                [=, combine = combine](Population<G> population, Context<P>& context) {
                    typename Context<P>::OpenFrame frame(context.state, {});
                    if (!frame.resumed()) frame->kept = {std::move(population), {}};
                    expect_fit(frame->kept.size() == 2);
                    if (frame->next == 0) {
                        const typename Context<P>::Scope scope(context.position, left_name, 0);
                        frame->kept[1] = (*on_left)(frame->kept[0], context);
                        frame->next = 1;
                    }
                    Population<G> others;
                    {
                        const typename Context<P>::Scope scope(context.position, right_name, 0);
                        others = (*on_right)(frame->kept[0], context);
                    }
                    return children(frame->kept[1], others, combine, context);
                },
                std::max(on_left->reads_of_start(), on_right->reads_of_start()),
                on_left->begins() && on_right->begins()};
    }

  private:
    template <Problem P>
    static Population<G> children(const Population<G>& lefts, const Population<G>& rights, const Combine<G>& combine,
                                  Context<P>& context) {
        Population<G> children;
        std::vector<Work> work(1);
        Table<bool> seen;
        for (const auto& a : lefts)
            for (const auto& b : rights) {
                std::optional<G> genome = combine.of(a, b, work[0]);
                if (!genome) continue;
                if (children.size() % 1024 == 0) context.need_room(children.size() + 1024, lefts, &*genome);
                if (std::exchange(seen.at(identify(context.problem(), *genome)), true)) continue;
                children.push_back(
                    {std::move(*genome), context.new_identity(), Parents(a.identity, b.identity), {}, {}});
            }
        if (children.empty())
            context.end_with(joined_with(lefts, rights),
                             std::to_string(lefts.size()) + " and " + std::to_string(rights.size()) +
                                 " individuals gave no child by " + combine.name + "; pair other individuals");
        context.charge(work);
        return children;
    }
};

/// The stage `pair(left, right, combine)`.
template <class Left, class Right, class G>
Pair<Left, Right, G> pair(Left left, Right right, Combine<G> combine) {
    return {{}, std::move(left), std::move(right), std::move(combine)};
}

} // namespace ga
