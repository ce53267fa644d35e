#include "apps/commands/optimise/search_by_children.hpp"

namespace app {

void search_permutation(OutsideSearch& search, Children& children) {
    search_by_children<ga::Permutation>(search, children);
}

} // namespace app
