#include "apps/cluster/cluster.hpp"
#include "apps/cluster/evaluator.hpp"
#include "apps/commands/commands.hpp"
#include "apps/prompt/interrupt.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/settings.hpp"
#include "apps/prompt/terminal.hpp"
#include "apps/report/output.hpp"
#include "domain/accuracy/respond.hpp"
#include "domain/database/build.hpp"
#include "domain/database/starts.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/genome_json.hpp"
#include "domain/text/atomic_file.hpp"
#include "ga/base/stopwatch.hpp"
#include "ga/text/nearest.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
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

int database_merge(const Words& words) {
    const std::vector<Setting> known{{"out", "", "the file to write"},
                                     {"force", "", "write over an existing file", true}};
    if (shows_help(words, "database merge A.db B.db ... --out C.db",
                   "Puts files of one set-up and law, as built on several machines, into one. Genomes that "
                   "several of them hold are taken once. Every genome is checked against its law.",
                   known, {"database merge a.db b.db --out genomes.db"}))
        return 0;
    const auto flags = std::find_if(words.begin(), words.end(),
                                    [](const std::string& word) { return word.starts_with("--"); });
    const std::vector<std::filesystem::path> files(words.begin(), flags);
    const Settings settings = read_command_line({flags, words.end()}, known);
    if (files.size() < 2 || !settings.has("out"))
        throw rough::InputError("database merge: expected two genome databases at least, then --out and the "
                                "file to write");
    const auto out = expect_writable(settings.text("out"), settings);
    std::error_code none;
    for (const auto& file : files)
        if (std::filesystem::equivalent(file, out, none))
            throw rough::InputError("--out: " + out.string() +
                                    " would be written over, and is read here; expected another name");
    say(out.string() + ": " + std::to_string(rough::merge(files, out)) + " genomes of " +
        std::to_string(files.size()) + " files");
    return 0;
}

std::vector<Setting> query_settings() {
    const std::vector<Setting> settings{
        {"file", "", "the database (may be given without the flag)"},
        {"target", "", "target file (CSV), as in rugosa design"},
        {"max-pressure", "", "pressure that every genome is rescaled to by Eq. 11, MPa [amplitude is free]"},
        {"best", "10", "how many genomes to name"},
        {"out", "", "genome file (JSON) to write the best one to"},
        {"force", "", "write over an existing genome file", true},
        {"threads", "0", "threads; 0 takes all"},
    };
    return joined({settings, model_settings()});
}

/// The model of the flags, to which the file is scaled. Without flags of a set-up: the model of the file.
rough::Model model_asked(const rough::GenomeStore& store, const Settings& settings) {
    bool given = false;
    for (const Setting& setting : model_settings())
        given |= settings.given(setting.name);
    return given ? model_from(settings) : store.setup().model;
}

int database_query(const Words& words) {
    if (shows_help(
            words, "database query FILE --target T.csv [--max-pressure P] [--best K] [--out GENOME.json]",
            "Scores every stored curve against a target (Eq. 12), verifies the nearest as a design is "
            "verified, and names the best of them. worst is the lowest similarity on the file's grid, on "
            "a grid four times finer, in four times the load steps, and in both. Flags of a set-up are "
            "compared with the file's; another length or modulus is scaled to exactly.",
            query_settings(),
            {"database query genomes.db --target target.csv --best 5",
             "database query genomes.db --target target.csv --max-pressure 1.6e-4 --out best.json"}))
        return 0;
    const Settings settings = read_command_line(words, query_settings(), {"file"});
    if (!settings.has("file") || !settings.has("target"))
        throw rough::InputError("database query: expected a genome database and --target");
    std::filesystem::path out;
    if (settings.has("out"))
        out = expect_writable(settings.text("out"), settings);
    rough::DesignSetup setup;
    if (settings.has("max-pressure"))
        setup.max_pressure = settings.pressure("max-pressure");
    const auto best = static_cast<std::size_t>(settings.whole("best", 1, 10000));
    setup.targets = {rough::read_target(settings.text("target"))};

    const ga::Stopwatch clock;
    const rough::GenomeStore store = rough::GenomeStore::open(settings.text("file"));
    setup.model = model_asked(store, settings);
    const auto answers = stored_answers(store, setup, best, settings.threads("threads"));
    if (answers.empty())
        throw rough::InputError(store.file().string() + ": no stored curve reaches the end of the target, "
                                                        "expected a database with more genomes");
    std::printf("%llu curves screened in %.3f s\n%4s %12s %12s %12s %14s\n",
                static_cast<unsigned long long>(store.stored()), clock.seconds(), "rank", "genome",
                "similarity", "worst", "scale");
    for (std::size_t rank = 0; rank < answers.size(); ++rank) {
        const auto& [index, scale, answer] = answers[rank];
        std::printf("%4zu %12llu %12.6f %12.6f %14.6g\n", rank + 1, static_cast<unsigned long long>(index),
                    answer.similarity, answer.lowest(), scale);
    }
    if (settings.has("out"))
        rough::write_atomically(
            out, rough::genome_file_text(answers.front().answer.genome, setup.model.grid.length));
    return 0;
}

} // namespace

int database(const Words& words) {
    const std::vector<Command> parts{
        {"build", "compute genomes and their responses into a file; goes on where it ended", database_build},
        {"info", "what a file holds and to which set-up it belongs", database_info},
        {"merge", "several files of one set-up and law as one", database_merge},
        {"query", "the stored genomes nearest to a target", database_query}};
    if (words.empty())
        throw rough::InputError(
            "database: nothing given, expected build, info, merge or query ('rugosa database "
            "--help' tells more)");
    if (words[0] == "--help" || words[0] == "-h") {
        std::cout << "Usage: rugosa database (build | info | merge | query) FILE [flags]\n\n"
                     "A genome database keeps computed responses, so that a new target is answered in a "
                     "second.\n\n";
        for (const Command& part : parts)
            std::cout << "  " << part.name << std::string(8 - std::string(part.name).size(), ' ')
                      << part.summary << "\n";
        std::cout << "\n'rugosa database build --help' and so on tell the flags.\n\nExamples:\n"
                     "  rugosa database build genomes.db --genomes 100000\n"
                     "  rugosa database info genomes.db\n"
                     "  rugosa database merge a.db b.db --out genomes.db\n"
                     "  rugosa database query genomes.db --target target.csv\n";
        return 0;
    }
    std::vector<std::string> names;
    for (const Command& part : parts) {
        if (words[0] == part.name)
            return part.run({words.begin() + 1, words.end()});
        names.push_back(part.name);
    }
    throw rough::InputError("database: '" + words[0] + "' given" + ga::suggestion(words[0], names));
}

} // namespace app
