#pragma once

#include "ga/text/registry.hpp"

namespace ga {

struct StageText;
/// The stages of a pipeline from left to right.
using PipelineText = std::vector<StageText>;

/// One stage as it is written, before its words are understood.
struct StageText {
    std::string name;                    ///< first word of the stage
    std::size_t column = 0;              ///< column in the text, from 1
    std::vector<ArgumentText> arguments; ///< arguments as they were written
    std::vector<PipelineText> bodies;    ///< pipelines of a block: one in braces, two for `pair`
};

/// Reads  pipeline := stage {"|" stage};
///        stage := NAME {arg} ["{" pipeline "}"] | "pair(" pipeline "," pipeline "," NAME ")";
///        arg := NUMBER | WORD | KEY=VALUE
/// Throws TextError with the column of an error.
class Syntax {
  public:
    /// @param where  name of the text in errors
    Syntax(std::string_view text, std::string where);

    /// Reads the whole text. Throws TextError.
    PipelineText read();

  private:
    static constexpr std::size_t longest = 1000000;

    PipelineText read_pipeline();
    StageText read_stage();

    static bool is_symbol(char c) { return std::string_view("|{}(),=").find(c) != std::string_view::npos; }
    static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
    /// Names and numbers begin with a letter, a digit or one of + - . _ / @
    bool is_word() const;
    std::string quoted() const;
    [[noreturn]] void fail(const std::string& message) const;

    std::string word(const std::string& what);
    void take(const std::string& symbol);
    /// Reads the next symbol or word; an empty token is the end.
    void next();

    std::string_view text_;
    std::string where_;
    std::string token_;
    std::size_t at_ = 0, column_ = 1;
    int depth_ = 0;
};

/// Named pipelines, which other pipelines may use as stages: the [variants] of an experiment.
using Variants = std::map<std::string, std::string>;

/// Makes pipelines from text. Each stage stores its column in the text for later error messages.
template <Problem P>
class Parser {
  public:
    /// Throws UsageError if a variant has the name of an operator.
    [[gnu::cold]] explicit Parser(Registry<P> registry, Variants variants = {})
        : registry_(std::move(registry)), variants_(std::move(variants)) {
        const auto names = registry_.names();
        for (const auto& [name, text] : variants_)
            if (std::ranges::count(names, name) > 0)
                throw UsageError("variant '" + name + "' has an operator's name; choose another");
    }

    /// @param text   a pipeline
    /// @param where  its name in messages
    [[gnu::cold]] Pipeline<P> parse(const std::string& text, const std::string& where = "pipeline");

    /// The pipeline of a named variant. Names of other variants are expanded in place; a cycle is refused.
    [[gnu::cold]] Pipeline<P> variant(const std::string& name);

  private:
    static constexpr std::size_t max_stages = 10000;

    /// Resets the state of the previous text.
    [[gnu::cold]] void begin() {
        open_.clear();
        stages_ = 0;
    }
    [[gnu::cold]] Pipeline<P> named(const std::string& name) {
        const std::string where = "variant '" + name + "'";
        open_.push_back(name);
        Pipeline<P> pipeline = make(Syntax(variants_.at(name), where).read(), where);
        open_.pop_back();
        return pipeline;
    }

    [[gnu::cold]] Pipeline<P> make(const PipelineText& stages, const std::string& where) {
        Pipeline<P> pipeline;
        for (const StageText& stage : stages) pipeline.append(make(stage, where));
        return pipeline;
    }

    [[gnu::cold]] Pipeline<P> make(const StageText& text, const std::string& where) {
        if (variants_.count(text.name)) return expanded(text, where);
        if (text.name == "pair") return located(paired(text, where), text, where);
        StageText stage = text;
        const auto& entry = *operator_of(stage, where);
        const std::string name = entry.name;
        if (!entry.lacks.empty())
            throw TextError(where, text.column,
                            "stage '" + name + "' cannot work here; use a problem that has " + entry.lacks);
        if (stage.bodies.size() != entry.bodies)
            throw TextError(where, text.column,
                            "stage '" + name +
                                (entry.bodies == 0 ? "' takes no { ... }; remove it" : "' lacks its { ... }; add it"));
        std::vector<Pipeline<P>> bodies;
        for (const auto& body : stage.bodies) bodies.push_back(make(body, where));
        if (entry.pairs_of_words) key_words(entry, stage, where);
        const Arguments arguments(entry.parameters, stage.arguments, name, text.column, where);
        try {
            return located(entry.make(arguments, bodies, registry_), text, where);
        } catch (const TextError&) {
            throw;
        } catch (const UsageError& error) {
            throw TextError(where, text.column, error.what());
        }
    }

