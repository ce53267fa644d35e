#include "ga/text/parser.hpp"

namespace ga {
namespace {

std::vector<std::string> names(const std::vector<Parameter>& parameters) {
    std::vector<std::string> names;
    for (const auto& each : parameters) names.push_back(each.name);
    return names;
}

} // namespace

Syntax::Syntax(std::string_view text, std::string where) : text_(text), where_(std::move(where)) {
    if (text.size() > longest)
        throw TextError(where_, longest, "the text is longer than 1000000 characters; shorten it");
    next();
}

PipelineText Syntax::read() {
    PipelineText pipeline = read_pipeline();
    if (!token_.empty()) fail("unexpected " + quoted() + "; write | or end the text");
    return pipeline;
}

PipelineText Syntax::read_pipeline() {
    if (++depth_ > 100) fail("more than 100 pipelines inside each other; nest fewer");
    PipelineText pipeline = {read_stage()};
    while (token_ == "|") {
        next();
        pipeline.push_back(read_stage());
    }
    --depth_;
    return pipeline;
}

StageText Syntax::read_stage() {
    StageText stage;
    stage.column = column_;
    stage.name = word("the name of a stage");
    if (stage.name == "pair") {
        take("(");
        stage.bodies.push_back(read_pipeline());
        take(",");
        stage.bodies.push_back(read_pipeline());
        take(",");
        const std::size_t column = column_;
        stage.arguments.push_back({"", word("the name of a combination"), column});
        take(")");
        return stage;
    }
    while (is_word()) {
        ArgumentText argument{"", token_, column_};
        next();
        if (token_ == "=") {
            next();
            argument.key = argument.value;
            argument.value = word("a value for " + argument.key);
        }
        stage.arguments.push_back(std::move(argument));
    }
    if (token_ == "{") {
        next();
        stage.bodies.push_back(read_pipeline());
        take("}");
    }
    return stage;
}

bool Syntax::is_word() const {
    const auto first = token_.empty() ? ' ' : token_[0];
    return (first >= '0' && first <= '9') || (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z') ||
           static_cast<unsigned char>(first) >= 0x80 ||
           std::string_view("+-._/@").find(first) != std::string_view::npos;
}

std::string Syntax::quoted() const { return token_.empty() ? "end" : "'" + token_ + "'"; }

void Syntax::fail(const std::string& message) const { throw TextError(where_, column_, message); }

std::string Syntax::word(const std::string& what) {
    if (!is_word()) fail("unexpected " + quoted() + "; give " + what);
    std::string word = token_;
    next();
    return word;
}

void Syntax::take(const std::string& symbol) {
    if (token_ != symbol) fail("unexpected " + quoted() + "; write " + symbol);
    next();
}

void Syntax::next() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    const std::size_t start = at_;
    column_ = start + 1;
    if (at_ < text_.size() && is_symbol(text_[at_]))
        ++at_;
    else
        while (at_ < text_.size() && !is_space(text_[at_]) && !is_symbol(text_[at_])) ++at_;
    token_ = text_.substr(start, at_ - start);
}

Arguments::Arguments(const std::vector<Parameter>& parameters, const std::vector<ArgumentText>& given,
                     const std::string& stage, std::size_t column, std::string where)
    : where_(std::move(where)) {
    for (const auto& argument : given) {
        const auto parameter = std::ranges::find_if(parameters, [&](const Parameter& each) {
            return !argument.key.empty() ? each.name == argument.key
                                         : each.kind == Parameter::Kind::words || !has(each.name);
        });
        if (parameter == parameters.end())
            throw TextError(where_, argument.column,
                            argument.key.empty()
                                ? "stage '" + stage + "' has no place for '" + argument.value + "'; remove it"
                                : "stage '" + stage + "' has no '" + argument.key + "'" +
                                      suggestion(argument.key, names(parameters)));
        if (has(parameter->name) && parameter->kind != Parameter::Kind::words)
            throw TextError(where_, argument.column, "'" + parameter->name + "' is given twice; give it once");
        const std::optional<double> value = parsed(argument.value);
        if (!parameter->is_text() && !(value && parameter->allows(*value)))
            throw TextError(where_, argument.column,
                            "stage '" + stage + "': " + parameter->name + " is '" + argument.value + "'; give " +
                                parameter->expected(value && *value > parameter->upper));
        values_[parameter->name].push_back(argument);
    }
    for (const auto& parameter : parameters) {
        if (has(parameter.name)) continue;
        if (!parameter.standard)
            throw TextError(where_, column,
                            "stage '" + stage + "' lacks '" + parameter.name + "'; give " + parameter.expected());
        if (!parameter.standard->empty()) values_[parameter.name] = {{"", *parameter.standard, column}};
    }
}

std::vector<std::string> Arguments::words(const std::string& name) const {
    std::vector<std::string> words;
    for (const auto& argument : values_.at(name)) words.push_back(argument.value);
    return words;
}

std::optional<double> Arguments::parsed(const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

void Arguments::put(const std::vector<BoundParameter>& fields) const {
    for (const BoundParameter& field : fields)
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

void Arguments::refuse(const std::string& name, const std::string& message) const {
    throw TextError(where_, values_.at(name).front().column, message);
}

} // namespace ga
