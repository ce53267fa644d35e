#include "apps/commands/optimise/search_by_children.hpp"

namespace app {

void search_bits(OutsideSearch& search, Children& children) {
    search_by_children<std::vector<bool>>(search, children);
}

} // namespace app
