#pragma once

#include "ga/base/errors.hpp"

#include <string_view>
#include <vector>

namespace ga {

/// One argument of a stage: VALUE, or KEY=VALUE.
struct ArgumentText {
    std::string key;        ///< empty if only a value was given
    std::string value;      ///< value as it was written
    std::size_t column = 0; ///< column in the text, from 1
};

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
    Syntax(std::string_view text, std::string where) : text_(text), where_(std::move(where)) {
        if (text.size() > longest)
            throw TextError(where_, longest, "the text is longer than 1000000 characters; shorten it");
        next();
    }

    /// Reads the whole text. Throws TextError.
    [[gnu::cold]] PipelineText read() {
        PipelineText pipeline = read_pipeline();
        if (!token_.empty())
            fail("unexpected " + quoted() + "; write | or end the text");
        return pipeline;
    }

  private:
    static constexpr std::size_t longest = 1000000;

    [[gnu::cold]] PipelineText read_pipeline() {
        if (++depth_ > 100)
            fail("more than 100 pipelines inside each other; nest fewer");
        PipelineText pipeline = {read_stage()};
        while (token_ == "|") {
            next();
            pipeline.push_back(read_stage());
        }
        --depth_;
        return pipeline;
    }

    [[gnu::cold]] StageText read_stage() {
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

    static bool is_symbol(char c) { return std::string_view("|{}(),=").find(c) != std::string_view::npos; }
    static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
    /// Names and numbers begin with a letter, a digit or one of + - . _ / @
    [[gnu::cold]] bool is_word() const {
        const auto first = token_.empty() ? ' ' : token_[0];
        return (first >= '0' && first <= '9') || (first >= 'a' && first <= 'z') ||
               (first >= 'A' && first <= 'Z') || static_cast<unsigned char>(first) >= 0x80 ||
               std::string_view("+-._/@").find(first) != std::string_view::npos;
    }
    [[gnu::cold]] std::string quoted() const { return token_.empty() ? "end" : "'" + token_ + "'"; }
    [[noreturn]] void fail(const std::string& message) const { throw TextError(where_, column_, message); }

    [[gnu::cold]] std::string word(const std::string& what) {
        if (!is_word())
            fail("unexpected " + quoted() + "; give " + what);
        std::string word = token_;
        next();
        return word;
    }
    [[gnu::cold]] void take(const std::string& symbol) {
        if (token_ != symbol)
            fail("unexpected " + quoted() + "; write " + symbol);
        next();
    }
    /// Reads the next symbol or word; an empty token is the end.
    [[gnu::cold]] void next() {
        while (at_ < text_.size() && is_space(text_[at_]))
            ++at_;
        const std::size_t start = at_;
        column_ = start + 1;
        if (at_ < text_.size() && is_symbol(text_[at_]))
            ++at_;
        else
            while (at_ < text_.size() && !is_space(text_[at_]) && !is_symbol(text_[at_]))
                ++at_;
        token_ = text_.substr(start, at_ - start);
    }

    std::string_view text_;
    std::string where_;
    std::string token_;
    std::size_t at_ = 0, column_ = 1;
    int depth_ = 0;
};

} // namespace ga
