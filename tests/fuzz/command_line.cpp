#include "apps/commands/design/run.hpp"
#include "apps/prompt/model_settings.hpp"
#include "tests/fuzz/reader.hpp"

/// One word per line.
FUZZ(command_line) {
    std::vector<std::string> words;
    std::istringstream lines{std::string(bytes)};
    for (std::string word; std::getline(lines, word);) words.push_back(word);
    const app::Settings settings = app::read_command_line(words, app::design_settings());
    settings.whole<std::uint64_t>("seed");
    settings.whole<int>("threads");
    settings.is_on("force");
    app::model_from(settings);
}
