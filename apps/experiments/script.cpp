#include "apps/experiments/experiment.hpp"
#include "apps/external/process.hpp"
#include "apps/report/render.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/json.hpp"
#include "ga/base/held_folder.hpp"

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <sys/wait.h>

namespace app {
namespace {

/// Where Python looks for modules: a folder, then the absolute folders of PYTHONPATH. An empty or a relative
/// one there would be found from the current folder, whose files must not run.
std::string module_path(const std::filesystem::path& folder) {
    std::string path = folder.string();
    const char* const before = std::getenv("PYTHONPATH");
    std::istringstream folders(before ? before : "");
    for (std::string one; std::getline(folders, one, ':');)
        if (one.starts_with('/')) path += ":" + one;
    return path;
}

} // namespace

Findings findings_of_script(const Settings& settings, const RunConditions& conditions) {
    using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
    const std::string& kind = conditions.origin.kind;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
    nlohmann::json given{{"folder", std::filesystem::absolute(ga::held_path(conditions.folder / "")).string()},
                         {"program", program.string()},
                         {"seed", conditions.origin.seed},
                         {"threads", conditions.origin.threads},
                         {"resume", conditions.resume},
                         {"origin", origin_json(conditions.origin)}};
    for (const Setting& one : experiment_named(kind).settings) given["settings"][one.name] = settings.text(one.name);
    if (settings.knows("targets.files")) {
        for (const auto& file : settings.paths("targets.files"))
            given["targets"].push_back(std::filesystem::absolute(file).string());
        if (!given.contains("targets")) settings.refuse("targets.files", "none given; name target files (CSV)");
    }
    setenv("PYTHONPATH", module_path(program.parent_path() / "python").c_str(), 1);
    const File nothing(std::fopen("/dev/null", "r+"), std::fclose), errors(std::tmpfile(), std::fclose),
        input(std::tmpfile(), std::fclose); // an argument has a limit of 128 KB
    if (!nothing || !errors || !input || std::fputs(rough::json_text(given, true).c_str(), input.get()) < 0 ||
        std::fflush(input.get()) != 0 || std::fseek(input.get(), 0, SEEK_SET) != 0)
        rough::refuse(kind, ": a temporary file cannot be written; make room in the temporary folder");
    pid_t child = 0;
    if (const int error = start_process(child, {"python3", "-P", "-c", builtin_files().at(kind + ".py")},
                                        fileno(input.get()), fileno(nothing.get()), fileno(errors.get())))
        rough::refuse(kind, ": python3 cannot be started (", std::strerror(error),
                      "); install the Debian package python3");
    conditions.progress.show(kind + ".py");
    int status = 0;
    while (!process_ended_within(0.2, child, status))
        if (conditions.stop) end_group(child, SIGTERM);
    if (!conditions.stop && (!WIFEXITED(status) || WEXITSTATUS(status) != 0)) {
        const std::string problem =
            last_line(rough::read_whole("/proc/self/fd/" + std::to_string(fileno(errors.get()))));
        rough::refuse(kind, ": ", problem,
                      problem.find("No module") == std::string::npos
                          ? ""
                          : "; install python3, numpy and the Python module rugosa");
    }
    const std::filesystem::path result = conditions.folder / "result.json";
    if (!std::filesystem::exists(result)) return {};
    nlohmann::json found = rough::parsed_json(rough::read_whole(result), result.string());
    return {.result = found, .summary = found.value("summary", "")};
}

} // namespace app
