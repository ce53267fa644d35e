#include "domain/scan/source.hpp"

#include "domain/errors.hpp"
#include "domain/mwm/sampling.hpp"

namespace rough {

Grid Source::grid(bool periodic) const {
    if (genome)
        return {.length = length, .periodic = periodic};
    const Index nodes = measured.nodes();
    return {nodes, measured.spacing * static_cast<double>(periodic ? nodes : nodes - 1), periodic};
}

Profile Source::on(const Grid& wanted) const {
    if (genome)
        return sample(*genome, wanted);
    if (wanted.nodes != measured.nodes())
        throw InputError(
            line_of(name, ": a grid of ", wanted.nodes, " nodes; use the scan's ", measured.nodes()),
            "nodes");
    Profile profile = measured;
    if (wanted.length != grid(wanted.periodic).length)
        profile.spacing = wanted.spacing();
    return profile;
}

Source open_genome(const std::filesystem::path& file) {
    GenomeFile read = read_genome_file(file);
    return {file.string(), std::move(read.genome), read.length};
}

Source open_scan(const std::filesystem::path& file, const ScanOptions& options) {
    Scan scan = read_scan(file, options);
    return {.name = file.string(),
            .genome = {},
            .measured = std::move(scan.profile),
            .account = std::move(scan.account),
            .outliers = std::move(scan.outliers)};
}

} // namespace rough
