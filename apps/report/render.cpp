#include "apps/report/render.hpp"

#include "apps/prompt/units.hpp"
#include "apps/report/csv.hpp"
#include "domain/errors.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/json.hpp"
#include "ga/base/stopwatch.hpp"

#include <charconv>
#include <cmath>
#include <deque>
#include <kainjow/mustache.hpp>

namespace app {
namespace {

using kainjow::mustache::data;
using nlohmann::json;

/// Begins the text of a number with a fraction, which `Context` formats.
constexpr char number_mark = '\x01';

bool holds_objects(const json& value) {
    return value.is_object() && !value.empty() &&
           std::all_of(value.begin(), value.end(), [](const json& one) { return one.is_object(); });
}

/// Maximum number of values that a page shows of one key or table. Each needs at most a kilobyte.
constexpr std::size_t max_shown = 150'000;

std::size_t count_values(const json& value) {
    std::size_t count = 1;
    if (value.is_structured())
        for (const json& one : value) count += count_values(one);
    return count;
}

/// Mustache's data of a value. An empty text and null are false. An object of objects stands a second time as
/// the list `items` of its entries.
data mustache_data(const json& value) {
    if (value.is_object()) {
        data object(data::type::object);
        for (const auto& [key, one] : value.items()) object.set(key, mustache_data(one));
        if (holds_objects(value)) {
            data items(data::type::list);
            for (const auto& [key, one] : value.items()) {
                data item = mustache_data(one);
                item.set("key", key);
                item.set("row", std::to_string(1 + items.list_value().size()));
                items << item;
            }
            object.set("|items", items);
        }
        return object;
    }
    if (value.is_array()) {
        data list(data::type::list);
        for (const json& one : value) {
            data item = mustache_data(one);
            if (item.is_object() && !item.get("row")) item.set("row", std::to_string(1 + list.list_value().size()));
            if (item.is_object()) item.set("more", list.list_value().size() + 1 < value.size());
            list << item;
        }
        return list;
    }
    if (value.is_number_float()) return number_mark + rough::json_text(value, true);
    if (value.is_string() && !value.get_ref<const std::string&>().empty()) return value.get<std::string>();
    return value.is_number() ? data(rough::json_text(value, true)) : data(value.is_boolean() && value.get<bool>());
}

std::optional<double> number_in(const std::string& text) {
    const char* const begin = text.data() + text.starts_with(number_mark);
    const char* const end = text.data() + text.size();
    double value = 0;
    const auto parsed = std::from_chars(begin, end, value);
    return parsed.ec == std::errc() && parsed.ptr == end && begin != end ? std::optional(value) : std::nullopt;
}

/// A table as a list of rows; whole numbers stay as written.
json table_json(const std::filesystem::path& file) {
    json table = json::array();
    const auto rows = csv_rows(rough::read_whole(file));
    for (std::size_t r = 1; r < rows.size(); ++r) {
        json row = json::object();
        for (std::size_t c = 0; c < std::min(rows[0].size(), rows[r].size()); ++c) {
            const std::string& cell = rows[r][c];
            const auto number = number_in(cell);
            const bool whole = cell.find_first_not_of("-0123456789") == std::string::npos;
            row[rows[0][c]] = number && !whole ? json(*number) : json(cell);
        }
        table.push_back(std::move(row));
    }
    return table;
}

/// The text of a template or script: the user's if --templates has it, else the built-in one.
std::string file_text(const std::string& name, const Rendering& rendering) {
    if (!rendering.templates.empty() && !std::filesystem::is_directory(rendering.templates))
        rough::refuse("--templates: '", rendering.templates.string(), "' is not a folder; give one");
    if (!rendering.templates.empty() && std::filesystem::exists(rendering.templates / name))
        return rough::read_whole(rendering.templates / name);
    const auto found = builtin_files().find(name);
    if (found == builtin_files().end())
        rough::refuse("report: ", name, " was not found; choose a folder of --templates that has it");
    return found->second;
}

/// The script of a figure, "NAME" or "NAME:ARGUMENT".
FigureScript figure_script(const std::string& figure, const std::string& name, const PageSource& source,
                           const Rendering& rendering) {
    const std::size_t colon = std::min(figure.find(':'), figure.size());
    return {.script = file_text(figure.substr(0, colon) + ".gp", rendering),
            .style = file_text("style.gp", rendering),
            .folder = source.folder,
            .prefix = source.prefix,
            .argument = figure.substr(std::min(colon + 1, figure.size())),
            .name = name,
            .seconds = rendering.seconds};
}

/// The number in a filter of a tag, within a range.
double argument_of(const std::string& filter, const std::string& argument, double from, double to) {
    const auto number = number_in(argument);
    if (!number || *number < from || *number > to)
        rough::refuse("report: filter '", filter, "' of a template; use a filter of the reference, with a number",
                      std::isinf(to) ? "" : " from 1 to 17");
    return *number;
}

/// A path as an address of a link: characters that mean something else there are written by their numbers.
std::string address(const std::string& path) {
    std::string text = path.find(':') < path.find('/') ? "./" : "";
    for (const char c : path)
        if (std::isalnum(static_cast<unsigned char>(c)) ||
            std::string_view("-._~/:").find(c) != std::string_view::npos) {
            text += c;
        } else {
            char number[4];
            std::snprintf(number, sizeof number, "%%%02X", static_cast<unsigned char>(c));
            text += number;
        }
    return text;
}

/// The values that a page's tags name.
class Context : public kainjow::mustache::context<std::string> {
  public:
    Context(const json& values, const PageSource& source, const Rendering& rendering)
        : values_(values), source_(source), rendering_(rendering) {
        push(&root_);
    }

