#include "apps/prompt/goals.hpp"

#include <cmath>
#include <muParser.h>

namespace app {

std::function<double(double)> formula(const std::string& text, const std::string& name,
                                      const std::string& where) {
    const auto refuse = [&](std::size_t at) {
        rough::refuse(where, ": \"", text.substr(0, 200), "\", column ", std::min(at, text.size()) + 1,
                      " is malformed; give numbers, ", name,
                      ", + - * / ^, parentheses, pi, sqrt(), exp(), log() (natural), log10(), sin(), cos(), "
                      "tanh(), abs(), min(a,b) or max(a,b)");
    };
    // muParser also reads assignments, comparisons, conditions and strings.
    constexpr const char* permitted =
        "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_.,()+-*/^ \t\n\r\v\f";
    if (const std::size_t other = text.find_first_not_of(permitted); other != std::string::npos)
        refuse(other);
    struct Parser : mu::Parser {
        double x = 0;
    };
    const auto parser = std::make_shared<Parser>();
    try {
        parser->EnableOptimizer(false); // it changes the last bits of powers
        parser->DefineConst("pi", std::acos(-1.0));
        parser->DefineVar("x", &parser->x);
        parser->DefineVar(name, &parser->x);
        parser->SetExpr(text);
        parser->Eval();
    } catch (const mu::ParserError& error) {
        refuse(static_cast<std::size_t>(std::max(error.GetPos(), 0)));
    }
    if (parser->GetNumResults() > 1)
        refuse(text.find(','));
    return [parser](double x) {
        parser->x = x;
        return parser->Eval();
    };
}

} // namespace app
