#include "domain/accuracy/account.hpp"

#include "domain/contact/names.hpp"
#include "domain/errors.hpp"
#include "domain/plain_stream.hpp"

#include <cmath>

namespace rough {

namespace {

std::string grid_words(const Account& account) {
    PlainStream words;
    const std::size_t count = account.grids.size();
    if (account.extrapolated()) {
        const auto first = count - static_cast<std::size_t>(account.read_grids);
        words << "Read off grids of ";
        for (std::size_t i = first; i < count; ++i)
            words << (i == first ? "" : i + 1 == count ? " and " : ", ") << account.grids[i];
        words << " nodes in place of " << account.resolved_nodes;
        if (first > 0)
            words << ", after " << first << " coarser one(s) that did not suffice";
        if (account.resolved_rows > 0)
            words << "; the first " << account.resolved_rows << " load steps, the lightest, on the "
                  << account.resolved_nodes << " nodes themselves";
    } else {
        words << "Solved on " << account.grids.back() << " nodes";
        if (count > 1)
            words << ", the resolved grid, as " << count - 1 << " coarser one(s) up to "
                  << account.grids[count - 2] << " nodes did not suffice";
    }
    return words.str();
}

} // namespace

std::string in_words(const Account& account) {
    PlainStream words;
    words.precision(2);
    words << grid_words(account) << "; " << account.solved_rows << " of " << account.rows
          << " load steps solved by " << name_of(account.solver);
    if (account.solved_rows < account.rows)
        words << ", the others read between them within exact bounds";
    words << ". ";
    if (!account.used.empty()) {
        words << account.used.size() << " chromosome(s) modelled";
        if (!account.dropped.empty())
            words << ", " << account.dropped.size() << " shorter one(s) left out: gaps change by "
                  << account.window.lowest << " to " << account.window.highest << " mm, the curve by at most "
                  << account.dropped_error;
        words << ". ";
    }
    if (account.by_line)
        words << "One line, the mean along the lay, answers for the map (Str " << account.aspect_ratio
              << "): bounded, its curve is off by at most " << account.line_error << ". ";
    else if (std::isfinite(account.line_error))
        words << "One line, the mean along the lay, would not have answered for the map (Str "
              << account.aspect_ratio << "): measured, its curve is off by up to " << account.line_error
              << ". ";
    if (account.accuracy > 0)
        words << "Against the resolved model's the curve is off by an estimated " << account.estimated_error
              << " at most, relative, in pressure and secant stiffness"
              << (account.light_rows == 0
                      ? ""
                      : line_of(" (at the first ", account.light_rows,
                                " load steps, below 1 % of the last pressure, relative to "
                                "that 1 %)"))
              << "; " << account.accuracy << " was asked for. "
              << (account.used.empty()
                      ? "Contact fractions count measured nodes: only the band of the scan's "
                        "resolution says what their spacing leaves open."
                  : std::isfinite(account.area_error)
                      ? line_of("Contact fractions are off by an estimated ", account.area_error, " at most.")
                      : "Contact fractions are not bounded.");
    else
        words << "This is the model as given; what its grid leaves out was not estimated, as no accuracy "
                 "was asked for.";
    if (account.held_nodes > 0)
        words << " At the last load step " << account.held_nodes
              << " node(s) bear the hardness and sink in: contact with a hardness is not nested, amplitude "
                 "is no "
                 "free factor (no rescaling by Eq. 11), and no bound or verdict that rests on either holds.";
    return words.str();
}

} // namespace rough
