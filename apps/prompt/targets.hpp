#pragma once

#include "apps/prompt/settings.hpp"
#include "domain/target/target.hpp"

namespace app {

/// --resistivity and --conductivity for conductance targets, --shear-strength for friction.
std::vector<Setting> scale_settings();
/// The factors of a target's columns for a model, from scale_settings().
rough::TargetScales scales_from(const Settings& settings, const rough::Model& model);

/// Reads a target file for a model, with scales_from(). Throws rough::InputError if the file
/// cannot be read, or if the model that it records differs.
rough::Target target_from(const Settings& settings, const std::string& file, const rough::Model& model);

/// One line for each given flag without effect: for another kernel, or for other targets than these from files. One
/// line for each target that holds for another datum or length than it records (rough::carried_over).
std::vector<std::string> notes_on(const Settings& settings, const rough::Model& model,
                                  const std::vector<rough::Target>& targets = {});

/// The function that a formula describes. It has numbers, `x` (or `name`), + - * / ^, parentheses and pi. The
/// functions are those of muParser, such as sqrt, exp, log (natural), log10, sin, tanh, abs, min and max.
/// Throws rough::InputError that begins with `where` and names the column that it cannot read.
std::function<double(double)> formula(const std::string& text, const std::string& name, const std::string& where);

} // namespace app
