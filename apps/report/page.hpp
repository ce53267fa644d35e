#pragma once

#include "apps/report/html.hpp"
#include "apps/report/plot.hpp"

#include <string>
#include <vector>

namespace app {

/// A picture of one or more plots under one caption.
struct Figure {
    std::string id;    ///< where a link finds it, e.g. "figure-6"
    std::string title; ///< e.g. "Figure 6. The database and the target"
    Html caption;      ///< what to see in it
    std::vector<Plot> panels;
};

struct Table {
    std::string title;
    std::vector<std::string> header;
    std::vector<std::vector<Html>> rows; ///< as wide as the header
    std::vector<bool> numeric = {};      ///< columns set flush right; missing: all false
    bool stacks = false; ///< on a narrow screen each row becomes a card; for cells of whole sentences
};

/// A self-contained web page, in light and dark, for a phone, a desk and paper: no script, no request to any
/// network. Blocks stand in the order in which they are added; pictures are drawn when the page is asked for.
class Page {
  public:
    Page(std::string title, Html lead) : title_(std::move(title)), lead_(std::move(lead)) {}

    void section(const std::string& heading);
    void prose(const Html& text); ///< one paragraph
    void figure(Figure figure);
    void table(const Table& table);
    void code(const std::string& text);                ///< plain text, e.g. a command
    void links(const std::vector<std::string>& files); ///< to files, by their path from the page
    /// Figures at a glance: what it is, and its value.
    void tiles(const std::vector<std::pair<std::string, std::string>>& tiles);

    /// The page. Drawing takes so many seconds at most; in the place of a picture that could not be drawn
    /// stands why.
    std::string html(double seconds = 60) const;

  private:
    std::string title_;
    Html lead_;
    std::vector<std::pair<std::string, std::string>> sections_; ///< id, heading
    std::vector<Figure> figures_;
    std::vector<std::string> blocks_; ///< HTML, or "\x01" for the next figure
};

} // namespace app
