#include "apps/prompt/scan_settings.hpp"

#include "domain/scan/unit.hpp"

#include <sstream>

namespace app {

std::vector<Setting> scan_settings(const std::string& prefix) {
    std::vector<Setting> settings{
        {prefix + "unit", "",
         "unit of a scan's columns whose header names none, e.g. um, or mm,um for x and heights [mm]"},
        {prefix + "spacing", "", "distance of the points of a scan with one column, in that unit"},
        {prefix + "row", "", "row of an areal map to take, 1 the first (of a text matrix with --spacing)"},
        {prefix + "detrend", "line",
         "form taken off a scan's heights: none, mean, line, parabola, cubic, quartic or arc"},
        {prefix + "outliers", "keep", "what is done to a scan's outliers: keep, or remove and interpolate"},
        {prefix + "lambda-s", "",
         "cut-off of the filter that takes off shorter waves (ISO 16610-21), mm [none]"},
        {prefix + "lambda-c", "",
         "cut-off of the filter that takes off longer waves (ISO 16610-21), mm [none]"},
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
    std::istringstream units(options.unit);
    for (std::string unit; std::getline(units, unit, ',');)
        rough::length_unit_named(unit, settings.place(prefix + "unit"));
    if (settings.has(prefix + "spacing"))
        options.spacing = settings.positive(prefix + "spacing");
    if (settings.has(prefix + "row"))
        options.row = settings.whole(prefix + "row", 1, 10000000);
    options.detrend =
        rough::detrend_named(settings.text(prefix + "detrend"), settings.place(prefix + "detrend"));
    options.remove_outliers = settings.one_of(prefix + "outliers", {"keep", "remove"}) == 1;
    if (settings.has(prefix + "lambda-s"))
        options.lambda_s = settings.positive(prefix + "lambda-s");
    if (settings.has(prefix + "lambda-c"))
        options.lambda_c = settings.positive(prefix + "lambda-c");
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
