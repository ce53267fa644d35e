#include "apps/experiments/experiment.hpp"

#include "apps/experiments/accuracy/run.hpp"
#include "apps/experiments/contact_trial.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/target_files.hpp"
#include "apps/report/recorder.hpp"
#include "apps/report/result.hpp"
#include "domain/accuracy/error_bounds.hpp"
#include "domain/accuracy/respond_within.hpp"
#include "domain/design/error_budget.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/test_surfaces.hpp"
#include "domain/text/words.hpp"
#include "ga/base/stopwatch.hpp"

#include <cmath>

namespace app {

namespace {

std::vector<double> numbers_in(const Settings& settings, const std::string& name) {
    std::vector<double> numbers;
    for (const std::string& part : rough::listed(settings.text(name)))
        numbers.push_back(rough::number_from(part, settings.place(name)));
    if (numbers.empty())
        throw rough::InputError(settings.place(name) + ": none given, expected numbers with commas between");
    return numbers;
}

/// The least of two, as other work on the machine only ever adds.
template <class Work>
double seconds_of(Work work) {
    double least = HUGE_VAL;
    for (int round = 0; round < 2; ++round) {
        const double start = processor_seconds();
        work();
        least = std::min(least, processor_seconds() - start);
    }
    return least;
}

/// A series of the paper's law with every wave down to `parts` to the length.
rough::Genome surface(double H, double length, double parts, ga::Stream random) {
    return rough::random_genome([&](double from, double to) { return random.uniform(from, to); }, 1, 1,
                                length, length / parts, {.A_from = 1, .A_to = 1, .H_from = H, .H_to = H});
}

class AccuracyStudy {
  public:
    AccuracyStudy(const Settings& settings, const Conditions& conditions)
        : settings_(settings), progress_(conditions.progress), stop_(conditions.stop),
          model_(model_from(settings, "model.")) {
        model_.accuracy = accuracy_from(settings, "model.");
        run_.origin = conditions.origin;
        rough::DesignSetup& setup = run_.setup;
        setup.model = model_;
        setup.targets = {rough::read_target(target_files(settings_, "targets.files").front())};
        setup.max_pressure = max_pressure();
    }

    AccuracyRun run() {
        const ga::Stopwatch clock;
        chart_savings();
        design();
        run_.seconds = clock.seconds();
        return std::move(run_);
    }

  private:
    void chart_savings() {
        const long samples = settings_.whole("accuracy.surfaces", 1, 1000);
        const std::vector<double> accuracies = numbers_in(settings_, "accuracy.accuracies");
        const double light = settings_.number("accuracy.light", 1e-3, 1);
        for (const std::string surface_kind : {"smooth", "rough"})
            for (const rough::Kernel kernel : {rough::Kernel::free, rough::Kernel::strip})
                for (const std::string load : {"light", "full"})
                    for (long sample = 0; sample < samples && !stop_.load(); ++sample) {
                        progress_.show(surface_kind + ", " + name_of(kernel) + ", " + load + " load");
                        rough::Model model = rough::exactly(model_);
                        model.body.kernel = kernel;
                        model.loading.reach = load == "light" ? light : 1;
                        const rough::Genome genome = surface(
                            settings_.number("accuracy." + surface_kind + "-H", 0.01, 3), model.grid.length,
                            settings_.number("accuracy." + surface_kind + "-waves", 1, 1000),
                            ga::Stream(ga::fold(ga::fold(run_.origin.seed, surface_kind),
                                                static_cast<std::uint64_t>(sample))));
                        model.grid = rough::resolved_grid(genome, model.grid.length, false);
                        add_savings({surface_kind, name_of(kernel), load, static_cast<int>(sample)}, genome,
                                    model, accuracies);
                    }
    }

    void add_savings(SavingRow row, const rough::Genome& genome, const rough::Model& model,
                     const std::vector<double>& accuracies) {
        rough::AccountedResponse exact, cheap;
        row.resolved_seconds = seconds_of([&] { exact = respond_exactly(genome, model); });
        row.resolved_nodes = model.grid.nodes;
        for (const double accuracy : accuracies) {
            row.accuracy = accuracy;
            row.seconds = seconds_of([&] { cheap = respond_within(genome, model, accuracy); });
            // Both err by what their solvers' certificates leave open.
            row.estimated_error = cheap.account.estimated_error + exact.account.estimated_error;
            row.true_error = rough::relative_error(cheap.response.pressure, exact.response.pressure);
            row.nodes = cheap.account.grids.back();
            row.dropped = cheap.account.dropped.size();
            run_.savings.push_back(row);
        }
    }

    void design() {
        if (stop_.load())
            return;
        progress_.show("a designed surface");
        const rough::DesignSetup& setup = run_.setup;
        rough::SearchOptions options;
        options.seed = run_.origin.seed;
        options.threads = run_.origin.threads;
        options.evaluations = settings_.whole("accuracy.design-budget", 10, 1000000000);
        options.stop = &stop_;
        std::vector<StageRecord> stages;
        const ga::Stopwatch clock;
        const rough::SearchResult found = rough::search(setup, options, {recorder(stages)});
        run_.design = variant_run(found.name, found, std::move(stages), clock.seconds());
        run_.design.answer.response =
            respond(setup, found.best.genome, rough::exactly(model_)).responses.front();
        run_.budget = error_budget(setup, found.best);
    }

    double max_pressure() const { return settings_.pressure("targets.max-pressure"); }

    const Settings& settings_;
    Progress& progress_;
    const std::atomic<bool>& stop_;
    rough::Model model_;
    AccuracyRun run_;
};

std::vector<Setting> accuracy_study_settings() {
    const std::vector<Setting> settings{
        {"accuracy.accuracies", "3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4",
         "accuracies to try, separated by commas"},
        {"accuracy.surfaces", "5", "random surfaces of each kind"},
        {"accuracy.smooth-H", "1.4", "H of the smooth surfaces"},
        {"accuracy.rough-H", "0.6", "H of the rough ones"},
        {"accuracy.smooth-waves", "16", "the smooth ones' shortest wave is the length over this"},
        {"accuracy.rough-waves", "64", "the rough ones'"},
        {"accuracy.light", "0.1", "reach of the light load; the full one's is 1"},
        {"accuracy.design-budget", "1500", "curves and gradients for the designed surface"},
        {"targets.files", "", "target curve (CSV) of the design"},
        {"targets.max-pressure", "1.6e-4", "p_max of Eq. 11, MPa"},
    };
    return joined({settings, model_settings("model."), {accuracy_setting("model.")}});
}

Findings run_accuracy(const Settings& settings, const Conditions& conditions) {
    const auto run = std::make_shared<AccuracyRun>(AccuracyStudy(settings, conditions).run());
    return {[run, folder = conditions.folder] { write_accuracy_study(*run, folder); }};
}

} // namespace

Experiment accuracy_experiment() {
    return {.kind = "accuracy",
            .summary = "what accuracy costs, and what is gained by modelling no more than an answer needs",
            .settings = accuracy_study_settings(),
            .files = {"savings.csv", "medians.csv", "coverage.csv", "budget.csv"},
            .run = run_accuracy};
}

} // namespace app
