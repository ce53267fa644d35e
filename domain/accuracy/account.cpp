#include "domain/accuracy/respond_within.hpp"
#include "domain/errors.hpp"

namespace rough {
namespace {

std::string grid_words(const AccuracyReport& account) {
    const std::vector<Index>& grids = account.grids;
    if (!account.extrapolated())
        return line_of("The contact was solved on ", grids.back(), " nodes",
                       grids.size() == 1
                           ? ""
                           : line_of(", the resolved grid, because ", grids.size() - 1, " coarser grid(s) of up to ",
                                     grids[grids.size() - 2], " nodes did not suffice"));
    const auto first = grids.size() - static_cast<std::size_t>(account.read_grids);
    PlainStream words;
    words << "The curve was extrapolated to " << account.resolved_nodes << " nodes from grids of ";
    for (std::size_t i = first; i < grids.size(); ++i)
        words << (i == first ? "" : i + 1 == grids.size() ? " and " : ", ") << grids[i];
    words << " nodes";
    if (first > 0) words << ", after " << first << " coarser grid(s) that did not suffice";
    if (account.resolved_rows > 0)
        words << "; the first " << account.resolved_rows << " load steps, the lightest, were solved on the "
              << account.resolved_nodes << " nodes themselves";
    return words.str();
}

} // namespace

std::string in_words(const AccuracyReport& account) {
    PlainStream words;
    words.precision(2);
    words << grid_words(account) << "; " << account.solved_rows << " of " << account.rows
          << " load steps were solved by the solver " << name_of(account.solver);
    if (account.solved_rows < account.rows) words << ", the other ones were interpolated within exact bounds";
    words << ". ";
    if (!account.used.empty()) {
        words << account.used.size() << " wavelength(s) were modelled";
        if (!account.dropped.empty())
            words << ", " << account.dropped.size() << " shorter wavelength(s) were omitted: gaps change by "
                  << account.window.lowest << " to " << account.window.highest << " mm, the curve by at most "
                  << account.dropped_error;
        words << ". ";
    }
    if (account.by_line)
        words << "One profile, the mean along the grooves, replaces the map (Str " << account.aspect_ratio
              << "). Its curve is off by at most " << account.line_error << " (a bound). ";
    else if (std::isfinite(account.line_error))
        words << "One profile, the mean along the grooves, could not replace the map (Str " << account.aspect_ratio
              << "), because its curve is off by up to " << account.line_error << " (measured). ";
    if (account.accuracy > 0) {
        words << "The estimated relative error against the resolved model, in pressure and secant stiffness, "
                 "is at most "
              << account.estimated_error << "; " << account.accuracy << " was requested. ";
        if (account.light_rows > 0)
            words << "At the first " << account.light_rows
                  << " load steps, below 1 % of the last pressure, the error is relative to this 1 %. ";
        for (const auto& [name, error] : {std::pair("Contact fractions", account.area_error),
                                          std::pair("Tangent stiffnesses K", account.tangent_error)})
            if (error < 1)
                words << name << " are off by an estimated " << error << " at most. ";
            else
                words << name << " are not bounded"
                      << (account.by_line ? "" : " at the lightest load steps, where few nodes touch") << ". ";
        words << "The relative error of the interface stiffness K_i is K_i/K times that of K.";
        if (account.used.empty())
            words << " Contact fractions count measured nodes: only the band of the scan's resolution shows "
                     "the error from their spacing.";
    } else {
        words << "The error of the grid was not estimated, because no accuracy was requested.";
    }
    if (account.held_nodes > 0)
        words << " At the last load step the pressure of " << account.held_nodes
              << " node(s) is the hardness, and they sink in. Contact with a hardness is not nested, and "
                 "Eq. 11 cannot rescale it, so bounds that need either do not hold.";
    return words.str();
}

} // namespace rough
