#include "domain/database/setup.hpp"

#include "domain/contact/names.hpp"
#include "domain/errors.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace rough {
namespace {

const std::string* find(const Fields& fields, const std::string& name) {
    const auto found =
        std::find_if(fields.begin(), fields.end(), [&](const auto& field) { return field.first == name; });
    return found == fields.end() ? nullptr : &found->second;
}

/// Reads fields one by one.
class Reader {
  public:
    Reader(const Fields& fields, const std::string& where) : fields_(fields), where_(where) {}

    template <class Number>
    void operator()(const char* name, Number& value) const {
        const std::string& word = text(name);
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc{} || end != word.data() + word.size())
            throw InputError(where_ + ": " + name + " is '" + word + "', expected a number");
    }
    const std::string& text(const char* name) const {
        if (const std::string* value = find(fields_, name))
            return *value;
        throw InputError(where_ + ": no " + name + " in it, expected a genome database");
    }

  private:
    const Fields& fields_;
    const std::string& where_;
};

} // namespace

Fields fields(const DatabaseSetup& setup) {
    Fields all = fields(setup.model);
    const GenomeLaw& law = setup.law;
    for (const auto& [name, value] : Fields{{"series", std::to_string(law.series)},
                                            {"ridges", std::to_string(law.ridges)},
                                            {"H_from", field_text(law.H_from)},
                                            {"H_to", field_text(law.H_to)},
                                            {"gamma_from", field_text(law.gamma_from)},
                                            {"gamma_to", field_text(law.gamma_to)},
                                            {"lambda_mm", field_text(law.lambda)},
                                            {"shortest_wave_mm", field_text(law.shortest)},
                                            {"seed", std::to_string(law.seed)}})
        all.emplace_back(name, value);
    return all;
}

DatabaseSetup setup_from(const Fields& fields, const std::string& where) {
    const Reader read(fields, where);
    DatabaseSetup setup;
    Model& model = setup.model;
    model.body.kernel = kernel_named(read.text("kernel"), where + ": kernel");
    model.grid.wraps = model.body.kernel == Kernel::periodic;
    read("nodes", model.grid.nodes);
    read("length_mm", model.grid.length);
    read("effective_modulus_MPa", model.body.effective_modulus);
    read("steps", model.loading.steps);
    read("reach", model.loading.reach);
    if (model.body.kernel == Kernel::free)
        read("datum_mm", model.body.datum);
    if (model.body.kernel == Kernel::strip)
        read("strip_width_mm", model.body.strip_width);
    GenomeLaw& law = setup.law;
    read("series", law.series);
    read("ridges", law.ridges);
    read("H_from", law.H_from);
    read("H_to", law.H_to);
    read("gamma_from", law.gamma_from);
    read("gamma_to", law.gamma_to);
    read("lambda_mm", law.lambda);
    read("shortest_wave_mm", law.shortest);
    read("seed", law.seed);
    const bool sound = model.grid.nodes >= 2 && model.grid.nodes <= 10'000'000 && model.grid.length > 0 &&
                       std::isfinite(model.grid.length) && model.body.effective_modulus > 0 &&
                       std::isfinite(model.body.effective_modulus) && model.loading.steps >= 1 &&
                       model.loading.steps <= 1'000'000 && model.loading.reach > 0 &&
                       model.loading.reach <= 1;
    if (!sound)
        throw InputError(where + ": a set-up that no contact can have, expected a genome database");
    return setup;
}

std::string difference(const Fields& there, const Fields& wanted) {
    for (const auto& [name, value] : wanted) {
        const std::string* own = find(there, name);
        if (!own || *own != value)
            return name + " is " + (own ? *own : "not set") + ", not " + value;
    }
    return "";
}

} // namespace rough
