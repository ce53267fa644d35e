#include "domain/database/store.hpp"
#include "domain/errors.hpp"
#include "domain/problem/drawn_start.hpp"

#include <charconv>

namespace rough {
namespace {

/// The value of a field, or null.
const std::string* find(const NamedValues& fields, const std::string& name) {
    const auto found = std::ranges::find(fields, name, &NamedValues::value_type::first);
    return found == fields.end() ? nullptr : &found->second;
}

/// Visits the parameters of a law with their names.
template <class Law, class Visit>
void visit_law(Law& law, const Visit& visit) {
    visit("series", law.series);
    visit("ridges", law.ridges);
    visit("H_from", law.H_from);
    visit("H_to", law.H_to);
    visit("gamma_from", law.gamma_from);
    visit("gamma_to", law.gamma_to);
    visit("lambda_mm", law.lambda);
    visit("shortest_wave_mm", law.shortest);
    visit("seed", law.seed);
}

} // namespace

void validate(const GenomeDistribution& law) {
    const auto expect = [](bool good, const auto&... parts) {
        if (!good) refuse("genome law: ", parts...);
    };
    expect(law.series >= 1 && law.series <= 16, "series ", law.series, " is out of range (1 to 16)");
    expect(law.ridges >= 1 && law.ridges <= 1000, "ridges ", law.ridges, " is out of range (1 to 1000)");
    expect(law.H_from > 0 && law.H_from <= law.H_to && std::isfinite(law.H_to), "H from ", law.H_from, " to ", law.H_to,
           " is not a range above 0; give ascending bounds above 0");
    expect(law.gamma_from > 1 && law.gamma_from <= law.gamma_to && std::isfinite(law.gamma_to), "gamma from ",
           law.gamma_from, " to ", law.gamma_to, " is not a range above 1; give ascending bounds above 1");
    expect(law.shortest > 0 && law.shortest <= law.lambda && std::isfinite(law.lambda), "waves from ", law.shortest,
           " to ", law.lambda, " mm is not a range above 0; give ascending bounds above 0");
    expect(max_phases(law) <= 1e6, "up to ", max_phases(law),
           " phases per genome are more than 1e6; give fewer series or ridges, or longer waves");
}

double max_phases(const GenomeDistribution& law) {
    const double chromosomes = 1 + std::floor(std::log(law.lambda / law.shortest) / std::log(law.gamma_from));
    return law.series * static_cast<double>(law.ridges) * chromosomes;
}

Genome drawn(const GenomeDistribution& law, std::uint64_t index) {
    ga::Stream random(ga::fold(ga::fold(law.seed, "genome database"), index));
    Genome genome;
    for (int s = 0; s < law.series; ++s) {
        Series series;
        series.A = s == 0 ? 1 : 1 - random.uniform();
        series.H = random.uniform(law.H_from, law.H_to);
        series.gamma = random.uniform(law.gamma_from, law.gamma_to);
        series.lambda = law.lambda;
        add_chromosomes(series, law.shortest, law.ridges, random);
        genome.series.push_back(std::move(series));
    }
    return genome;
}

NamedValues named_values(const DatabaseSetup& setup) {
    NamedValues all = named_values(setup.model);
    visit_law(setup.law, [&](const char* name, auto value) {
        if constexpr (std::is_integral_v<decltype(value)>)
            all.emplace_back(name, std::to_string(value));
        else
            all.emplace_back(name, field_text(value));
    });
    return all;
}

DatabaseSetup setup_from(const NamedValues& fields, const std::string& where) {
    const auto text = [&](const char* name) -> const std::string& {
        if (const std::string* value = find(fields, name)) return *value;
        throw InputError(where + ": has no " + name + "; give a genome database");
    };
    const auto read = [&](const char* name, auto& value) {
        const std::string& word = text(name);
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc{} || end != word.data() + word.size())
            refuse(where, ": ", name, ": '", word, "' is not a number; give a genome database");
    };
    DatabaseSetup setup;
    Model& model = setup.model;
    model.body.kernel = kernel_named(text("kernel"), where + ": kernel");
    model.grid.periodic = model.body.kernel == Kernel::periodic;
    read("nodes", model.grid.nodes);
    read("length_mm", model.grid.length);
    read("effective_modulus_MPa", model.body.effective_modulus);
    read("steps", model.loading.steps);
    read("reach", model.loading.reach.emplace());
    if (find(fields, "rows")) {
        read("rows", model.grid.rows);
        read("width_mm", model.grid.width);
    }
    if (model.body.kernel == Kernel::free && !model.grid.is_2d()) read("datum_mm", model.body.datum.emplace());
    if (model.body.kernel == Kernel::strip) read("strip_width_mm", model.body.strip_width.emplace());
    visit_law(setup.law, read);
    const auto within = [](double value, double above, double to) { return value > above && value <= to; };
    constexpr double largest = std::numeric_limits<double>::max();
    const Grid& grid = model.grid;
    const Index most = std::max(grid.nodes, grid.rows), max_nodes = grid.is_2d() ? 512 : 10'000; // verified on 4 times
    if (most > max_nodes) refuse(where, ": nodes ", most, " are too many for a database; give at most ", max_nodes);
    if (!within(static_cast<double>(grid.nodes), 1, largest) || !within(grid.length, 0, largest) ||
        (find(fields, "rows") &&
         (!within(static_cast<double>(grid.rows), 1, largest) || !within(grid.width, 0, largest))) ||
        !within(model.body.effective_modulus, 0, largest) || !within(model.loading.steps, 0, 1e6) ||
        !within(*model.loading.reach, 0, 1))
        throw InputError(where + ": its set-up has no contact solution; give a genome database");
    return setup;
}

std::string difference(const NamedValues& there, const NamedValues& wanted) {
    for (const auto& [name, value] : wanted) {
        const std::string* here = find(there, name);
        if (!here || *here != value) return name + " is " + (here ? *here : "not set") + ", not " + value;
    }
    return "";
}

} // namespace rough
