#pragma once

#include "apps/prompt/settings.hpp"
#include "domain/response/model.hpp"
#include "domain/target/target.hpp"

#include <functional>

namespace app {

///@{
/// --resistivity, of targets that are conductances, and --max-pressure, of Eq. 11.
Setting resistivity_setting();
Setting max_pressure_setting();
///@}

/// Reads a target file for a model; a conductance by --resistivity. Throws rough::InputError where the file
/// cannot be read, or where what it records of its model is not so.
rough::Target goal_from(const Settings& settings, const std::string& file, const rough::Model& model);

/// A line for each target over whose recorded datum or length it carries (rough::carried_over).
std::vector<std::string> carried_notes(const std::vector<rough::Target>& goals, const rough::Model& model);

/// A line for each flag that was given and decides nothing: of another kernel, or of targets that these are
/// not (`targets`, their files).
std::vector<std::string> without_effect(const Settings& settings,
                                        const std::vector<std::string>& targets = {});

/// The target files that a setting names, commas between: as given on the command line, or beside the .ini
/// that names them. Throws rough::InputError where there is none.
std::vector<std::filesystem::path> target_files(const Settings& settings, const std::string& name);

/// What they hold, each named as its file.
std::vector<rough::Target> named_targets(const Settings& settings, const std::string& name);

/// A function of one variable written as arithmetic: numbers, `x` (and `name`, which stands for it too), the
/// signs + - * / ^, parentheses, and sqrt, exp, log, log10, sin, cos, tanh, abs, min(a,b), max(a,b). Throws
/// rough::InputError that begins with `where` and names the column of what it cannot read.
std::function<double(double)> formula(const std::string& text, const std::string& name,
                                      const std::string& where);

} // namespace app
