#include "domain/text/unit.hpp"

#include "domain/errors.hpp"
#include "domain/text/words.hpp"

#include <algorithm>
#include <array>

namespace rough {
namespace {

/// A unit: the name that accounts print, and its spellings in lower case.
struct KnownUnit {
    std::string_view name;
    double in_mm;
    std::string_view spellings;
};

constexpr std::array<KnownUnit, 11> known_units{{
    {"m", 1e3, " m meter metre "},
    {"cm", 10, " cm centimeter centimetre "},
    {"mm", 1, " mm millimeter millimetre "},
    {"µm", 1e-3, " µm μm um mum µ μ micron micrometer micrometre mikrometer "},
    {"nm", 1e-6, " nm nanometer nanometre "},
    {"pm", 1e-9, " pm picometer picometre "},
    {"Å", 1e-7, " å Å a ang angstrom ångström ångstrom "},
    {"in", 25.4, " in inch inches "},
    {"mil", 0.0254, " mil thou "},
    {"µin", 25.4e-6, " µin uin microinch microinches "},
    {"dm", 100, " dm "},
}};

constexpr std::string_view other_quantities = " v mv µv uv s ms sec hz n mn px pix pixel pixels deg ° % rad ";

bool ambiguous(std::string_view word) { return word.size() == 1 || lower(word) == "in"; }

std::string_view bracketed(std::string_view word) {
    constexpr std::string_view open = "[({<", close = "])}>";
    const auto kind = word.empty() ? std::string_view::npos : open.find(word.front());
    return kind != std::string_view::npos && word.back() == close[kind] ? trim(word.substr(1, word.size() - 2))
                                                                        : std::string_view{};
}

struct Word {
    std::string_view text;
    char before; ///< the character before it; '\n' at the start
};

/// The words of a header; a bracketed group is one word.
std::vector<Word> words_of(std::string_view header) {
    std::vector<Word> words;
    std::size_t start = 0;
    const auto end_word = [&](std::size_t end, std::size_t next) {
        if (end > start) words.push_back({header.substr(start, end - start), start > 0 ? header[start - 1] : '\n'});
        start = next;
    };
    for (std::size_t i = 0; i < header.size(); ++i) {
        if (std::string_view("[({<").find(header[i]) != std::string_view::npos) {
            const std::size_t close = header.find_first_of("])}>", i);
            if (close == std::string_view::npos) continue;
            end_word(i, i);
            end_word(close + 1, close + 1);
            i = close;
        } else if (std::string_view(" \t,;:_\"'").find(header[i]) != std::string_view::npos) {
            end_word(i, i + 1);
        }
    }
    end_word(header.size(), header.size());
    return words;
}

/// Whether a single letter is a unit, as in "x / m", "x in m", "x_m".
bool is_announced(const std::vector<Word>& words, std::size_t i) {
    return words[i].before == '_' || (i > 0 && (words[i - 1].text == "/" || lower(words[i - 1].text) == "in"));
}

} // namespace

std::optional<LengthUnit> length_unit(std::string_view word) {
    const std::string small = lower(trim(word));
    for (const std::string& form : {small, small.ends_with('s') ? small.substr(0, small.size() - 1) : small})
        for (const KnownUnit& unit : known_units)
            if (is_in(unit.spellings, form)) return LengthUnit{std::string(unit.name), unit.in_mm};
    return std::nullopt;
}

LengthUnit length_unit_named(std::string_view word, const std::string& where) {
    if (const auto unit = length_unit(word)) return *unit;
    refuse(where, ": '", word, "' is not a length unit; use a known one: ", known_lengths);
}

std::vector<LengthUnit> length_units_in(std::string_view header, const std::string& where) {
    if (const auto unit = length_unit(header)) return {*unit};
    const auto words = words_of(header);
    const bool units_only = !words.empty() && std::all_of(words.begin(), words.end(), [](const Word& word) {
        return length_unit(word.text).has_value();
    });
    std::vector<LengthUnit> found;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string_view word = words[i].text;
        const std::string_view inside = bracketed(word);
        const std::size_t slash = word.rfind('/');
        std::optional<LengthUnit> unit;
        if (!inside.empty()) {
            unit = length_unit(inside);
            if (is_in(other_quantities, lower(inside)))
                refuse(where, ": a column in '", inside, "', which is not a length; use ", known_lengths);
        } else if (slash != std::string_view::npos && slash > 0) {
            unit = length_unit(word.substr(slash + 1));
        } else if (units_only || !ambiguous(word) || is_announced(words, i)) {
            unit = length_unit(word);
        }
        if (unit) found.push_back(*unit);
    }
    return found;
}

std::string unknown_unit_in(std::string_view name) {
    const auto words = words_of(name);
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string_view inside = bracketed(words[i].text);
        // Round brackets hold remarks as well: "z (raw)".
        const std::size_t longest = words[i].text.front() == '[' ? 6 : 2;
        const bool as_a_unit =
            inside.size() >= 2 && inside.size() <= longest && std::all_of(inside.begin(), inside.end(), [](char c) {
                return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.';
            });
        if (as_a_unit && !length_unit(inside)) return std::string(inside);
    }
    return "";
}

} // namespace rough