    const data* get(const std::string& name) const override {
        const std::size_t bar = name.find('|');
        const std::string key = name.substr(0, bar);
        const std::string filter = bar == std::string::npos ? "" : name.substr(bar + 1);
        const data* value = key.starts_with("figures.")  ? figure(key.substr(8))
                            : key.starts_with("tables.") ? table(key.substr(7))
                                                         : plain(key);
        if (!value) // a key of null is null
            if (const data* const of = plain(key.substr(0, key.rfind('.'))); of && of->is_false()) value = of;
        if (!value) {
            if (rendering_.missing) rendering_.missing->insert(name);
            return nullptr;
        }
        if (filter == "items") return value->get("|items");
        if (filter == "some") return value->is_false() || value->is_empty_list() ? nullptr : kept(data(true));
        if (filter == "count") return kept(data(std::to_string(value->is_list() ? value->list_value().size() : 1)));
        if (filter == "by") {
            std::string sides;
            for (const data& side : value->is_list() ? value->list_value() : kainjow::mustache::list{*value})
                if (side.is_string())
                    sides +=
                        (sides.empty() ? "" : " x ") +
                        filtered(side.string_value(), side.string_value().starts_with(number_mark) ? "brief:6" : "")
                            .string_value();
            return kept(data(sides));
        }
        return value->is_string() ? kept(filtered(value->string_value(), filter)) : value;
    }

    const data* get_partial(const std::string& name) const override {
        if (++partials_ > max_partials)
            rough::refuse(name, ": more than ", max_partials,
                          " templates are included in one page; a template must not include itself");
        const bool is_whole = name.find('.') != std::string::npos; // "draw.js"
        return kept(data(file_text(is_whole ? name : name + ".mustache", rendering_)));
    }

  private:
    static constexpr int max_partials = 500; ///< a template that includes itself would exhaust the stack

    const data* kept(data value) const { return &made_.emplace_back(std::move(value)); }
    /// A value in the open sections, or of the page. Those of the page become data when a tag names them.
    const data* plain(const std::string& key) const {
        const std::string first = key.substr(0, key.find('.'));
        if (!root_.get(first) && values_.is_object() && values_.contains(first))
            root_.set(first, shown(values_.at(first), first));
        return kainjow::mustache::context<std::string>::get(key);
    }
    static data shown(const json& value, const std::string& name) {
        if (count_values(value) > max_shown)
            rough::refuse("report: ", name, " has more than ", max_shown, " values; show fewer in the template");
        return mustache_data(value);
    }

    const data* table(const std::string& name) const {
        if (const auto known = tables_.find(name); known != tables_.end()) return known->second;
        const auto file = source_.folder / (source_.prefix + name + ".csv");
        return tables_[name] = std::filesystem::exists(file) ? kept(shown(table_json(file), name + ".csv")) : nullptr;
    }

    const data* figure(const std::string& name) const {
        std::string shown = name;
        const std::size_t colon = name.find(':');
        if (const std::size_t at = name.find('@', std::min(colon, name.size())); at != std::string::npos) {
            const data* const value = get(name.substr(at + 1));
            shown = name.substr(0, at) + (value && value->is_string() ? value->string_value() : "");
        }
        FigureScript script = figure_script(shown, "figure" + std::to_string(++figures_), source_, rendering_);
        script.seconds -= clock_.seconds();
        return kept(data(rendering_.seconds > 0 ? figure_svg(script) : ""));
    }

