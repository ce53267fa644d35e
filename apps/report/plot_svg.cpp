#include "apps/report/plot_svg.hpp"

#include <boost/property_tree/xml_parser.hpp>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <sstream>

namespace app {

namespace {

using Tree = boost::property_tree::ptree;

/// A colour of `Colour`: its CSS class, what gnuplot is told, and how it looks on light and on dark ground.
struct Ink {
    const char *name, *told;
    int red, green, blue;
    const char *light, *dark;
};
constexpr std::array<Ink, 9> inks{{
    {"text", "#010203", 1, 2, 3, "#22262b", "#e4e6e8"},
    {"faint", "#808182", 128, 129, 130, "#868e96", "#7d868e"},
    {"blue", "#0072b2", 0, 114, 178, "#0072b2", "#4da3d9"},
    {"orange", "#e69f00", 230, 159, 0, "#b57400", "#f0b429"},
    {"green", "#009e73", 0, 158, 115, "#009e73", "#2fbf95"},
    {"purple", "#cc79a7", 204, 121, 167, "#b8558c", "#dd8fba"},
    {"sky", "#56b4e9", 86, 180, 233, "#2f8fc9", "#7cc8f2"},
    {"red", "#d55e00", 213, 94, 0, "#d55e00", "#f2803a"},
    {"unseen", "#040506", 4, 5, 6, "#22262b", "#e4e6e8"},
}};

/// The ink of a colour as gnuplot writes it, or none.
const Ink* ink_of(const std::string& colour) {
    int red = 0, green = 0, blue = 0;
    if (std::sscanf(colour.c_str(), "rgb(%d,%d,%d)", &red, &green, &blue) == 3)
        for (const Ink& ink : inks)
            if (ink.red == red && ink.green == green && ink.blue == blue)
                return &ink;
    return nullptr;
}

/// Its class; gnuplot's own black and grey are the axes and the grid.
std::string ink_class(const std::string& colour) {
    const Ink* ink = ink_of(colour);
    return ink ? ink->name : colour == "gray" ? "grid" : "text";
}

/// "95.13" as "95.1", "242.00" as "242"
std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", value);
    std::string result = text;
    if (result.ends_with(".0"))
        result.resize(result.size() - 2);
    return result == "-0" ? "0" : result;
}

/// Every number of a path or transformation shortened; a path's "L" goes, as a move implies it.
std::string shortened(const std::string& text) {
    std::string result;
    for (const char* at = text.c_str(); *at;) {
        char* end = nullptr;
        const bool number = (*at >= '0' && *at <= '9') || *at == '-' || *at == '.';
        const double value = number ? std::strtod(at, &end) : 0;
        if (number && end != at) {
            result += short_number(value);
            at = end;
        } else if (*at == 'L' || *at == '\n' || *at == '\t' || *at == ' ') {
            if (!result.empty() && result.back() != ' ' && *at != 'L')
                result += ' ';
            ++at;
        } else {
            result += *at++;
        }
    }
    while (!result.empty() && result.back() == ' ')
        result.pop_back();
    return result;
}

std::string attribute(const std::string& name, const std::string& value) {
    return value.empty() ? "" : " " + name + "=\"" + value + "\"";
}

std::string given(const Tree& element, const std::string& name) {
    return element.get("<xmlattr>." + name, std::string());
}

/// gnuplot nests a group for every change of pen: the marks are told what their groups say, and groups go.
class Tidy {
  public:
    Tidy(std::string id, const Plot& plot) : id_(std::move(id)), plot_(plot) {}

    std::string children(const Tree& element, const Tree& pen) {
        std::string result;
        for (const auto& [name, child] : element)
            result += mark(name, child, pen);
        return result;
    }

    /// The markers that were used, circle, square, triangle and diamond by gnuplot's numbers.
    std::string markers() const {
        static const std::vector<std::pair<std::string, std::string>> shapes = {
            {"6", "<circle r=\"1\"/>"},
            {"4", "<polygon points=\"-.9-.9 .9-.9 .9 .9-.9 .9\"/>"},
            {"8", "<polygon points=\"0-1.3-1.3 .7 1.3 .7\"/>"},
            {"12", "<polygon points=\"0-1.3 1.3 0 0 1.3-1.3 0\"/>"},
        };
        std::string result;
        for (const auto& [number, shape] : shapes)
            if (used_.contains(number))
                result += "<g id=\"" + id_ + "m" + number + "\">" + shape + "</g>";
        return result.empty() ? "" : "<defs>" + result + "</defs>";
    }

  private:
    std::string mark(const std::string& name, const Tree& element, const Tree& pen) {
        if (name == "g")
            return group(element, pen);
        if (name == "path")
            return path(element, pen);
        if (name == "image")
            return "<image preserveAspectRatio=\"none\"" + attribute("x", shortened(given(element, "x"))) +
                   attribute("y", shortened(given(element, "y"))) +
                   attribute("width", shortened(given(element, "width"))) +
                   attribute("height", shortened(given(element, "height"))) +
                   attribute("href", given(element, "xlink:href")) + "/>";
        // A colour of a scale, which is no ink.
        if (const std::string fill = given(element, "fill");
            name == "polygon" && fill.starts_with("rgb") && !ink_of(fill))
            return "<polygon" + attribute("style", "fill:" + fill) + " shape-rendering=\"crispEdges\"" +
                   attribute("points", shortened(given(element, "points"))) + "/>";
        if (name == "polygon")
            return "<polygon" + attribute("class", ink_class(given(element, "fill"))) +
                   attribute("points", shortened(given(element, "points"))) + "/>";
        if (name == "use")
            return marker(element);
        if (name == "text")
            return text(element, pen);
        return "";
    }

