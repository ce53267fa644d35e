#pragma once

#include <locale>
#include <sstream>

namespace rough {

/// Text whose numbers have a decimal point and no grouping, whatever the program's locale.
struct PlainStream : std::ostringstream {
    PlainStream() { imbue(std::locale::classic()); }
};

} // namespace rough
