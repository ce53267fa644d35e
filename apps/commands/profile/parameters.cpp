#include "apps/commands/profile/parameters.hpp"

#include "apps/prompt/verbosity.hpp"
#include "apps/report/units.hpp"
#include "domain/errors.hpp"
#include "domain/text/atomic_file.hpp"

#include <cmath>
#include <cstdio>

namespace app {

void print_parameters(const std::vector<rough::SurfaceParameter>& all, double largest) {
    const Unit height = length_unit(largest);
    for (const rough::SurfaceParameter& one : all) {
        char line[160];
        if (std::isfinite(one.value))
            std::snprintf(line, sizeof line, "  %-14s %12.6g %-5s %s", one.name.c_str(),
                          one.value * (one.unit == "mm" ? height.factor : 1),
                          one.unit == "mm" ? height.name.c_str() : one.unit.c_str(), one.meaning.c_str());
        else
            std::snprintf(line, sizeof line, "  %-14s %12s %-5s %s", one.name.c_str(), "none", "",
                          one.meaning.c_str());
        say(line);
    }
}

void add_parameters(nlohmann::json& values, const std::vector<rough::SurfaceParameter>& rows,
                    const std::vector<rough::SurfaceParameter>& more) {
    for (const rough::SurfaceParameter& one : rows)
        values[one.key()] = one.value;
    for (const auto* const all : {&rows, &more})
        for (const rough::SurfaceParameter& one : *all)
            values["parameters"].push_back(
                {{"name", one.name}, {"value", one.value}, {"unit", one.unit}, {"meaning", one.meaning}});
}

void write_pages(const std::filesystem::path& folder,
                 const std::vector<std::pair<std::string, std::string>>& pictures) {
    const PageSource source = page_source(folder);
    for (const auto& [file, figure] : pictures)
        try {
            rough::write_atomically(folder / file, figure_file(figure, source));
        } catch (const rough::InputError& error) {
            say("note: " + file + " is left out: " + error.what());
        }
    rough::write_atomically(page_of(source), render(source));
}

} // namespace app
