#include "apps/report/page.hpp"

#include "apps/report/page_style.hpp"
#include "apps/report/plot_svg.hpp"

#include <cctype>
#include <cstdio>
#include <stdexcept>

namespace app {

namespace {

const std::string next_figure = "\x01";

std::string with_panels(const Figure& figure, const Drawing& drawing, std::size_t first) {
    const std::size_t count = figure.panels.size();
    const std::size_t columns = count % 3 == 0 ? 3 : std::min<std::size_t>(count, 2);
    std::string html =
        "<figure id=\"" + figure.id + "\"><div class=\"panels of-" + std::to_string(columns) + "\">\n";
    for (std::size_t i = 0; i < count; ++i) {
        const std::string& title = figure.panels[i].title;
        const std::string& picture = drawing.pictures[first + i];
        html += "<div>" + (title.empty() ? "" : "<p>" + escaped(title) + "</p>") +
                (picture.empty() ? "<p>No picture: " + escaped(drawing.missing) + ".</p>" : picture) +
                "</div>\n";
    }
    return html + "</div><figcaption><b>" + escaped(figure.title) + "</b> " + figure.caption.markup() +
           "</figcaption></figure>\n";
}

/// A path as an address from the page: what means something else there is written by its number.
std::string address(const std::string& path) {
    std::string text = path.find(':') < path.find('/') ? "./" : "";
    for (const char c : path)
        if (std::isalnum(static_cast<unsigned char>(c)) ||
            std::string_view("-._~/:").find(c) != std::string_view::npos) {
            text += c;
        } else {
            char number[4];
            std::snprintf(number, sizeof number, "%%%02X",
                          static_cast<unsigned>(static_cast<unsigned char>(c)));
            text += number;
        }
    return text;
}

} // namespace

void Page::section(const std::string& heading) {
    const std::string id = "section-" + std::to_string(sections_.size() + 1);
    sections_.emplace_back(id, heading);
    blocks_.push_back("<h2 id=\"" + id + "\">" + escaped(heading) + "</h2>\n");
}

void Page::prose(const Html& text) { blocks_.push_back("<p>" + text.markup() + "</p>\n"); }

void Page::code(const std::string& text) {
    blocks_.push_back("<pre><code>" + escaped(text) + "</code></pre>\n");
}

void Page::links(const std::vector<std::string>& files) {
    std::string html;
    for (const std::string& file : files)
        html += "<li><a href=\"" + address(file) + "\">" + escaped(file) + "</a></li>\n";
    blocks_.push_back("<ul>" + html + "</ul>\n");
}

void Page::figure(Figure figure) {
    figures_.push_back(std::move(figure));
    blocks_.push_back(next_figure);
}

void Page::table(const Table& table) {
    const auto cell = [&](const std::string& tag, std::size_t column, const Html& content) {
        const bool numeric = column < table.numeric.size() && table.numeric[column];
        return "<" + tag +
               (tag == "th" ? " scope=\"col\"" : " data-label=\"" + escaped(table.header[column]) + "\"") +
               (numeric ? " class=\"number\">" : ">") + content.markup() + "</" + tag + ">";
    };
    const auto row = [&](const std::string& tag, const std::vector<Html>& cells) {
        if (cells.size() != table.header.size())
            throw std::logic_error("table '" + table.title + "': a row of " + std::to_string(cells.size()) +
                                   " cells under a header of " + std::to_string(table.header.size()));
        std::string html = "<tr>";
        for (std::size_t column = 0; column < cells.size(); ++column)
            html += cell(tag, column, cells[column]);
        return html + "</tr>\n";
    };
    std::string html = "<div class=\"table" + std::string(table.stacks ? " stacks" : "") + "\"><table>" +
                       (table.title.empty() ? "" : "<caption>" + escaped(table.title) + "</caption>") +
                       "<thead>" + row("th", {table.header.begin(), table.header.end()}) +
                       "</thead><tbody>\n";
    for (const auto& cells : table.rows)
        html += row("td", cells);
    blocks_.push_back(html + "</tbody></table></div>\n");
}

void Page::tiles(const std::vector<std::pair<std::string, std::string>>& tiles) {
    std::string html = "<dl class=\"tiles\">";
    for (const auto& [what, value] : tiles)
        html += "<div><dt>" + escaped(what) + "</dt><dd>" + escaped(value) + "</dd></div>";
    blocks_.push_back(html + "</dl>\n");
}

std::string Page::html(double seconds) const {
    std::vector<Plot> plots;
    for (const Figure& figure : figures_)
        plots.insert(plots.end(), figure.panels.begin(), figure.panels.end());
    const Drawing drawing = draw(plots, "plot", seconds);

    std::string contents;
    for (const auto& [id, heading] : sections_)
        contents += "<a href=\"#" + id + "\">" + escaped(heading) + "</a>\n";
    std::string body;
    std::size_t figure = 0, picture = 0;
    for (const std::string& block : blocks_)
        if (block == next_figure) {
            body += with_panels(figures_[figure], drawing, picture);
            picture += figures_[figure++].panels.size();
        } else {
            body += block;
        }
    return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
           "<meta name=\"color-scheme\" content=\"light dark\">\n"
           "<link rel=\"icon\" href=\"data:,\">\n<title>" +
           escaped(title_) + "</title>\n<style>" + page_style + plot_style() +
           "</style>\n</head>\n<body>\n<header><h1>" + escaped(title_) + "</h1>\n<p class=\"lead\">" +
           lead_.markup() + "</p>\n" +
           (contents.empty() ? "" : "<nav aria-label=\"Contents\">" + contents + "</nav>") +
           "</header>\n<main>\n" + body + "</main>\n</body>\n</html>\n";
}

} // namespace app
