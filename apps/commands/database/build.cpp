#include "domain/database/build.hpp"

#include "apps/cluster/cluster.hpp"
#include "apps/commands/database/parts.hpp"
#include "apps/prompt/interrupt.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/progress.hpp"
#include "apps/prompt/verbosity.hpp"
#include "domain/accuracy/respond.hpp"
#include "domain/errors.hpp"
#include "ga/base/stopwatch.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace app {

namespace {

std::vector<Setting> law_settings() {
    return {
        {"series", "1", "series a genome is the sum of"},
        {"ridges", "1", "ridges M of each chromosome"},
        {"hurst-from", "0.5", "smallest H"},
        {"hurst-to", "1.5", "largest H"},
        {"gamma-from", "1.4", "smallest gamma"},
        {"gamma-to", "2", "largest gamma"},
        {"shortest", "", "shortest wave length, mm [8 node spacings]"},
        {"seed", "1", "seed of the genomes"},
    };
}

std::vector<Setting> build_settings() {
    const std::vector<Setting> settings{
        {"file", "", "the database (may be given without the flag)"},
        {"genomes", "100000", "how many genomes the file is to hold"},
        {"first", "0", "number of the first: a part of the law's genomes, to be merged with others"},
        {"batch", "250", "genomes stored at a time: what a kill may cost"},
        {"threads", "0", "threads; 0 takes all"},
    };
    return joined({settings, law_settings(), model_settings()});
}

rough::DatabaseSetup setup_from_flags(const Settings& settings) {
    rough::DatabaseSetup setup;
    setup.model = model_from(settings);
    rough::GenomeDistribution& law = setup.law;
    law.series = static_cast<int>(settings.whole("series", 1, 16));
    law.ridges = static_cast<int>(settings.whole("ridges", 1, 1000));
    law.H_from = settings.number("hurst-from", 0, 10);
    law.H_to = settings.number("hurst-to", 0, 10);
    law.gamma_from = settings.number("gamma-from", 1, 1000);
    law.gamma_to = settings.number("gamma-to", 1, 1000);
    law.lambda = setup.model.grid.length;
    law.shortest = settings.has("shortest") ? settings.positive("shortest") : 8 * setup.model.grid.spacing();
    law.seed = settings.seed("seed");
    return setup;
}

/// The file of the flags' set-up; where the flags say nothing of a set-up and the file exists, that file as
/// it is.
rough::GenomeStore opened(const Settings& settings) {
    const std::filesystem::path file = settings.text("file");
    bool set_up_given = false;
    for (const Setting& setting : joined({law_settings(), model_settings()}))
        set_up_given |= settings.given(setting.name);
    if (!set_up_given && rough::GenomeStore::begun(file))
        return rough::GenomeStore::open(file);
    const rough::DatabaseSetup setup = setup_from_flags(settings);
    rough::validate(setup.law);
    respond(rough::drawn(setup.law, 0), setup.model); // a set-up without a solution makes no file
    return rough::GenomeStore::create(file, setup);
}

} // namespace

int database_build(const Words& words) {
    if (shows_help(words, "database build FILE [--genomes N] [flags]",
                   "Draws genomes, computes their responses and stores both, batch by batch. A build that "
                   "was stopped or killed goes on where it ended; several may work on one file at once. "
                   "Without model flags, an existing file is continued with its own model.",
                   build_settings(),
                   {"database build genomes.db --genomes 100000",
                    "database build genomes.db --genomes 200000     (doubles it)",
                    "database build b.db --first 100000 --genomes 100000     (other genomes of the same law)",
                    "database build strip.db --kernel strip --nodes 256 --series 2"}))
        return 0;
    const Settings settings = read_command_line(words, build_settings(), {"file"});
    if (!settings.has("file"))
        throw rough::InputError("database build: no file given, expected the database to build");
    rough::BuildOptions options;
    options.genomes = static_cast<std::uint64_t>(settings.whole("genomes", 1, 1000000000));
    options.batch = static_cast<std::uint64_t>(settings.whole("batch", 1, 100000));
    options.first = static_cast<std::uint64_t>(settings.whole("first", 0, 1000000000000));
    options.threads = settings.threads("threads");
    if (!cluster::is_alone())
        options.computing = computing_on_ranks(options.threads);

    rough::GenomeStore store = opened(settings);
    const Interrupt interrupt;
    Progress progress;
    const std::uint64_t before = store.stored();
    const ga::Stopwatch clock;
    options.go_on = [&](std::uint64_t stored) {
        const double rate = static_cast<double>(stored - before) / clock.seconds();
        const double left = static_cast<double>(options.genomes - std::min(stored, options.genomes)) / rate;
        progress.show(std::to_string(stored) + " of " + std::to_string(options.genomes) + " genomes, " +
                      duration_words(left) + " left");
        return !interrupt.asked();
    };
    options.stop = &interrupt.flag();
    rough::build(store, options);
    const std::uint64_t stored = store.stored();
    say(store.file().string() + ": " + std::to_string(stored) + " genomes stored, " +
        std::to_string(stored - before) + " of them in the last " + duration_words(clock.seconds()));
    return interrupt.asked() ? exit_interrupted : 0;
}

int database_info(const Words& words) {
    const std::vector<Setting> known{{"file", "", "the database (may be given without the flag)"}};
    if (shows_help(words, "database info FILE",
                   "Says what a genome database holds and to which set-up it belongs.", known,
                   {"database info genomes.db"}))
        return 0;
    const Settings settings = read_command_line(words, known, {"file"});
    if (!settings.has("file"))
        throw rough::InputError("database info: no file given, expected a genome database");
    const rough::GenomeStore store = rough::GenomeStore::open(settings.text("file"));
    const auto curves = store.curves();
    const auto failed = std::count_if(curves.range.begin(), curves.range.end(),
                                      [](double range) { return std::isnan(range); });
    std::cout << "genomes " << store.stored() << "\nwithout_response " << failed << "\nbytes "
              << std::filesystem::file_size(store.file()) << "\nversion " << store.version() << "\n";
    for (const auto& [name, value] : rough::fields(store.setup()))
        std::cout << name << " " << value << "\n";
    return 0;
}

} // namespace app
