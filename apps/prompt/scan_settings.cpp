#include "apps/prompt/scan_settings.hpp"

#include "domain/scan/unit.hpp"

namespace app {

std::vector<Setting> scan_settings(const std::string& prefix) {
    std::vector<Setting> settings{
        {prefix + "unit", "", "unit of a scan's columns whose header names none, e.g. nm, um, mm [mm]"},
        {prefix + "spacing", "", "distance of the points of a scan with one column, in that unit"},
        {prefix + "row", "", "row of an areal matrix (text) to take, 1 the first; its spacing by --spacing"},
        {prefix + "detrend", "line", "taken off a scan's heights: none, mean, line or parabola"},
        {prefix + "fill", "", "replace a scan's missing heights by linear interpolation", true},
    };
    for (Setting& setting : settings)
        setting.group = "How a scan is read";
    return settings;
}

rough::Source scan_from(const std::filesystem::path& file, const Settings& settings, rough::Index nodes,
                        const std::string& prefix) {
    rough::ScanOptions options;
    options.unit = settings.text(prefix + "unit");
    if (!options.unit.empty())
        rough::length_unit_named(options.unit, settings.place(prefix + "unit"));
    if (settings.has(prefix + "spacing"))
        options.spacing = settings.positive(prefix + "spacing");
    if (settings.has(prefix + "row"))
        options.row = settings.whole(prefix + "row", 1, 10000000);
    options.detrend =
        rough::detrend_named(settings.text(prefix + "detrend"), settings.place(prefix + "detrend"));
    options.fill = settings.is_on(prefix + "fill");
    options.nodes = nodes;
    return placing(settings, prefix, [&] { return rough::open_scan(file, options); });
}

rough::Source source_from(const Settings& settings, rough::Index nodes, const std::string& scan) {
    if (!settings.has("genome"))
        return scan_from(settings.text(scan), settings, nodes);
    expect_none(settings, scan_settings(), "given with a genome, expected with --" + scan + " only");
    return rough::open_genome(settings.text("genome"));
}

} // namespace app
