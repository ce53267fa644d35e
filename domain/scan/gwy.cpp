#include "domain/errors.hpp"
#include "domain/scan/map.hpp"
#include "domain/text/bytes.hpp"

#include <cmath>
#include <map>

namespace rough {
namespace {

/// A typed value of a Gwyddion object. An object's bytes are those of its items.
struct Item {
    char type;
    std::string_view bytes;
};
using Items = std::map<std::string, Item, std::less<>>;

/// Reads names, sizes and values one after another.
class Cursor {
  public:
    Cursor(std::string_view bytes, const std::string& file) : rest_(bytes), file_(file) {}
    bool done() const { return rest_.empty(); }
    std::string_view take(std::size_t size) {
        if (size > rest_.size()) refuse(file_, ": the Gwyddion file ends early; save it again");
        const std::string_view taken = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return taken;
    }
    std::uint32_t count() { return little_endian<std::uint32_t>(take(4), 0); }
    /// A text up to its zero byte.
    std::string_view name() {
        const std::string_view text = take(std::min(rest_.find('\0'), rest_.size()));
        take(1);
        return text;
    }
    std::string_view object() { return name(), take(count()); }
    /// A value of a type. Types in upper case are arrays, with their length before them.
    std::string_view value(char type) {
        if (type == 's') return name();
        if (type == 'o') return object();
        if (type == 'S' || type == 'O') {
            const std::string_view whole = rest_;
            for (std::uint32_t left = count(); left > 0; --left) value(type == 'S' ? 's' : 'o');
            return whole.substr(0, whole.size() - rest_.size());
        }
        constexpr std::string_view types = "bciqdCIQD";
        constexpr std::size_t sizes[] = {1, 1, 4, 8, 8, 1, 4, 8, 8};
        const std::size_t at = types.find(type);
        if (at == types.npos) refuse(file_, ": a value of type '", type, "' in the Gwyddion file; save it again");
        return take(sizes[at] * (at < 5 ? 1 : count()));
    }

  private:
    std::string_view rest_;
    const std::string& file_;
};

Items items_of(std::string_view object, const std::string& file) {
    Items items;
    for (Cursor at(object, file); !at.done();) {
        const std::string name(at.name());
        const char type = at.take(1)[0];
        items[name] = {type, at.value(type)};
    }
    return items;
}

/// The bytes of an item of a type; none if it does not exist.
std::string_view bytes_of(const Items& items, std::string_view name, char type) {
    const auto found = items.find(name);
    return found != items.end() && found->second.type == type ? found->second.bytes : std::string_view{};
}

/// The unit in an item of type GwySIUnit; nothing if it is not a length.
std::optional<LengthUnit> unit_of(const Items& field, std::string_view name, const std::string& file) {
    return length_unit(bytes_of(items_of(bytes_of(field, name, 'o'), file), "unitstr", 's'));
}

double number_of(const Items& field, std::string_view name, char type) {
    const std::string_view bytes = bytes_of(field, name, type);
    if (bytes.empty()) return 0;
    return type == 'i' ? little_endian<std::int32_t>(bytes, 0) : little_endian<double>(bytes, 0);
}

} // namespace

HeightMap read_gwy(const std::string& bytes, const std::string& file) {
    Cursor top(std::string_view(bytes).substr(4), file);
    const Items items = items_of(top.object(), file);
    // "/0/data", "/1/data", … are fields; the first one in metres is the topography.
    int channel = 0, fields = 0;
    for (int k = 999; k >= 0; --k)
        if (const auto field = bytes_of(items, "/" + std::to_string(k) + "/data", 'o'); !field.empty())
            if (unit_of(items_of(field, file), "si_unit_z", file)) channel = k, ++fields;
    if (fields == 0) refuse(file, ": a Gwyddion file without heights in a length unit; save a topography");
    const std::string place = "/" + std::to_string(channel) + "/";
    const Items field = items_of(bytes_of(items, place + "data", 'o'), file);
    const double columns = number_of(field, "xres", 'i'), width = number_of(field, "xreal", 'd'),
                 length = number_of(field, "yreal", 'd');
    HeightMap map{"Gwyddion (GWY)" + (fields > 1 ? ", the first of " + std::to_string(fields) + " fields" : "")};
    map.rows = static_cast<Index>(number_of(field, "yres", 'i'));
    map.height_unit = *unit_of(field, "si_unit_z", file);
    const auto lateral = unit_of(field, "si_unit_xy", file);
    if (!lateral || !(width > 0 && length > 0))
        refuse(file, ": a Gwyddion field without sizes in a length unit; save it again");
    expect_points(static_cast<std::int64_t>(columns), map.rows, file);
    map.spacing = width / columns * lateral->in_mm;
    map.row_spacing = length / static_cast<double>(map.rows) * lateral->in_mm;
    const auto nodes = static_cast<std::int64_t>(columns) * map.rows;
    map.heights = stored_numbers(bytes_of(field, "data", 'D'), nodes, 7, std::nan(""), file);
    if (const auto mask = bytes_of(items, place + "mask", 'o'); !mask.empty()) {
        const auto marks = stored_numbers(bytes_of(items_of(mask, file), "data", 'D'), nodes, 7, std::nan(""), file);
        map.heights = (marks.array() >= 0.5).select(std::nan(""), map.heights);
        map.format += ", points under its mask missing";
    }
    return map;
}

} // namespace rough
