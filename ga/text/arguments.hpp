#pragma once

#include "ga/pipeline/parameters.hpp"
#include "ga/text/nearest.hpp"
#include "ga/text/syntax.hpp"

#include <map>

namespace ga {

/// The arguments of an operator, each checked against its parameter.
class Arguments {
  public:
    /// Assigns a stage's arguments to parameters: KEY=VALUE by name, arguments without a key in the order of
    /// the parameters.
    /// @param stage  name of the stage in messages
    /// @param where  name of the text in messages
    [[gnu::cold]] Arguments(const std::vector<Parameter>& parameters, const std::vector<ArgumentText>& given,
                            const std::string& stage, std::size_t column, std::string where)
        : where_(std::move(where)) {
        for (const auto& argument : given) {
            const auto parameter =
                argument.key.empty() ? next_free(parameters) : named(parameters, argument.key);
            if (parameter == parameters.end())
                throw TextError(where_, argument.column,
                                argument.key.empty() ? "stage '" + stage + "' has no place for '" +
                                                           argument.value + "'; remove it"
                                                     : "stage '" + stage + "' has no '" + argument.key + "'" +
                                                           suggestion(argument.key, names(parameters)));
            if (values_.count(parameter->name) && parameter->kind != Parameter::Kind::words)
                throw TextError(where_, argument.column,
                                "'" + parameter->name + "' is given twice; give it once");
            check(*parameter, argument, stage);
            values_[parameter->name].push_back(argument);
        }
        for (const auto& parameter : parameters) {
            if (values_.count(parameter.name))
                continue;
            if (!parameter.standard)
                throw TextError(where_, column,
                                "stage '" + stage + "' lacks '" + parameter.name + "'; give " +
                                    parameter.expected());
            if (!parameter.standard->empty())
                values_[parameter.name] = {{"", *parameter.standard, column}};
        }
    }

    /// Whether a parameter was given or has a default.
    bool has(const std::string& name) const { return values_.count(name) > 0; }
    /// The value of a number, which is in the parameter's range.
    double number(const std::string& name) const { return *parsed(word(name)); }
    /// The value of a whole number that is at least 0.
    std::size_t count(const std::string& name) const { return static_cast<std::size_t>(number(name)); }
    /// The value of a word.
    const std::string& word(const std::string& name) const { return values_.at(name).front().value; }
    /// All words of a parameter that takes several.
    std::vector<std::string> words(const std::string& name) const {
        std::vector<std::string> words;
        for (const auto& argument : values_.at(name))
            words.push_back(argument.value);
        return words;
    }
    /// Assigns the values to an object with these parameters and validates it.
    template <class T>
    [[gnu::cold]] void fill(T& described) const {
        put(fields_of(described));
        if constexpr (requires { described.validate(); })
            described.validate();
    }
    /// Throws the error for the value of a parameter, with its column.
    [[noreturn]] void refuse(const std::string& name, const std::string& message) const {
        throw TextError(where_, values_.at(name).front().column, message);
    }

    /// The text as a number; none if it is not entirely a number.
    static std::optional<double> parsed(const std::string& text) {
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size())
            return std::nullopt;
        return value;
    }

  private:
    [[gnu::cold]] void put(const std::vector<Field>& fields) const {
        for (const Field& field : fields)
            if (has(field.parameter.name))
                std::visit(
                    [&](auto* at) {
                        using Value = std::remove_cvref_t<decltype(*at)>;
                        if constexpr (std::is_same_v<Value, std::string>)
                            *at = word(field.parameter.name);
                        else if constexpr (std::is_same_v<Value, std::vector<std::string>>)
                            *at = words(field.parameter.name);
                        else
                            *at = static_cast<Value>(number(field.parameter.name));
                    },
                    field.value);
    }

    using Parameters = std::vector<Parameter>;

    Parameters::const_iterator named(const Parameters& parameters, const std::string& name) const {
        return std::find_if(parameters.begin(), parameters.end(),
                            [&](const auto& each) { return each.name == name; });
    }
    Parameters::const_iterator next_free(const Parameters& parameters) const {
        return std::find_if(parameters.begin(), parameters.end(), [&](const auto& each) {
            return each.kind == Parameter::Kind::words || values_.count(each.name) == 0;
        });
    }
    static std::vector<std::string> names(const Parameters& parameters) {
        std::vector<std::string> names;
        for (const auto& each : parameters)
            names.push_back(each.name);
        return names;
    }
    [[gnu::cold]] void check(const Parameter& parameter, const ArgumentText& argument,
                             const std::string& stage) const {
        if (parameter.is_text())
            return;
        const std::optional<double> value = parsed(argument.value);
        const bool fits = value && parameter.allows(*value);
        if (!fits)
            throw TextError(where_, argument.column,
                            "stage '" + stage + "': " + parameter.name + " is '" + argument.value +
                                "'; give " + parameter.expected(value && *value > parameter.upper));
    }

    std::string where_;
    std::map<std::string, std::vector<ArgumentText>> values_;
};

} // namespace ga
