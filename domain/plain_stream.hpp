#pragma once

#include <locale>
#include <sstream>

namespace rough {

/// A text stream whose numbers have a decimal point and no grouping in every locale.
struct PlainStream : std::ostringstream {
    PlainStream() { imbue(std::locale::classic()); }
};

} // namespace rough
