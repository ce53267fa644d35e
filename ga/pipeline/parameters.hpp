#pragma once

#include "ga/base/errors.hpp"
#include "ga/base/number.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

namespace ga {

/// The limit of a parameter that may have any value: `upper` is no_limit, or `lower` is -no_limit.
constexpr double no_limit = std::numeric_limits<double>::infinity();
/// The lower limit of a parameter that must be greater than 0.
constexpr double above_zero = std::numeric_limits<double>::min();

/// One parameter of an operator: its name, kind, default, range and meaning.
struct Parameter {
    /// A real number, a whole number, a word, or all remaining words.
    enum class Kind { number, whole, word, words };

    static constexpr double max_whole = 1e9; ///< largest whole number

    std::string name;                    ///< name, the KEY in KEY=VALUE
    Kind kind;                           ///< kind of value
    std::optional<std::string> standard; ///< default; none if a value must be given, "" for an absent value
    std::string meaning;                 ///< meaning in one line, for the listing
    double lower = -no_limit;            ///< smallest allowed number
    double upper = no_limit;             ///< largest allowed number
    bool is_keyed = false;               ///< whether it is written as KEY=VALUE in a stage's text
    bool is_quiet = false;               ///< whether it is omitted from the text if it has its default
    bool is_of_operator = false;         ///< whether the default is the value that a new operator has

    /// A copy that is written as KEY=VALUE.
    Parameter keyed() const { return with(&Parameter::is_keyed, true); }
    /// A copy that is not written in a stage's text if it has its default.
    Parameter quiet() const { return with(&Parameter::is_quiet, true); }
    /// A copy whose default is the value that a new operator has.
    Parameter optional() const { return with(&Parameter::is_of_operator, true); }
    /// A copy with another upper limit.
    Parameter up_to(double limit) const { return with(&Parameter::upper, limit); }
    /// A copy with another value of one member.
    template <class Value>
    Parameter with(Value Parameter::*member, Value value) const {
        Parameter copy = *this;
        copy.*member = value;
        return copy;
    }

    bool is_text() const { return kind == Kind::word || kind == Kind::words; } ///< whether it takes words
    /// Whether a number is in the range, and a whole number if the kind is `whole`.
    bool allows(double value) const {
        return std::isfinite(value) && value >= lower && value <= upper &&
               (kind == Kind::number || value == std::floor(value));
    }
    /// The permitted values in words; `in_full` includes the largest whole number, which few users need.
    std::string expected(bool in_full = false) const;
};

///@{ A parameter that takes a real number in [lower, upper], a whole number from `lower` on, a word, or all
/// remaining words. Without `standard` the default is the value that a new operator has.
Parameter number(std::string name, std::optional<std::string> standard, double lower, double upper,
                 std::string meaning);
Parameter number(std::string name, double lower, double upper, std::string meaning);
Parameter whole(std::string name, std::optional<std::string> standard, double lower, std::string meaning);
Parameter whole(std::string name, double lower, std::string meaning);
Parameter word(std::string name, std::optional<std::string> standard, std::string meaning);
Parameter word(std::string name, std::string meaning);
Parameter word_list(std::string name, std::string meaning);
///@}

/// An operator's name and purpose, for text and listing.
struct Words {
    std::string name;    ///< name of one word, or of two: "cross sbx" is a member of the family "cross"
    std::string group;   ///< heading in the listing
    std::string meaning; ///< meaning in one line
};

/// An operator describes its parameters once:
/// @code
///     static Words words();
///     static void describe(auto& self, auto visit) { visit(self.k, whole("k", 1, "how many")); ... }
/// @endcode
/// The engine derives the operator's text, parser, value checks and listing entry from this description.
template <class T>
concept Described = requires {
    { T::words() } -> std::same_as<Words>;
};

/// Base of operators, rules and methods: by default they have no parameters.
struct NoParameters {
    static void describe(auto&, auto) {} ///< visits no parameter
};

/// One parameter and a pointer to its value in an operator.
struct BoundParameter {
    /// Pointer to the value.
    using Pointer = std::variant<double*, std::size_t*, long*, int*, std::string*, std::vector<std::string>*>;

    Parameter parameter; ///< name, kind and range of the value
    Pointer value;       ///< pointer to the value

    /// The value as text; may be empty.
    std::string in_words() const;
    /// The value if it is a number.
    std::optional<double> as_number() const;
};

/// The parameters of an object that describes itself, with pointers to its values.
template <class T>
[[gnu::cold]] std::vector<BoundParameter> bound_parameters(T& described) {
    std::vector<BoundParameter> fields;
    const auto add = [&](auto& value, Parameter parameter) {
        if (parameter.is_of_operator) parameter.standard = BoundParameter{{}, &value}.in_words();
        fields.push_back({std::move(parameter), &value});
    };
    T usual{};
    T::describe(usual, add);
    std::size_t i = 0;
    T::describe(described, [&](auto& value, const Parameter&) { fields[i++].value = &value; });
    return fields;
}
/// The values of these parameters, as they are written after the name in a pipeline's text.
std::string values_in_words(const std::vector<BoundParameter>& fields);
/// The text of an object that describes itself, as in a pipeline: "tournament 2 size=5".
template <Described T>
[[gnu::cold]] std::string text_of(T described) {
    const std::string values = values_in_words(bound_parameters(described));
    return T::words().name + (values.empty() ? "" : " ") + values;
}
/// The parameters of a type that describes itself.
template <class T>
[[gnu::cold]] std::vector<Parameter> parameters_of() {
    T usual{};
    std::vector<Parameter> parameters;
    for (BoundParameter& field : bound_parameters(usual)) parameters.push_back(std::move(field.parameter));
    return parameters;
}
/// Throws UsageError if a value of the stage called `name` is out of range.
void check_values(const std::vector<BoundParameter>& fields, const std::string& name);
/// Throws UsageError if a value of an object that describes itself is out of range, or as its validate() does.
template <class T>
[[gnu::cold]] void check_values(T described, const std::string& name) {
    check_values(bound_parameters(described), name);
    if constexpr (requires { described.validate(); }) described.validate();
}

} // namespace ga
