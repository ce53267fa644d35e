#include "apps/commands/commands.hpp"
#include "domain/design/pipelines.hpp"
#include "ga/text/listing.hpp"

#include <iostream>

namespace app {
namespace {

int operators(const Settings&, const std::string&) {
    rough::DesignSetup two_targets;
    two_targets.targets.resize(2);
    std::cout << ga::listing(rough::design_registry(two_targets));
    std::cout << "\nvariants\n";
    for (const auto& [name, text] : rough::design_variants()) std::cout << "  " << name << " = " << text << "\n";
    return 0;
}

} // namespace

Command operators_command() { return {"operators", {}, operators}; }

} // namespace app
