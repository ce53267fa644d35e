#include "apps/cluster/watch.hpp"

#include "apps/cluster/ranks.hpp"
#include "apps/cluster/talk.hpp"
#include "apps/prompt/interrupt.hpp"
#include "apps/prompt/progress.hpp"
#include "apps/prompt/verbosity.hpp"
#include "apps/report/units.hpp"

#include <iostream>

namespace app::crew {

std::jthread watch() {
    return now_and_then([] {
        if (ranks::responds(patience / 2))
            return;
        clear_progress();
        std::cerr << error_mark() << "rank " << ranks::own() << ": MPI has not come back for "
                  << readable(patience / 2)
                  << " s, as where another rank hangs, and the run ends; what has checkpoints goes on with "
                     "--resume, on any number of ranks\n"
                  << std::flush;
        ranks::end_all(farewell(), exit_interrupted);
    });
}

} // namespace app::crew
