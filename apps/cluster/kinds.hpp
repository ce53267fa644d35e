#pragma once

#include <functional>
#include <string>
#include <vector>

namespace app {

/// Does one task: from its bytes to those of the answer. Pure; called from several threads at once.
using Work = std::function<std::string(const std::string& task)>;

/// A kind of work that every rank knows how to do.
struct Kind {
    const char* name;
    Work (*under)(const std::string& setting); ///< what the tasks of an errand have in common
};

const std::vector<Kind>& kinds();

///@{
/// See evaluator.cpp, commands/database/on_ranks.cpp and experiments/compare/on_ranks.cpp.
Work outcomes_under(const std::string& setting);
Work slopes_under(const std::string& setting);
Work responses_under(const std::string& setting);
Work races_under(const std::string& setting);
///@}

} // namespace app
