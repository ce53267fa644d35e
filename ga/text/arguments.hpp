#pragma once

#include "ga/pipeline/parameters.hpp"
#include "ga/text/nearest.hpp"

#include <map>

namespace ga {

/// One argument of a stage: VALUE, or KEY=VALUE.
struct ArgumentText {
    std::string key;        ///< empty if only a value was given
    std::string value;      ///< value as it was written
    std::size_t column = 0; ///< column in the text, from 1
};

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
            const auto parameter = std::ranges::find_if(parameters, [&](const Parameter& each) {
                return !argument.key.empty() ? each.name == argument.key
                                             : each.kind == Parameter::Kind::words || !has(each.name);
            });
            if (parameter == parameters.end())
                throw TextError(where_, argument.column,
                                argument.key.empty() ? "stage '" + stage + "' has no place for '" +
                                                           argument.value + "'; remove it"
                                                     : "stage '" + stage + "' has no '" + argument.key + "'" +
                                                           suggestion(argument.key, names(parameters)));
            if (has(parameter->name) && parameter->kind != Parameter::Kind::words)
                throw TextError(where_, argument.column,
                                "'" + parameter->name + "' is given twice; give it once");
            const std::optional<double> value = parsed(argument.value);
            if (!parameter->is_text() && !(value && parameter->allows(*value)))
                throw TextError(where_, argument.column,
                                "stage '" + stage + "': " + parameter->name + " is '" + argument.value +
                                    "'; give " + parameter->expected(value && *value > parameter->upper));
            values_[parameter->name].push_back(argument);
        }
        for (const auto& parameter : parameters) {
            if (has(parameter.name))
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

    static std::vector<std::string> names(const std::vector<Parameter>& parameters) {
        std::vector<std::string> names;
        for (const auto& each : parameters)
            names.push_back(each.name);
        return names;
    }
    std::string where_;
    std::map<std::string, std::vector<ArgumentText>> values_;
};

} // namespace ga
