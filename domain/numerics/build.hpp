#pragma once

#include <string>

namespace rough {

/// What decides the last bits of a result beside its input: the same build on the same kind of vectors gives
/// the same bits.
struct Build {
    std::string compiler; ///< name and version
    std::string flags;    ///< optimisation and tuning
    std::string vectors;  ///< of the hot loops, as vector_loops() has picked them
};

/// The build of this library, on this processor.
Build build();

} // namespace rough
