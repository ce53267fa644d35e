#include "apps/commands.hpp"
#include "apps/model_settings.hpp"
#include "apps/table.hpp"
#include "domain/atomic_file.hpp"
#include "domain/contact/solve.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/genome_json.hpp"

namespace app {

namespace {

std::vector<Setting> contact_settings() {
    std::vector<Setting> settings{
        {"genome", "", "genome file (JSON) of the profile"},
        {"profile", "", "measured profile in place of a genome: a text file of one or two columns"},
        {"unit", "", "unit of a scan's columns whose header names none: nm, um, mm or m [mm]"},
        {"out", "", "curve file to write (CSV)"},
    };
    for (auto& setting : model_settings())
        settings.push_back(setting);
    return settings;
}

} // namespace

int contact(const Words& words) {
    if (shows_help(words, "contact (--genome G.json | --profile SCAN.txt [--unit U]) --out CURVE.csv [flags]",
                   "Presses a rough profile on an elastic body, load step by load step, and writes "
                   "displacement, mean\n"
                   "pressure, contact fraction and tangent stiffness, each step with its KKT residual.",
                   contact_settings(),
                   {"contact --genome surface.json --out curve.csv",
                    "contact --genome surface.json --kernel periodic --steps 50 --out curve.csv",
                    "contact --profile scan.txt --unit um --modulus 210000 --poisson 0.3 --out curve.csv"}))
        return 0;
    const Settings settings = read_command_line(words, contact_settings());
    if (settings.has("genome") == settings.has("profile"))
        throw rough::InputError("contact: expected either --genome or --profile");
    if (!settings.has("out"))
        throw rough::InputError("contact: --out is missing, expected the curve file to write");

    const rough::Model model = model_from(settings);
    const rough::Genome genome = rough::read_genome(settings.text("genome"));
    const rough::Response response = rough::respond(genome, model);
    rough::write_atomically(settings.text("out"),
                            csv({"displacement_mm", "pressure_MPa", "contact_fraction",
                                 "tangent_stiffness_MPa_per_mm", "kkt_residual"},
                                {response.displacement, response.pressure, response.contact_fraction,
                                 response.tangent_stiffness, response.kkt_residual}));
    return 0;
}

} // namespace app
