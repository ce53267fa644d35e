#pragma once

#include <concepts>
#include <string>
#include <string_view>

namespace app {

/// Text for HTML and SVG: &, <, > and quotes escaped.
std::string escaped(std::string_view text);

/// HTML to stand in a page. Whatever text becomes it is escaped, so that a name from a file shows as it is
/// written; mark-up is the exception that says so.
class Html {
  public:
    Html() = default;
    template <class Text>
    requires std::convertible_to<const Text&, std::string_view> Html(const Text& text)
        : markup_(escaped(text)) {}

    /// Mark-up as it is: of the program's own words, never of what was read.
    static Html raw(std::string markup) {
        Html html;
        html.markup_ = std::move(markup);
        return html;
    }

    const std::string& markup() const { return markup_; }
    Html& operator+=(const Html& more) {
        markup_ += more.markup_;
        return *this;
    }
    friend Html operator+(Html first, const Html& second) { return first += second; }

  private:
    std::string markup_;
};

} // namespace app
