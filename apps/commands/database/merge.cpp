#include "apps/commands/database/parts.hpp"
#include "apps/prompt/settings.hpp"
#include "apps/prompt/verbosity.hpp"
#include "apps/report/output.hpp"
#include "domain/database/build.hpp"

#include <algorithm>

namespace app {

int database_merge(const Words& words) {
    const std::vector<Setting> known{{"out", "", "the file to write"},
                                     {"force", "", "write over an existing file", true}};
    if (shows_help(words, "database merge A.db B.db ... --out C.db",
                   "Puts files of one set-up and law, as built on several machines, into one. Genomes that "
                   "several of them hold are taken once. Every genome is checked against its law.",
                   known, {"database merge a.db b.db --out genomes.db"}))
        return 0;
    const auto flags = std::find_if(words.begin(), words.end(),
                                    [](const std::string& word) { return word.starts_with("--"); });
    const std::vector<std::filesystem::path> files(words.begin(), flags);
    const Settings settings = read_command_line({flags, words.end()}, known);
    if (files.size() < 2 || !settings.has("out"))
        throw rough::InputError("database merge: expected two genome databases at least, then --out and the "
                                "file to write");
    const auto out = expect_writable(settings.text("out"), settings);
    std::error_code none;
    for (const auto& file : files)
        if (std::filesystem::equivalent(file, out, none))
            throw rough::InputError("--out: " + out.string() +
                                    " would be written over, and is read here; expected another name");
    say(out.string() + ": " + std::to_string(rough::merge(files, out)) + " genomes of " +
        std::to_string(files.size()) + " files");
    return 0;
}

} // namespace app
