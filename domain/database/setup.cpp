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

/// Shows what a law is by name.
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

Fields fields(const DatabaseSetup& setup) {
    Fields all = fields(setup.model);
    visit_law(setup.law, [&](const char* name, auto value) {
        if constexpr (std::is_integral_v<decltype(value)>)
            all.emplace_back(name, std::to_string(value));
        else
            all.emplace_back(name, field_text(value));
    });
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
    visit_law(setup.law, read);
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
