#include "apps/prompt/targets.hpp"

#include <muParser.h>

namespace app {
namespace {

const std::map<std::string, std::string> flag_of{{"kernel", "kernel"},
                                                 {"length_mm", "length"},
                                                 {"width_mm", "length"},
                                                 {"effective_modulus_MPa", "modulus"},
                                                 {"layers", "layer"},
                                                 {"datum_mm", "datum"},
                                                 {"strip_width_mm", "strip-width"}};

/// Throws rough::InputError that names all differences, and the flags that remove them.
void expect_same_model(const rough::Target& target, const rough::Model& model) {
    const auto differences = recorded_differences(target, model);
    for (const auto& [key, recorded, actual] : differences)
        if ((key == "datum_mm" && model.grid.is_2d()) || (key == "width_mm" && !model.grid.is_2d()))
            rough::refuse(target.name, ": recorded with ", key, " ", recorded,
                          model.grid.is_2d() ? "; give a target of a map, which has none"
                                             : "; give a target of a profile, or --nodes and --length as pairs");
    std::string flags;
    for (const auto& [key, recorded, actual] : differences) {
        const auto length = target.recorded.find("length_mm");
        const bool is_length = length != target.recorded.end() && length->second == recorded;
        if (!(key == "datum_mm" && is_length)) // the datum is the length unless it is given
            flags += " --" + flag_of.at(key) + " " + recorded;
    }
    if (!differences.empty())
        rough::refuse(target.name, ": recorded with ", in_words(differences),
                      "; use the recorded model, as the target depends on it:", flags.empty() ? " no --datum" : flags);
}

} // namespace

std::vector<Setting> scale_settings() {
    return {positive("conductivity", "",
                     "thermal conductivities k1,k2 of the two bodies, W/(m K), for a target "
                     "conductance_W_per_m2K; one number: of both")
                .several(),
            positive("resistivity", "",
                     "resistivities rho1,rho2 of the two bodies, ohm m, for a target conductance_S_per_m2; one "
                     "number: rho1 + rho2")
                .several(),
            positive("shear-strength", "",
                     "shear strength sigma of the interface, MPa, for friction targets: friction = sigma A")};
}

rough::TargetScales scales_from(const Settings& settings, const rough::Model& model) {
    rough::TargetScales scales{.effective_modulus = model.body.effective_modulus};
    if (model.grid.is_2d()) scales.nominal_area = model.grid.nominal_area();
    const auto of_bodies = [&](const char* name) {
        const std::vector<double> values = settings.numbers(name);
        if (values.size() > 2) settings.refuse(name, values.size(), " given; give one for each of the two bodies");
        return values;
    };
    if (settings.has("resistivity")) {
        const auto rho = of_bodies("resistivity");
        scales.resistivity = rho.front() + (rho.size() > 1 ? rho.back() : 0);
    }
    if (settings.has("conductivity")) {
        const auto k = of_bodies("conductivity");
        scales.thermal_resistivity = 1 / k.front() + 1 / k.back();
    }
    settings.take("shear-strength", scales.shear_strength);
    return scales;
}

rough::Target target_from(const Settings& settings, const std::string& file, const rough::Model& model) {
    const rough::TargetScales scales = scales_from(settings, model);
    rough::Target target = placing(settings, "", [&] { return rough::read_target(file, scales); });
    expect_same_model(target, model);
    return target;
}

std::vector<std::string> notes_on(const Settings& settings, const rough::Model& model,
                                  const std::vector<rough::Target>& targets) {
    std::vector<std::string> notes;
    const auto note = [&](const char* flag, const std::string& why) {
        if (settings.given(flag)) notes.push_back("note: --" + std::string(flag) + " is without effect: " + why);
    };
    const std::string& kernel = settings.text("kernel");
    if (kernel != rough::name_of(rough::Kernel::strip)) note("strip-width", "the kernel is " + kernel);
    if (kernel != rough::name_of(rough::Kernel::free)) note("datum", "the kernel is " + kernel);
    const auto needs = [&](const char* column, const char* flag, const char* kind) {
        if (std::ranges::none_of(targets, [&](const rough::Target& target) { return columns_of(target).y == column; }))
            note(flag, "no target is " + std::string(kind));
    };
    needs("conductance_S_per_m2", "resistivity", "an electrical conductance");
    needs("conductance_W_per_m2K", "conductivity", "a thermal conductance");
    for (const rough::Target& target : targets)
        if (const auto carried = carried_over(target, model); !carried.empty())
            notes.push_back(
                "note: " + target.name + ": recorded with " + in_words(carried) +
                ": an interface's stiffness does not depend on the datum" +
                (carried.front().key == "length_mm" ? ", and on the length only weakly, at light loads" : ""));
    return notes;
}

std::function<double(double)> formula(const std::string& text, const std::string& name, const std::string& where) {
    constexpr std::size_t max_characters = 15'000; // muParser has a limit, too
    if (text.size() > max_characters)
        rough::refuse(where, ": a formula of ", text.size(), " characters; give at most ", max_characters);
    const auto refuse = [&](std::size_t at) {
        rough::refuse(where, ": \"", text.substr(0, 200), "\", column ", std::min(at, text.size()) + 1,
                      " is malformed; give numbers, ", name,
                      ", + - * / ^, parentheses, pi, sqrt(), exp(), log() (natural), log10(), sin(), cos(), "
                      "tanh(), abs(), min(a,b) or max(a,b)");
    };
    // muParser also reads assignments, comparisons, conditions and strings.
    constexpr const char* permitted =
        "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_.,()+-*/^ \t\n\r\v\f";
    if (const std::size_t other = text.find_first_not_of(permitted); other != std::string::npos) refuse(other);
    struct Parser : mu::Parser {
        double x = 0;
    };
    const auto parser = std::make_shared<Parser>();
    try {
        parser->EnableOptimizer(false); // it changes the last bits of powers
        parser->DefineConst("pi", std::acos(-1.0));
        parser->DefineVar("x", &parser->x);
        parser->DefineVar(name, &parser->x);
        parser->SetExpr(text);
        parser->Eval();
    } catch (const mu::ParserError& error) {
        refuse(static_cast<std::size_t>(std::max(error.GetPos(), 0)));
    }
    if (parser->GetNumResults() > 1) refuse(text.find(','));
    return [parser](double x) {
        parser->x = x;
        return parser->Eval();
    };
}

} // namespace app
