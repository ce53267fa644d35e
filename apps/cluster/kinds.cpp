#include "apps/cluster/kinds.hpp"

namespace app {

const std::vector<Kind>& kinds() {
    static const std::vector<Kind> all{{"outcomes", outcomes_under},
                                       {"slopes", slopes_under},
                                       {"responses", responses_under},
                                       {"races", races_under}};
    return all;
}

} // namespace app
