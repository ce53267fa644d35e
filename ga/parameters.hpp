#pragma once

#include "ga/errors.hpp"
#include "ga/number.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace ga {

/// A parameter's limit where it has none.
constexpr double no_limit = std::numeric_limits<double>::infinity();
/// The lower limit of a parameter that must be greater than 0.
constexpr double above_zero = std::numeric_limits<double>::min();

/// One parameter of an operator: its name, kind, default, range and meaning.
struct Parameter {
    /// A real number, a whole one, a word, or all the words that are left.
    enum class Kind { number, whole, word, words };

    static constexpr double most = 1e9; ///< of a whole number

    std::string name;                    ///< as in KEY=VALUE
    Kind kind;                           ///< what may be given
    std::optional<std::string> standard; ///< the default; none where it must be given, empty for "not at all"
    double lower = -std::numeric_limits<double>::infinity(); ///< least number, included
    double upper = std::numeric_limits<double>::infinity();  ///< greatest number, included
    std::string meaning = {};                                ///< one line for the listing
    bool is_keyed = false;                                   ///< written KEY=VALUE in a stage's own text
    bool is_quiet = false;                                   ///< left out of it where it has its default

    /// The same, written KEY=VALUE.
    Parameter keyed() const {
        Parameter copy = *this;
        copy.is_keyed = true;
        return copy;
    }
    /// The same, left out of a stage's text where it has its default.
    Parameter quiet() const {
        Parameter copy = *this;
        copy.is_quiet = true;
        return copy;
    }
    /// The same, at most so much.
    Parameter up_to(double greatest) const {
        Parameter copy = *this;
        copy.upper = greatest;
        return copy;
    }

    bool is_text() const { return kind == Kind::word || kind == Kind::words; } ///< not a number
    /// Whether a number is one that may be given.
    bool allows(double value) const {
        return std::isfinite(value) && value >= lower && value <= upper &&
               (kind == Kind::number || value == std::floor(value));
    }
    /// What may be given, in words; `in_full` with the greatest whole number, which hardly anybody needs.
    std::string expected(bool in_full = false) const {
        if (is_text())
            return kind == Kind::word ? "a name" : "names";
        const std::string what = kind == Kind::whole ? "a whole number" : "a number";
        const std::string from = lower == above_zero ? " above 0"
                                 : lower > -no_limit ? " from " + ga::number(lower)
                                                     : "";
        const bool limited = upper < (kind == Kind::whole && !in_full ? most : no_limit);
        if (!limited)
            return what + from;
        return what + from + " to " +
               (kind == Kind::whole ? std::to_string(static_cast<long>(upper)) : ga::number(upper));
    }
};

/// A parameter that takes a real number in [lower, upper].
inline Parameter number(std::string name, std::optional<std::string> standard, double lower, double upper,
                        std::string meaning) {
    return {std::move(name), Parameter::Kind::number, std::move(standard), lower, upper, std::move(meaning)};
}
/// A parameter that takes a whole number from `lower` on.
inline Parameter whole(std::string name, std::optional<std::string> standard, double lower,
                       std::string meaning) {
    return {std::move(name), Parameter::Kind::whole, std::move(standard),
            lower,           Parameter::most,        std::move(meaning)};
}
/// A parameter that takes a word.
inline Parameter word(std::string name, std::optional<std::string> standard, std::string meaning) {
    Parameter parameter{std::move(name), Parameter::Kind::word, std::move(standard)};
    parameter.meaning = std::move(meaning);
    return parameter;
}
/// A parameter that takes all the words that are left.
inline Parameter word_list(std::string name, std::string meaning) {
    Parameter parameter{std::move(name), Parameter::Kind::words, std::nullopt};
    parameter.meaning = std::move(meaning);
    return parameter;
}

/// What an operator is called and what it does, for text and listing.
struct Words {
    std::string name;    ///< one word, or two: "cross sbx" is a member of the family "cross"
    std::string group;   ///< heading in the listing
    std::string meaning; ///< one line
};

/// An operator says once what its parameters are, by
///     static Words words();
///     static void describe(auto& self, auto visit) { visit(self.k, whole("k", "2", 1, "how many are drawn")); ... }
/// Its text, its checks, its reading from text and its place in the listing follow.
template <class T>
concept Described = requires {
    { T::words() } -> std::same_as<Words>;
};

///@{
/// A parameter's value as text.
inline std::string in_words(const std::string& value) { return value; }
inline std::string in_words(const std::vector<std::string>& values) {
    std::string text;
    for (const auto& value : values)
        text += (text.empty() ? "" : " ") + value;
    return text;
}
template <class Number>
requires std::is_arithmetic_v<Number> std::string in_words(Number value) {
    if constexpr (std::is_integral_v<Number>)
        return std::to_string(value);
    else
        return number(value);
}
///@}

/// The values of what describes itself, as text gives them behind its name.
template <class T>
std::string values_in_words(const T& described) {
    std::string text;
    T::describe(described, [&](const auto& value, const Parameter& parameter) {
        const std::string words = in_words(value);
        if (words.empty() || (parameter.is_quiet && parameter.standard == words))
            return;
        text += (text.empty() ? "" : " ") + (parameter.is_keyed ? parameter.name + "=" : "") + words;
    });
    return text;
}
/// What describes itself as a pipeline writes it: "tournament 2 size=5".
template <Described T>
std::string text_of(const T& described) {
    const std::string values = values_in_words(described);
    return T::words().name + (values.empty() ? "" : " ") + values;
}
/// The parameters of what describes itself.
template <class T>
std::vector<Parameter> parameters_of() {
    std::vector<Parameter> parameters;
    const T standard{};
    T::describe(standard, [&](const auto&, const Parameter& parameter) { parameters.push_back(parameter); });
    return parameters;
}
/// Throws UsageError where a value is none that its parameter allows.
template <class T>
void check_values(const T& described, const std::string& name) {
    T::describe(described, [&](const auto& value, const Parameter& parameter) {
        if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(value)>>)
            if (const auto given = static_cast<double>(value); !parameter.allows(given))
                throw UsageError("stage '" + name + "': " + parameter.name + " is '" + in_words(value) +
                                 "'; expected " + parameter.expected(given > parameter.upper));
    });
}
/// What describes itself, once its values are checked.
template <Described T>
T checked(T described) {
    check_values(described, T::words().name);
    return described;
}

} // namespace ga