    std::string group(const Tree& element, const Tree& pen) {
        const std::string inside = children(element, element.count("<xmlattr>") ? element : pen);
        std::string title = element.get("title", std::string());
        // gnuplot's hypertext is the argument of a script: "…(evt,'2 0.1 3.5')".
        if (const std::string script = given(element, "onmousemove"); !script.empty())
            title = told(script.substr(std::min(script.find('\'') + 1, script.size())));
        return inside.empty() || title.empty() || title.starts_with("gnuplot_plot")
                   ? inside
                   : "<g><title>" + escaped(title) + "</title>" + inside + "</g>";
    }

    /// "2 0.1 3.5'…" as "label of series 2: 0.1, 3.5".
    std::string told(const std::string& hypertext) const {
        std::istringstream in(hypertext.substr(0, hypertext.find('\'')));
        std::size_t series = 0;
        std::string x, y;
        if (!(in >> series >> x >> y) || series >= plot_.series.size())
            return "";
        const std::string& label = plot_.series[series].label;
        return (label.empty() ? "" : label + ": ") + x + ", " + y;
    }

    static std::string path(const Tree& element, const Tree& pen) {
        const std::string colour = ink_class(given(element, "stroke"));
        const std::string width = shortened(given(pen, "stroke-width"));
        return "<path" + attribute("class", colour) + attribute("stroke-width", width == "1" ? "" : width) +
               attribute("stroke-dasharray", colour == "grid" ? "" : given(element, "stroke-dasharray")) +
               attribute("d", shortened(given(element, "d"))) + "/>";
    }

    std::string marker(const Tree& element) {
        const std::string reference = given(element, "xlink:href"); // "#gpPt6"
        const std::string number = reference.substr(std::min<std::size_t>(5, reference.size()));
        used_.insert(number);
        return "<use" + attribute("href", "#" + id_ + "m" + number) +
               attribute("class", ink_class(given(element, "color"))) +
               attribute("transform", shortened(given(element, "transform"))) + "/>";
    }

    static std::string text(const Tree& element, const Tree& pen) {
        std::string words = escaped(element.data());
        for (const auto& [name, part] : element)
            if (name == "tspan") {
                const std::string size = given(part, "font-size"), rise = given(part, "dy");
                const std::string look = attribute("font-size", size == "14.0" ? "" : size) +
                                         attribute("dy", shortened(rise.substr(0, rise.find("px"))));
                const bool plain = look.empty() || part.data().empty();
                words +=
                    plain ? escaped(part.data()) : "<tspan" + look + ">" + escaped(part.data()) + "</tspan>";
            }
        if (words.find_first_not_of(' ') == std::string::npos)
            return "";
        const std::string anchor = given(pen, "text-anchor");
        return "<text" + attribute("text-anchor", anchor == "start" ? "" : anchor) +
               attribute("transform", shortened(given(pen, "transform"))) + ">" +
               words.substr(words.find_first_not_of(' ')) + "</text>";
    }

    std::string id_;
    const Plot& plot_;
    std::set<std::string> used_;
};

} // namespace

std::string escaped(std::string_view text) {
    std::string result;
    for (char c : text)
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += c;
        }
    return result;
}

std::string gnuplot_colour(Colour colour) { return inks[static_cast<std::size_t>(colour)].told; }

std::string tidy_svg(const std::string& raw, const Plot& plot, const std::string& id) {
    std::istringstream in(raw);
    Tree tree;
    boost::property_tree::read_xml(in, tree);
    Tidy tidy(id, plot);
    const std::string body = tidy.children(tree.get_child("svg"), {});
    return "<svg class=\"plot\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 480 " +
           short_number(plot.height) + "\" role=\"img\" aria-label=\"" + escaped(plot.alt) + "\">" +
           tidy.markers() + body + "</svg>";
}

const std::string& plot_style() {
    static const std::string style = [] {
        std::string light = ".plot .grid{color:#e3e6e9}.plot{fill:#22262b}";
        std::string dark = ".plot .grid{color:#2c3238}.plot{fill:#e4e6e8}";
        for (const Ink& ink : inks) {
            const std::string rule = std::string(".plot .") + ink.name + "{color:";
            light += rule + ink.light + "}";
            dark += rule + ink.dark + "}";
        }
        return ".plot{font:14px system-ui,sans-serif}"
               ".plot path{fill:none;stroke:currentColor;stroke-linecap:round;stroke-linejoin:round}"
               ".plot use,.plot polygon,.plot circle{fill:currentColor;stroke:none}"
               ".plot .unseen{opacity:0}.plot .unseen:hover{opacity:.4}" +
               light + "@media screen and (prefers-color-scheme:dark){" + dark + "}";
    }();
    return style;
}

std::string svg_file(std::string picture) {
    picture.insert(picture.find('>') + 1, "<style>" + plot_style() + "</style>");
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + picture + "\n";
}

} // namespace app
