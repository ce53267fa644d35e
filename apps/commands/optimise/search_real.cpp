#include "apps/commands/optimise/search_by_children.hpp"

namespace app {

void search_real(OutsideSearch& search, Children& children) {
    search_by_children<std::vector<double>>(search, children);
}

} // namespace app
