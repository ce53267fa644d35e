#include "ga/pipeline/parameters.hpp"

#include <boost/algorithm/string/join.hpp>

namespace ga {

std::string Parameter::expected(bool in_full) const {
    if (is_text()) return kind == Kind::word ? "a name" : "names";
    std::string text = kind == Kind::whole ? "a whole number" : "a number";
    if (lower > -no_limit) text += lower == above_zero ? " above 0" : " from " + ga::number(lower);
    if (upper < (kind == Kind::whole && !in_full ? max_whole : no_limit))
        text += " to " + (kind == Kind::whole ? std::to_string(static_cast<long>(upper)) : ga::number(upper));
    return text;
}

Parameter number(std::string name, std::optional<std::string> standard, double lower, double upper,
                 std::string meaning) {
    return {std::move(name), Parameter::Kind::number, std::move(standard), std::move(meaning), lower, upper};
}
Parameter number(std::string name, double lower, double upper, std::string meaning) {
    return number(std::move(name), std::nullopt, lower, upper, std::move(meaning)).optional();
}
Parameter whole(std::string name, std::optional<std::string> standard, double lower, std::string meaning) {
    return {std::move(name), Parameter::Kind::whole, std::move(standard), std::move(meaning),
            lower,           Parameter::max_whole};
}
Parameter whole(std::string name, double lower, std::string meaning) {
    return whole(std::move(name), std::nullopt, lower, std::move(meaning)).optional();
}
Parameter word(std::string name, std::optional<std::string> standard, std::string meaning) {
    return {std::move(name), Parameter::Kind::word, std::move(standard), std::move(meaning)};
}
Parameter word(std::string name, std::string meaning) {
    return word(std::move(name), std::nullopt, std::move(meaning)).optional();
}
Parameter word_list(std::string name, std::string meaning) {
    return {std::move(name), Parameter::Kind::words, std::nullopt, std::move(meaning)};
}

std::string BoundParameter::in_words() const {
    return std::visit(
        [](const auto* at) -> std::string {
            using Value = std::remove_cvref_t<decltype(*at)>;
            if constexpr (std::is_same_v<Value, double>)
                return number(*at);
            else if constexpr (std::is_arithmetic_v<Value>)
                return std::to_string(*at);
            else if constexpr (std::is_same_v<Value, std::string>)
                return *at;
            else
                return boost::algorithm::join(*at, " ");
        },
        value);
}

std::optional<double> BoundParameter::as_number() const {
    return std::visit(
        [](const auto* at) -> std::optional<double> {
            if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(*at)>>)
                return static_cast<double>(*at);
            else
                return std::nullopt;
        },
        value);
}

std::string values_in_words(const std::vector<BoundParameter>& fields) {
    std::string text;
    for (const BoundParameter& field : fields) {
        const std::string words = field.in_words();
        if (words.empty() || (field.parameter.is_quiet && field.parameter.standard == words)) continue;
        text += (text.empty() ? "" : " ") + (field.parameter.is_keyed ? field.parameter.name + "=" : "") + words;
    }
    return text;
}

void check_values(const std::vector<BoundParameter>& fields, const std::string& name) {
    for (const BoundParameter& field : fields)
        if (const auto given = field.as_number(); given && !field.parameter.allows(*given))
            throw UsageError("stage '" + name + "': " + field.parameter.name + " is '" + field.in_words() + "'; give " +
                             field.parameter.expected(*given > field.parameter.upper));
}

} // namespace ga
