#include "apps/report/solids.hpp"

#include "apps/prompt/terminal.hpp"
#include "domain/text/atomic_file.hpp"

namespace app {

namespace {

constexpr rough::Index most_nodes = 1'000'000, most_3mf_nodes = 100'000;

} // namespace

Solids solids_of(const rough::Profile& surface, const rough::Extrusion& extrusion) {
    const rough::Index nodes = surface.nodes();
    return {nodes <= most_nodes ? binary_stl(surface, extrusion) : "",
            nodes <= most_3mf_nodes ? three_mf(surface, extrusion) : "", nodes};
}

std::vector<std::string> write_solids(const Solids& solids, const std::filesystem::path& folder,
                                      const std::string& name) {
    std::vector<std::string> files;
    const auto write = [&](const std::string& file, const std::string& content, const char* why) {
        if (content.empty())
            return say("note: " + file + " is left out, as " + why);
        rough::write_atomically(folder / file, content);
        files.push_back(file);
    };
    write(name + ".stl", solids.stl, "a solid of more than 1e6 nodes is of no use to any printer");
    write(name + ".3mf", solids.three_mf, "its text would have 500 bytes for each of more than 1e5 nodes");
    return files;
}

} // namespace app