    /// The operator that a stage names. The name of a family's member is removed from the arguments.
    [[gnu::cold]] const typename Registry<P>::Entry* operator_of(StageText& stage, const std::string& where) const {
        const std::vector<std::string> members = registry_.members(stage.name);
        const auto* alone = registry_.find(stage.name);
        if (members.empty() && alone) return alone;
        if (members.empty())
            throw TextError(where, stage.column,
                            "unknown stage '" + stage.name + "'" +
                                suggestion(stage.name, with_variants(registry_.names())));
        const auto word = std::ranges::find_if(stage.arguments, [](const auto& argument) {
            return argument.key.empty() && !Arguments::parsed(argument.value);
        });
        if (word == stage.arguments.end() && alone) return alone;
        if (word == stage.arguments.end())
            throw TextError(where, stage.column, "stage '" + stage.name + "' lacks its kind" + suggestion("", members));
        const auto* member = registry_.find(stage.name + " " + word->value);
        if (!member)
            throw TextError(where, word->column,
                            "unknown " + stage.name + " '" + word->value + "'" + suggestion(word->value, members));
        stage.arguments.erase(word);
        return member;
    }

    /// Reads "fitness 0.99" as fitness=0.99.
    [[gnu::cold]] static void key_words(const typename Registry<P>::Entry& entry, StageText& stage,
                                        const std::string& where) {
        for (auto argument = stage.arguments.begin(); argument != stage.arguments.end(); ++argument) {
            if (!argument->key.empty()) continue;
            argument->key = argument->value; // Arguments will refuse an unknown one
            const auto parameter = std::ranges::find(entry.parameters, argument->key, &Parameter::name);
            if (parameter == entry.parameters.end()) continue;
            const auto value = argument + 1;
            if (value == stage.arguments.end() || !value->key.empty())
                throw TextError(where, argument->column,
                                "stage '" + entry.name + "': '" + parameter->name + "' lacks its value; give " +
                                    parameter->expected());
            argument->value = value->value;
            stage.arguments.erase(value);
        }
    }

    [[gnu::cold]] Pipeline<P> paired(const StageText& text, const std::string& where) {
        const ArgumentText& name = text.arguments.front();
        std::vector<std::string> names;
        for (const auto& [combine, meaning] : registry_.combines()) {
            if (combine.name == name.value)
                return Pipeline<P>(pair(make(text.bodies[0], where), make(text.bodies[1], where), combine));
            names.push_back(combine.name);
        }
        throw TextError(where, name.column, "unknown combination '" + name.value + "'" + suggestion(name.value, names));
    }

    [[gnu::cold]] Pipeline<P> expanded(const StageText& text, const std::string& where) {
        if (!text.arguments.empty() || !text.bodies.empty())
            throw TextError(where, text.column, "variant '" + text.name + "' takes no arguments; remove them");
        if (std::ranges::count(open_, text.name) > 0) {
            std::string cycle;
            for (const auto& name : open_) cycle += name + " -> ";
            throw TextError(where, text.column, "variants contain each other: " + cycle + text.name + "; remove one");
        }
        return named(text.name);
    }

    /// Returns the stage with its column.
    [[gnu::cold]] Pipeline<P> located(Pipeline<P> pipeline, const StageText& text, const std::string& where) {
        if (++stages_ > max_stages)
            throw TextError(where, text.column, "more than 10000 stages, with those of variants; use fewer");
        pipeline.locate(where, text.column);
        return pipeline;
    }

    /// The names, followed by those of the variants.
    [[gnu::cold]] std::vector<std::string> with_variants(std::vector<std::string> names) const {
        for (const auto& [name, text] : variants_) names.push_back(name);
        return names;
    }

    Registry<P> registry_;
    Variants variants_;
    std::vector<std::string> open_; ///< variants that are being expanded
    std::size_t stages_ = 0;        ///< number of stages of the current text
};

// Functions outside the class are not inline, so compiled_once.hpp can keep them in one file.
template <Problem P>
Pipeline<P> Parser<P>::parse(const std::string& text, const std::string& where) {
    begin();
    return make(Syntax(text, where).read(), where);
}
template <Problem P>
Pipeline<P> Parser<P>::variant(const std::string& name) {
    if (!variants_.count(name))
        throw UsageError("unknown variant '" + name + "'" + suggestion(name, with_variants({})));
    begin();
    return named(name);
}

} // namespace ga
