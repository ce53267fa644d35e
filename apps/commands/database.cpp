#include "apps/commands/database.hpp"

#include "apps/cluster/evaluator.hpp"
#include "apps/commands/commands.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/terminal.hpp"
#include "apps/report/output.hpp"
#include "domain/text/atomic_file.hpp"

#include <cstdio>
#include <iostream>

namespace app {
namespace {

Bindings bindings_of(rough::GenomeDistribution& law) {
    Bindings bindings{
        {whole("series", std::to_string(law.series), 1, 16, "number of series of a genome"), law.series},
        {whole("ridges", "", 1, 1000, "ridges M of each chromosome [1; for a map, their directions: 8]"), law.ridges},
        {positive("shortest-wave", "", "shortest wavelength, mm [8 node spacings]"), law.shortest},
        {whole("seed", std::to_string(law.seed), 0, 0x1p53, "seed of the genomes"), law.seed},
    };
    return with_bounds(std::move(bindings), law, 1 + 1e-9); // the domain limits the number of waves
}

const Setting file_setting{"file", "", "the database (may be given without the flag)"};

std::filesystem::path given_file(const Settings& settings) {
    if (!settings.has("file")) rough::refuse("database: no file given; name a genome database");
    return settings.text("file");
}

/// The settings that decide the genomes and responses of a database.
std::vector<Setting> setup_settings() {
    rough::GenomeDistribution usual;
    return joined({settings_of(bindings_of(usual)), model_settings()});
}

bool any_given(const Settings& settings, const std::vector<Setting>& of) {
    return std::ranges::any_of(of, [&](const Setting& setting) { return settings.given(setting.name); });
}

int database_build(const Settings& settings, const std::string&) {
    rough::BuildOptions options;
    take(settings, app::bindings_of(options));
    if (!cluster::is_alone()) options.computing = computing_on_ranks(options.threads);

    rough::GenomeStore store = database_from(given_file(settings), settings);
    const Interrupt interrupt;
    ProgressLine progress;
    const std::uint64_t before = store.stored();
    const ga::Stopwatch clock;
    options.go_on = [&](std::uint64_t stored) {
        const double rate = static_cast<double>(stored - before) / clock.seconds();
        const double left = static_cast<double>(options.genomes - std::min(stored, options.genomes)) / rate;
        progress.show(std::to_string(stored) + " of " + std::to_string(options.genomes) + " genomes, " +
                      duration_words(left) + " left");
        return !interrupt.requested();
    };
    options.stop = &interrupt.flag();
    rough::build(store, options);
    const std::uint64_t stored = store.stored();
    say(store.file().string() + ": " + std::to_string(stored) + " genomes stored, " + std::to_string(stored - before) +
        " in the last " + duration_words(clock.seconds()));
    return interrupt.requested() ? exit_interrupted : 0;
}

int database_info(const Settings& settings, const std::string&) {
    const rough::GenomeStore store = rough::GenomeStore::open(given_file(settings));
    const auto curves = store.curves();
    const auto failed = std::ranges::count_if(curves.range, [](double range) { return std::isnan(range); });
    std::cout << "genomes " << store.stored() << "\nwithout_response " << failed << "\nbytes "
              << std::filesystem::file_size(store.file()) << "\nversion " << printable(store.version()) << "\n";
    for (const auto& [name, value] : rough::named_values(store.setup())) std::cout << name << " " << value << "\n";
    return 0;
}

int database_merge(const Settings& settings, const std::string&) {
    const Words names = settings.words("files");
    const std::vector<std::filesystem::path> files(names.begin(), names.end());
    if (files.size() < 2 || !settings.has("out"))
        rough::refuse("database merge: too little given; name two or more genome databases, then --out "
                      "and the file to write");
    const auto out = expect_writable(settings.text("out"), settings);
    std::error_code none;
    for (const auto& file : files)
        if (std::filesystem::equivalent(file, out, none))
            rough::refuse("--out: ", out.string(), " is read here; choose another name");
    say(out.string() + ": " + std::to_string(rough::merge(files, out)) + " genomes of " + std::to_string(files.size()) +
        " files");
    return 0;
}

int database_query(const Settings& settings, const std::string&) {
    if (!settings.has("target")) rough::refuse("--target: missing; name a target file");
    std::filesystem::path out;
    if (settings.has("out")) out = expect_writable(settings.text("out"), settings);
    const std::vector targets{rough::read_target(settings.text("target"))};
    const ga::Stopwatch clock;
    const rough::GenomeStore store = rough::GenomeStore::open(given_file(settings));
    const rough::DesignSetup setup = query_from(settings, store, targets);
    const auto answers =
        stored_answers(store, setup, settings.whole<std::size_t>("best"), settings.whole<int>("threads"));
    if (answers.empty())
        rough::refuse(store.file().string(), ": no stored curve reaches the end of the target; "
                                             "use a database with more genomes");
    std::printf("%llu curves screened in %.3f s\n%4s %12s %12s %12s %14s\n",
                static_cast<unsigned long long>(store.stored()), clock.seconds(), "rank", "genome", "similarity",
                "worst", "scale");
    for (std::size_t rank = 0; rank < answers.size(); ++rank) {
        const auto& [index, scale, answer] = answers[rank];
        std::printf("%4zu %12llu %12.6f %12.6f %14.6g\n", rank + 1, static_cast<unsigned long long>(index),
                    answer.similarity, answer.lowest(), scale);
    }
    if (settings.has("out"))
        rough::write_atomically(out, rough::genome_file_text(answers.front().answer.genome, setup.model.grid.length));
    return 0;
}

} // namespace

Bindings bindings_of(rough::BuildOptions& options) {
    return {
        {whole("genomes", std::to_string(options.genomes), 1, 1e9, "number of genomes in the file at the end"),
         options.genomes},
        {whole("first", std::to_string(options.first), 0, 1e12,
               "number of the first genome, for a part that is merged with others"),
         options.first},
        {whole("batch", std::to_string(options.batch), 1, 1e5,
               "genomes stored at a time, which are lost if the program is killed"),
         options.batch},
        {threads_setting(), options.threads},
    };
}

std::vector<Setting> build_settings() {
    rough::BuildOptions options;
    return joined({settings_of(bindings_of(options)), setup_settings()});
}

rough::GenomeStore database_from(const std::filesystem::path& file, const Settings& settings) {
    if (!any_given(settings, setup_settings()) && rough::GenomeStore::begun(file))
        return rough::GenomeStore::open(file);
    rough::DatabaseSetup setup{surface_model_from(settings), {}};
    if (setup.model.grid.is_2d()) setup.law.ridges = 8;
    setup.law.lambda = setup.model.grid.length;
    setup.law.shortest = 8 * setup.model.grid.widest_spacing();
    take(settings, bindings_of(setup.law));
    expect_in_order(settings, {"hurst", "gamma"});
    rough::validate(setup.law);
    respond(rough::drawn(setup.law, 0), setup.model); // throws before a file is made
    return rough::GenomeStore::create(file, setup);
}

std::vector<Setting> query_settings() {
    return joined(
        {{max_pressure_setting(), whole("best", "10", 1, 1e9, "number of genomes to list"), threads_setting()},
         model_settings()});
}

rough::DesignSetup query_from(const Settings& settings, const rough::GenomeStore& store,
                              const std::vector<rough::Target>& targets) {
    // The stored curves are scaled to the model of the settings.
    rough::DesignSetup setup{.model = any_given(settings, model_settings()) ? surface_model_from(settings)
                                                                            : store.setup().model,
                             .targets = targets};
    settings.take("max-pressure", setup.max_pressure);
    return setup;
}

Command database_command() {
    const Setting files = Setting("files", "", "the databases (may be given without the flag)").several('\n');
    const std::vector<Command> parts{
        {"build", joined({{file_setting}, build_settings()}), database_build, {"file"}},
        {"info", {file_setting}, database_info, {"file"}},
        {"merge", {files, {"out", "", "the file to write"}, force_setting()}, database_merge, {"files"}},
        {"query",
         joined({{file_setting,
                  {"target", "", "target file (CSV), as in rugosa design"},
                  {"out", "", "genome file (JSON) to write the best one to"},
                  force_setting()},
                 query_settings()}),
         database_query,
         {"file"}}};
    return {"database", {}, {}, {}, parts};
}

} // namespace app
