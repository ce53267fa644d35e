#include "apps/commands/database/parts.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/report/output.hpp"
#include "domain/accuracy/respond.hpp"
#include "domain/database/screen.hpp"
#include "domain/database/starts.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/genome_json.hpp"
#include "domain/target/similarity.hpp"
#include "domain/text/atomic_file.hpp"
#include "ga/base/stopwatch.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace app {

namespace {

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

/// Flags that name a set-up must name the file's, but for length and modulus.
rough::DatabaseScale scale_asked(const rough::GenomeStore& store, const Settings& settings) {
    bool given = false;
    for (const Setting& setting : model_settings())
        given |= settings.given(setting.name);
    return given ? rough::scale_to(store, model_from(settings)) : rough::DatabaseScale();
}

/// The match's similarity at 4(N-1)+1 nodes; Eq. 11 anew where it applies.
double refined_similarity(const rough::Genome& genome, const rough::Match& match, const rough::Model& model,
                          const rough::Target& goal, double max_pressure) {
    const rough::Response response = respond(genome, refined(model, 4));
    const double factor =
        max_pressure > 0 ? max_pressure / response.pressure[response.steps() - 1] : match.scale;
    const rough::Curve curve = curve_of(goal.quantity, scaled(response, factor));
    return curve.to * (1 + 1e-9) >= goal.last() ? similarity(goal, curve) : std::nan("");
}

} // namespace

int database_query(const Words& words) {
    if (shows_help(words,
                   "database query FILE --target T.csv [--max-pressure P] [--best K] [--out GENOME.json]",
                   "Scores every stored curve against a target (Eq. 12) and names the nearest genomes, each "
                   "also on a grid four times finer. Flags of a set-up are compared with the file's; another "
                   "length or modulus is scaled to exactly.",
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
    rough::ScreenOptions options;
    if (settings.has("max-pressure"))
        options.max_pressure = settings.pressure("max-pressure");
    options.best = static_cast<std::size_t>(settings.whole("best", 1, 10000));
    options.threads = settings.threads("threads");
    rough::Target goal = rough::read_target(settings.text("target"));

    const ga::Stopwatch clock;
    const rough::GenomeStore store = rough::GenomeStore::open(settings.text("file"));
    const rough::DatabaseScale scale = scale_asked(store, settings);
    goal = unscaled(std::move(goal), scale);
    options.max_pressure /= scale.pressure;
    const rough::StoredCurves curves = store.curves(rough::need_fractions({goal}));
    const auto matches = screen(curves, store.setup().model, {goal}, options);
    const double seconds = clock.seconds();

    std::printf("%zu curves screened in %.3f s\n%4s %12s %12s %12s %14s\n", curves.index.size(), seconds,
                "rank", "genome", "similarity", "refined", "scale");
    for (std::size_t rank = 0; rank < matches.size(); ++rank) {
        const rough::Match& match = matches[rank];
        rough::Genome genome = store.genome(match.index);
        const double finer =
            refined_similarity(genome, match, store.setup().model, goal, options.max_pressure);
        std::printf("%4zu %12llu %12.6f %12.6f %14.6g\n", rank + 1,
                    static_cast<unsigned long long>(match.index), match.similarity, finer, match.scale);
        if (rank == 0 && settings.has("out")) {
            genome = rough::drawn_out(std::move(genome), scale.length);
            genome.scale *= match.scale;
            rough::write_atomically(
                out, rough::genome_file_text(genome, scale.length * store.setup().model.grid.length));
        }
    }
    return 0;
}

} // namespace app
