#include "apps/commands/commands.hpp"
#include "apps/prompt/terminal.hpp"
#include "apps/report/render.hpp"
#include "domain/text/atomic_file.hpp"

namespace app {

namespace {

int report(const Settings& given, const std::string&) {
    if (!given.has("folder"))
        rough::refuse("report: no folder given; name the folder of a result");
    const PageSource source = page_source(given.text("folder"));
    const std::filesystem::path page =
        given.has("out") ? std::filesystem::path(given.text("out")) : page_of(source);
    rough::write_atomically(page, render(source, {.templates = given.text("templates")}));
    tell(page.string());
    return 0;
}

} // namespace

Command report_command() {
    return {
        "report",
        {{"folder", "", "the folder of a result, or CURVE.json of a contact (may be given without the flag)"},
         {"templates", "",
          "folder of templates (.mustache) and figures (.gp) used instead of the built-in ones"},
         {"out", "",
          "the page to write [report.html, or chart.html and stability.html, in the folder; CURVE.html]"}},
        report,
        {"folder"}};
}

} // namespace app
