#include "domain/design/defaults.hpp"

#include "domain/errors.hpp"

namespace rough {

GeneBounds completed(GeneBounds bounds, double length) {
    if (bounds.lambda_from == 0)
        bounds.lambda_from = 0.25 * length;
    if (bounds.lambda_to == 0)
        bounds.lambda_to = 4 * length;
    return bounds;
}

DesignSetup completed(DesignSetup setup) {
    setup.model = completed(setup.model);
    const Grid& grid = setup.model.grid;
    if (grid.nodes < 16)
        refuse_value("nodes", grid.nodes, " given, expected 16 at least for a design");
    validate(setup.model);
    setup.bounds = completed(setup.bounds, grid.length);
    double& shortest = setup.limits.shortest_wave;
    if (shortest == 0)
        shortest = 8 * grid.spacing();
    if (shortest < grid.spacing())
        refuse_value("shortest wave", shortest, " mm given, expected at least the distance of two nodes, ",
                     grid.spacing(), " mm: the grid sees no shorter wave");
    if (shortest > setup.bounds.lambda_to)
        refuse_value("shortest wave", shortest, " mm given, expected at most the longest wave, ",
                     setup.bounds.lambda_to, " mm");
    return setup;
}

} // namespace rough
