#include "apps/commands.hpp"
#include "apps/model_settings.hpp"
#include "apps/output.hpp"
#include "apps/scan_settings.hpp"
#include "apps/table.hpp"
#include "apps/units.hpp"
#include "apps/voice.hpp"
#include "domain/atomic_file.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/genome_json.hpp"

namespace app {

namespace {

std::vector<Setting> contact_settings() {
    std::vector<Setting> settings{
        {"genome", "", "genome file (JSON) of the profile"},
        {"profile", "", "measured profile in place of a genome: a text file of one or two columns"},
        {"out", "", "curve file to write (CSV)"},
        {"force", "", "write over an existing curve file", true},
    };
    for (const auto& more : {scan_settings(), model_settings()})
        settings.insert(settings.end(), more.begin(), more.end());
    return settings;
}

rough::Response measured_response(const Settings& settings) {
    const long nodes = settings.has("nodes") ? settings.whole("nodes", 2, 10000000) : 0;
    const rough::Scan scan = scan_from(settings.text("profile"), settings, nodes);
    rough::Model model = model_from(settings, scan.profile);
    rough::Profile profile = scan.profile;
    profile.spacing = model.grid.spacing();
    rough::Response response = respond(profile, model.body, model.loading, model.contact);
    say(scan.account);
    return response;
}

rough::Response computed_response(const Settings& settings) {
    for (const auto& setting : scan_settings())
        if (settings.given(setting.name))
            throw rough::InputError("--" + setting.name +
                                    ": given with --genome, expected with --profile only");
    const rough::Model model = model_from(settings);
    return respond(rough::read_genome(settings.text("genome")), model);
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
    expect_writable(settings.text("out"), settings.is_on("force"));

    const rough::Response response =
        settings.has("genome") ? computed_response(settings) : measured_response(settings);
    rough::write_atomically(settings.text("out"),
                            csv({"displacement_mm", "pressure_MPa", "contact_fraction",
                                 "tangent_stiffness_MPa_per_mm", "kkt_residual"},
                                {response.displacement, response.pressure, response.contact_fraction,
                                 response.tangent_stiffness, response.kkt_residual}));
    tell(settings.text("out") + ": " + std::to_string(response.steps()) + " load steps by " +
         name_of(response.solver) + ", height range " + readable(response.range) +
         " mm, largest KKT residual " + readable(response.kkt_residual.maxCoeff()));
    return 0;
}

} // namespace app
