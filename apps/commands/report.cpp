#include "apps/commands/commands.hpp"
#include "apps/prompt/terminal.hpp"
#include "apps/report/output.hpp"
#include "apps/report/render.hpp"
#include "domain/text/atomic_file.hpp"

namespace app {
namespace {

/// The page that --out names, which is not a file that the page is made from.
std::filesystem::path expect_page(const std::filesystem::path& page, const PageSource& source, const Settings& given) {
    std::error_code none;
    const bool is_beside = std::filesystem::equivalent(page.has_parent_path() ? page.parent_path() : ".",
                                                       source.folder.empty() ? "." : source.folder, none);
    if (is_beside && (page.extension() == ".json" || page.extension() == ".csv"))
        rough::refuse("--out: ", page.string(), " is a result and would be overwritten; choose another name");
    return expect_writable(page, given);
}

int report(const Settings& given, const std::string&) {
    if (!given.has("folder")) rough::refuse("report: no folder given; name the folder of a result");
    const PageSource source = page_source(given.text("folder"));
    const std::filesystem::path page =
        given.has("out") ? expect_page(given.text("out"), source, given) : page_of(source);
    std::set<std::string> missing;
    rough::write_atomically(page, render(source, {.templates = given.text("templates"), .missing = &missing}));
    for (const std::string& tag : missing) say("note: the result has no value for the tag " + tag);
    tell(page.string());
    return 0;
}

} // namespace

Command report_command() {
    return {
        "report",
        {{"folder", "", "the folder of a result, or CURVE.json of a contact (may be given without the flag)"},
         {"templates", "", "folder of templates (.mustache) and figures (.gp) used instead of the built-in ones"},
         {"out", "", "the page to write [report.html, or chart.html and stability.html, in the folder; CURVE.html]"},
         force_setting()},
        report,
        {"folder"}};
}

} // namespace app
