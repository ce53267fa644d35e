#pragma once

#include "ga/base/errors.hpp"
#include "ga/base/number.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <variant>
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

    /// The same, with one part changed.
    template <class Part>
    Parameter with(Part Parameter::*part, Part value) const {
        Parameter copy = *this;
        copy.*part = value;
        return copy;
    }
    /// The same, written KEY=VALUE.
    Parameter keyed() const { return with(&Parameter::is_keyed, true); }
    /// The same, left out of a stage's text where it has its default.
    Parameter quiet() const { return with(&Parameter::is_quiet, true); }
    /// The same, at most so much.
    Parameter up_to(double greatest) const { return with(&Parameter::upper, greatest); }

    bool is_text() const { return kind == Kind::word || kind == Kind::words; } ///< not a number
    /// Whether a number is one that may be given.
    bool allows(double value) const {
        return std::isfinite(value) && value >= lower && value <= upper &&
               (kind == Kind::number || value == std::floor(value));
    }
    /// What may be given, in words; `in_full` with the greatest whole number, which hardly anybody needs.
    [[gnu::cold]] std::string expected(bool in_full = false) const {
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
[[gnu::cold]] inline Parameter number(std::string name, std::optional<std::string> standard, double lower,
                                      double upper, std::string meaning) {
    return {std::move(name), Parameter::Kind::number, std::move(standard), lower, upper, std::move(meaning)};
}
/// A parameter that takes a whole number from `lower` on.
[[gnu::cold]] inline Parameter whole(std::string name, std::optional<std::string> standard, double lower,
                                     std::string meaning) {
    return {std::move(name), Parameter::Kind::whole, std::move(standard),
            lower,           Parameter::most,        std::move(meaning)};
}
/// A parameter that takes a word.
[[gnu::cold]] inline Parameter word(std::string name, std::optional<std::string> standard,
                                    std::string meaning) {
    Parameter parameter{std::move(name), Parameter::Kind::word, std::move(standard)};
    parameter.meaning = std::move(meaning);
    return parameter;
}
/// A parameter that takes all the words that are left.
[[gnu::cold]] inline Parameter word_list(std::string name, std::string meaning) {
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
///     static void describe(auto& self, auto visit) { visit(self.k, whole("k", "2", 1, "how many are
///     drawn")); ... }
/// Its text, its checks, its reading from text and its place in the listing follow.
template <class T>
concept Described = requires {
    { T::words() } -> std::same_as<Words>;
};

/// One parameter with the place of its value in an operator.
struct Field {
    /// Where the value is.
    using Place = std::variant<double*, std::size_t*, long*, int*, std::string*, std::vector<std::string>*>;

    Parameter parameter; ///< what may be given
    Place value;         ///< what is

    /// The value as text; empty where it is none.
    [[gnu::cold]] std::string in_words() const {
        return std::visit(
            [](const auto* at) -> std::string {
                using Value = std::remove_cvref_t<decltype(*at)>;
                if constexpr (std::is_same_v<Value, double>)
                    return number(*at);
                else if constexpr (std::is_arithmetic_v<Value>)
                    return std::to_string(*at);
                else if constexpr (std::is_same_v<Value, std::string>)
                    return *at;
                else {
                    std::string text;
                    for (const auto& each : *at)
                        text += (text.empty() ? "" : " ") + each;
                    return text;
                }
            },
            value);
    }
    /// The value where it is a number.
    std::optional<double> as_number() const {
        return std::visit(
            [](const auto* at) -> std::optional<double> {
                if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(*at)>>)
                    return static_cast<double>(*at);
                else
                    return std::nullopt;
            },
            value);
    }
};

/// What `describe` shows the parameters to: it notes them with the places of their values.
struct FieldVisit {
    std::vector<Field>& fields; ///< to which they are added

    /// One parameter.
    template <class Value>
    void operator()(Value& value, Parameter parameter) const {
        fields.push_back({std::move(parameter), Field::Place(&value)});
    }
};

/// The parameters of what describes itself, with the places of its values.
template <class T>
[[gnu::cold]] std::vector<Field> fields_of(T& described) {
    std::vector<Field> fields;
    T::describe(described, FieldVisit{fields});
    return fields;
}

///@{
/// What the functions below do, once the type is known no more.
[[gnu::cold]] inline std::string values_in_words(const std::vector<Field>& fields) {
    std::string text;
    for (const Field& field : fields) {
        const std::string words = field.in_words();
        if (words.empty() || (field.parameter.is_quiet && field.parameter.standard == words))
            continue;
        text +=
            (text.empty() ? "" : " ") + (field.parameter.is_keyed ? field.parameter.name + "=" : "") + words;
    }
    return text;
}
[[gnu::cold]] inline void check_values(const std::vector<Field>& fields, const std::string& name) {
    for (const Field& field : fields)
        if (const auto given = field.as_number(); given && !field.parameter.allows(*given))
            throw UsageError("stage '" + name + "': " + field.parameter.name + " is '" + field.in_words() +
                             "'; expected " + field.parameter.expected(*given > field.parameter.upper));
}
[[gnu::cold]] inline std::string words_and_values(const Words& words, const std::vector<Field>& fields) {
    const std::string values = values_in_words(fields);
    return words.name + (values.empty() ? "" : " ") + values;
}
[[gnu::cold]] inline std::vector<Parameter> parameters_in(std::vector<Field> fields) {
    std::vector<Parameter> parameters;
    for (Field& field : fields)
        parameters.push_back(std::move(field.parameter));
    return parameters;
}
///@}

/// The values of what describes itself, as text gives them behind its name.
template <class T>
[[gnu::cold]] std::string values_in_words(T described) {
    return values_in_words(fields_of(described));
}
/// What describes itself as a pipeline writes it: "tournament 2 size=5".
template <Described T>
[[gnu::cold]] std::string text_of(T described) {
    return words_and_values(T::words(), fields_of(described));
}
/// The parameters of what describes itself.
template <class T>
[[gnu::cold]] std::vector<Parameter> parameters_of() {
    T standard{};
    return parameters_in(fields_of(standard));
}
/// Throws UsageError where a value is none that its parameter allows.
template <class T>
[[gnu::cold]] void check_values(T described, const std::string& name) {
    check_values(fields_of(described), name);
}

} // namespace ga
