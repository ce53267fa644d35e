#include "domain/scan/source.hpp"

#include "domain/errors.hpp"
#include "domain/mwm/sampling.hpp"

namespace rough {

Grid Source::grid(bool periodic) const {
    Grid own;
    own.periodic = periodic;
    own.length = length;
    if (!genome) {
        own.nodes = measured.nodes();
        own.length = measured.spacing * static_cast<double>(periodic ? own.nodes : own.nodes - 1);
    }
    return own;
}

Profile Source::on(const Grid& wanted) const {
    if (genome)
        return sample(*genome, wanted);
    if (wanted.nodes != measured.nodes())
        throw InputError(name + ": a grid of " + std::to_string(wanted.nodes) +
                             " nodes given, expected one of the scan's " + std::to_string(measured.nodes()),
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
    Source source{file.string(), {}};
    source.measured = std::move(scan.profile);
    source.account = std::move(scan.account);
    source.outliers = std::move(scan.outliers);
    return source;
}

} // namespace rough
