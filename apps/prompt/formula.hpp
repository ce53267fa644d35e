#pragma once

#include <functional>
#include <string>

namespace app {

/// A function of one variable written as arithmetic: numbers, `x` (and `name`, which stands for it too), the
/// signs + - * / ^, parentheses, and sqrt, exp, log, log10, sin, cos, tanh, abs, min(a,b), max(a,b). Throws
/// rough::InputError that begins with `where` and names the column of what it cannot read.
std::function<double(double)> formula(const std::string& text, const std::string& name,
                                      const std::string& where);

} // namespace app
