#include "domain/target/names.hpp"

#include "domain/errors.hpp"

#include <algorithm>

namespace rough {

const std::vector<std::string>& quantity_names() {
    static const std::vector<std::string> names{"stiffness", "area", "area-displacement", "load",
                                                "interface_stiffness"};
    return names;
}

const std::string& name_of(Quantity quantity) { return quantity_names()[static_cast<std::size_t>(quantity)]; }

Quantity quantity_named(const std::string& name) {
    const auto& names = quantity_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        refuse_value("quantity", "'", name,
                     "' given, expected stiffness, area, area-displacement, load or interface_stiffness");
    return static_cast<Quantity>(found - names.begin());
}

} // namespace rough
