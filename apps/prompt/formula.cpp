#include "apps/prompt/goals.hpp"

#include <charconv>
#include <cmath>

namespace app {

namespace {

using Function = std::function<double(double)>;

/// Recursive descent: sum := product {(+|-) product}; product := power {(*|/) power}; power := {-|+} atom [^
/// power].
class Reader {
  public:
    Reader(const std::string& text, std::string name, std::string where)
        : text_(text), name_(std::move(name)), where_(std::move(where)) {
        if (text_.size() > longest)
            rough::refuse(where_, ": a formula of ", text_.size(), " characters is too long; use at most ",
                          longest);
    }

    Function whole() {
        Function result = sum();
        if (next() != '\0')
            refuse("an operator or the end");
        return result;
    }

  private:
    /// Operands of `next_level` with one of two signs between, from the left.
    Function chain(const char* signs, Function (Reader::*next_level)()) {
        Function left = (this->*next_level)();
        while (next() == signs[0] || next() == signs[1]) {
            const char sign = text_[at_++];
            left = [a = std::move(left), b = (this->*next_level)(), sign](double x) {
                const double y = b(x);
                return sign == '+' ? a(x) + y : sign == '-' ? a(x) - y : sign == '*' ? a(x) * y : a(x) / y;
            };
        }
        return left;
    }
    Function sum() { return chain("+-", &Reader::product); }
    Function product() { return chain("*/", &Reader::power); }

    Function power() {
        if (++depth_ > deepest)
            rough::refuse(where_, ": column ", at_ + 1, ": parentheses, signs or powers more than ", deepest,
                          " deep; nest fewer");
        Function result;
        if (next() == '-' || next() == '+') {
            const double sign = text_[at_++] == '-' ? -1 : 1;
            result = [a = power(), sign](double x) { return sign * a(x); };
        } else if (result = atom(); next() == '^') {
            ++at_;
            result = [base = result, exponent = power()](double x) { return std::pow(base(x), exponent(x)); };
        }
        --depth_;
        return result;
    }

    Function atom() {
        const char c = next();
        if (c == '(') {
            ++at_;
            const Function inside = sum();
            expect(')');
            return inside;
        }
        if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') {
            double value = 0;
            const auto [stop, error] =
                std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
            if (error != std::errc())
                refuse("a number");
            at_ = static_cast<std::size_t>(stop - text_.data());
            return [value](double) { return value; };
        }
        if (std::isalpha(static_cast<unsigned char>(c)))
            return word();
        refuse("a number, " + name_ + ", a function or a parenthesis");
    }

    Function word() {
        const std::size_t begin = at_;
        while (at_ < text_.size() &&
               (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_'))
            ++at_;
        const std::string word = text_.substr(begin, at_ - begin);
        if (word == "x" || word == name_)
            return [](double x) { return x; };
        if (word == "pi")
            return [](double) { return std::acos(-1.0); };
        static const std::map<std::string, double (*)(double)> one{
            {"sqrt", std::sqrt}, {"exp", std::exp}, {"log", std::log},   {"log10", std::log10},
            {"sin", std::sin},   {"cos", std::cos}, {"tanh", std::tanh}, {"abs", std::fabs}};
        const bool two = word == "min" || word == "max";
        const auto found = one.find(word);
        if (found == one.end() && !two) {
            at_ = begin;
            refuse(name_ + " or one of sqrt, exp, log, log10, sin, cos, tanh, abs, min, max");
        }
        expect('(');
        const Function a = sum();
        if (two) {
            expect(',');
            const Function b = sum();
            expect(')');
            return [a, b, least = word == "min"](double x) {
                return least ? std::min(a(x), b(x)) : std::max(a(x), b(x));
            };
        }
        expect(')');
        return [a, f = found->second](double x) { return f(a(x)); };
    }

    /// The next character that is not blank; '\0' at the end.
    char next() {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])))
            ++at_;
        return at_ < text_.size() ? text_[at_] : '\0';
    }
    void expect(char c) {
        if (next() != c)
            refuse(std::string("'") + c + "'");
        ++at_;
    }
    [[noreturn]] void refuse(const std::string& permitted) const {
        rough::refuse(where_, ": \"", text_, "\", column ", at_ + 1, " is malformed; give ", permitted);
    }

    static constexpr std::size_t longest = 10000;
    static constexpr int deepest = 100;
    std::string text_, name_, where_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

} // namespace

std::function<double(double)> formula(const std::string& text, const std::string& name,
                                      const std::string& where) {
    return Reader(text, name, where).whole();
}

} // namespace app