    static data filtered(const std::string& text, const std::string& filter) {
        const std::string word = filter.substr(0, filter.find(':'));
        const std::string argument = word == filter ? "" : filter.substr(word.size() + 1);
        if (word == "is") return ("," + argument + ",").find("," + text + ",") != std::string::npos;
        if (word == "address") return address(text);
        const auto number = number_in(text);
        if (!number || (filter.empty() && text.front() != number_mark)) return text;
        const auto digits = [&](int usual) {
            return argument.empty() ? usual : static_cast<int>(argument_of(filter, argument, 1, 17));
        };
        const auto in_unit = [&](const Unit& unit) {
            return readable(unit.factor * *number, digits(3)) + " " + unit.name;
        };
        if (word == "above" || word == "below") {
            const double limit = argument_of(filter, argument, -HUGE_VAL, HUGE_VAL);
            return word == "above" ? *number > limit : *number < limit;
        }
        if (word == "length") return in_unit(length_unit(*number));
        if (word == "pressure") return in_unit(pressure_unit(*number));
        if (word == "error") return percent(1 - *number, digits(2));
        if (word == "percent") return percent(*number, digits(3));
        if (word == "brief") return brief(*number, digits(2));
        return readable(*number, word.empty() ? 3 : static_cast<int>(argument_of(filter, word, 1, 17)));
    }

    const json& values_;
    mutable data root_{data::type::object};
    const PageSource& source_;
    const Rendering& rendering_;
    mutable std::deque<data> made_; ///< keeps addresses
    mutable std::map<std::string, const data*> tables_;
    mutable int figures_ = 0, partials_ = 0;
    ga::Stopwatch clock_;
};

std::string rendered(const std::string& name, kainjow::mustache::basic_context<std::string>& context,
                     const Rendering& rendering) {
    kainjow::mustache::mustache page(file_text(name, rendering));
    const std::string text = page.is_valid() ? page.render(context) : "";
    if (!page.is_valid()) rough::refuse(name, ": ", page.error_message(), "; correct the template");
    return text;
}

/// The headings of a page that can be linked to, with their ids.
json sections_of(const std::string& body) {
    json sections = json::array();
    const std::string begin = "<h2 id=\"";
    for (std::size_t at = body.find(begin); at != std::string::npos; at = body.find(begin, at + 1)) {
        const std::size_t id = at + begin.size(), quote = body.find('"', id), text = body.find('>', quote) + 1;
        sections.push_back(
            {{"id", body.substr(id, quote - id)}, {"heading", body.substr(text, body.find("</h2>", text) - text)}});
    }
    return sections;
}

/// Whether a result is that of a free map whose nodes stand on its edges, as in versions before 0.3.
bool has_nodes_on_edges(const json& result) {
    const std::string version = rough::json_text(result.value("version", json()), true);
    return result.value("nodes", json()).is_array() && result.value("kernel", json()) == "free" &&
           (version.starts_with("\"0.1.") || version.starts_with("\"0.2."));
}

} // namespace

std::string render(const PageSource& source, const Rendering& rendering) {
    const std::string kind = source.values.value("kind", "");
    Context context(source.values, source, rendering);
    const std::string body = rendered(kind + ".mustache", context, rendering);
    // The contents stand between the head of the page and its first section.
    const std::size_t title = body.find("<h1>"), first = std::min(body.find("<h2"), body.size());
    const json layout = {
        {"title", title == std::string::npos ? kind : body.substr(title + 4, body.find("</h1>", title) - title - 4)},
        {"sections", sections_of(body)},
        {"nodes_on_edges", has_nodes_on_edges(source.values)},
        {"head", body.substr(0, first)},
        {"body", body.substr(first)}};
    Context around(layout, source, rendering);
    return rendered("layout.mustache", around, rendering);
}

std::string figure_file(const std::string& figure, const PageSource& source, const Rendering& rendering) {
    return figure_document(figure_script(figure, "figure", source, rendering));
}

PageSource page_source(const std::filesystem::path& place) {
    const bool is_file = std::filesystem::is_regular_file(place);
    std::filesystem::path file = is_file ? place : place / "result.json";
    for (const char* name : {"profile.json", "surface.json"})
        if (!std::filesystem::exists(file) && std::filesystem::exists(place / name)) file = place / name;
    PageSource source{rough::parsed_json(rough::read_whole(file), file.string()), is_file ? place.parent_path() : place,
                      is_file ? place.stem().string() + "-" : ""};
    const json kind = source.values.is_object() ? source.values.value("kind", json()) : json();
    if (!kind.is_string() ||
        kind.get<std::string>().find_first_not_of("abcdefghijklmnopqrstuvwxyz-") != std::string::npos)
        rough::refuse(file.string(), ": kind is missing or is not a kind of result; run the command again");
    return source;
}

std::filesystem::path page_of(const PageSource& source) {
    if (!source.prefix.empty()) return source.folder / (source.prefix.substr(0, source.prefix.size() - 1) + ".html");
    const std::string kind = source.values["kind"];
    return source.folder / ((kind == "chart" || kind == "stability" ? kind : "report") + ".html");
}

} // namespace app
