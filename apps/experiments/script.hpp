#pragma once

#include "apps/experiments/experiment.hpp"

namespace app {

/// Runs an experiment that is a Python script: experiments/KIND/KIND.py, built into the program. It gets the
/// settings as JSON, and writes result.json and tables to the folder. Throws rough::InputError with the last
/// line of its errors if it fails.
Findings findings_of_script(const Settings& settings, const RunConditions& conditions);

} // namespace app
