#include "apps/prompt/settings.hpp"

#include "domain/text/atomic_file.hpp"
#include "ga/text/nearest.hpp"

#include <boost/program_options.hpp>

#include <set>

namespace app {

namespace po = boost::program_options;
using rough::InputError;

namespace {

constexpr const char* too_many = "words too many";
constexpr std::size_t max_ini_bytes = 1'000'000, max_ini_name = 200; // each key is stored with its section

po::options_description options_of(const std::vector<Setting>& known, const std::string& heading = "") {
    po::options_description options(heading);
    for (const auto& setting : known) {
        std::string meaning = setting.meaning;
        if (!setting.is_switch && !setting.fallback.empty()) meaning += " [" + setting.fallback + "]";
        if (setting.is_switch)
            options.add_options()(setting.name.c_str(), meaning.c_str());
        else
            options.add_options()(setting.name.c_str(), po::value<std::string>()->value_name("X"), meaning.c_str());
    }
    return options;
}

/// Whether a setting may be given several times: its values are lines.
bool repeats(const std::vector<Setting>& known, const std::string& name) {
    return std::ranges::any_of(known,
                               [&](const Setting& setting) { return setting.name == name && setting.between == '\n'; });
}

std::map<std::string, std::string> values_of(const po::parsed_options& parsed, const std::vector<Setting>& known) {
    std::map<std::string, std::string> values;
    for (const auto& option : parsed.options) {
        const std::string value = option.value.empty() ? "on" : option.value.front();
        if (value.empty()) rough::refuse("--", option.string_key, ": \"\" given; give a value");
        const auto [before, is_first] = values.emplace(option.string_key, value);
        if (!is_first && !repeats(known, option.string_key))
            rough::refuse("--", option.string_key, ": given twice; give it once");
        if (!is_first) before->second += "\n" + value;
    }
    return values;
}

struct Ini {
    std::map<std::string, std::string> values; ///< keys are section.key
    std::map<std::string, int> lines;
};

/// Boost reads each line after that of its section, so that a message can name the line.
Ini parsed_ini(const std::filesystem::path& file) {
    Ini ini;
    std::string section;
    std::istringstream in(rough::read_whole(file, max_ini_bytes));
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) { // the bytes of file names stay as they are
        if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
        const std::string_view text = rough::trim(line);
        const std::string place = file.string() + ":" + std::to_string(number) + ": ";
        if (text.substr(0, text.find('=')).size() > max_ini_name)
            rough::refuse(place, "a name of more than ", max_ini_name, " characters; use a shorter one");
        std::istringstream one(section + "\n" + line);
        try {
            for (const auto& option : po::parse_config_file(one, po::options_description(), true).options) {
                if (!ini.values.emplace(option.string_key, rough::trim(option.value.front())).second)
                    rough::refuse(place, option.string_key, ": given twice; give it once");
                ini.lines[option.string_key] = number;
            }
        } catch (const po::error&) {
            rough::refuse(place, "\"", text.substr(0, 60),
                          "\" is not a line of an .ini file; write [section] or key = value");
        }
        if (text.starts_with('[')) section = line;
    }
    return ini;
}

/// The suggestion for an unknown key: the nearest name, else the keys of its section, else the sections.
std::string key_suggestion(const std::string& name, const std::vector<std::string>& names) {
    const std::string near = ga::suggestion(name, names), section = name.substr(0, name.find('.')) + ".";
    if (near.find("did you mean") != std::string::npos) return near;
    std::set<std::string> keys, sections;
    for (const std::string& key : names) {
        sections.insert(key.substr(0, key.find('.') + 1) + "*");
        if (key.starts_with(section)) keys.insert(key);
    }
    const auto& listed = keys.empty() ? sections : keys;
    return ga::suggestion("", {listed.begin(), listed.end()});
}

} // namespace

Setting::Setting(std::string called, std::string otherwise, std::string line, bool switched)
    : name(std::move(called)), fallback(std::move(otherwise)), meaning(std::move(line)), is_switch(switched) {}

Setting::Setting(const ga::Parameter& parameter)
    : Setting(parameter.name, parameter.standard.value_or(""), parameter.meaning) {
    takes = parameter;
}

Setting Setting::several(char parts) const {
    Setting copy = *this;
    copy.between = parts;
    return copy;
}

Setting Setting::of(std::vector<std::string> words) const {
    Setting copy = *this;
    copy.choices = std::move(words);
    for (const std::string& word : copy.choices)
        copy.meaning += (word == copy.choices.front() ? "; one of " : ", ") + word;
    return copy;
}

Setting seed_setting() { return whole("seed", "1", 0, 0x1p53, "seed of the random numbers"); }
Setting threads_setting() {
    return whole("threads", "0", 0, 1024,
                 "threads, or 0 for all; a profile's curve uses one, a map's all that are free");
}
Setting force_setting() { return {"force", "", "write over an existing result", true}; }
Setting pictures_setting() {
    return Setting("pictures", "on", "off omits the page and its pictures").of({"on", "off"});
}
Setting whole(const std::string& name, const std::string& fallback, double lower, double upper,
              const std::string& meaning) {
    return ga::whole(name, fallback, lower, meaning).up_to(upper);
}

Setting positive(const std::string& name, const std::string& fallback, const std::string& meaning) {
    return ga::number(name, fallback, ga::above_zero, ga::no_limit, meaning);
}

Setting pressure(const std::string& name, const std::string& fallback, const std::string& meaning) {
    return ga::number(name, fallback, ga::above_zero, 1e100, meaning);
}

Setting max_pressure_setting(const std::string& prefix, const std::string& fallback) {
    return pressure(prefix + "max-pressure", fallback,
                    "mean pressure at the last load step, to which every genome is rescaled (Eq. 11), MPa" +
                        std::string(fallback.empty() ? " [amplitude is a gene]" : ""));
}

std::vector<Setting> settings_of(const Bindings& bindings, const std::string& prefix, const std::string& group) {
    std::vector<Setting> all;
    for (const Binding& binding : bindings) {
        all.push_back(binding.setting);
        all.back().name = prefix + binding.setting.name;
        all.back().group = group;
    }
    return all;
}

void take(const Settings& settings, const Bindings& bindings, const std::string& prefix) {
    for (const Binding& binding : bindings) binding.take(settings, prefix + binding.setting.name);
}

std::string keyword(std::string name) {
    std::ranges::replace(name, '-', '_');
    return name;
}

Settings::Settings(std::string source, std::vector<Setting> known, std::map<std::string, std::string> given,
                   std::map<std::string, int> lines)
    : source_(std::move(source)), given_(std::move(given)), lines_(std::move(lines)) {
    for (auto& setting : known) known_.emplace(setting.name, setting);
    for (const auto& [name, value] : given_) check(name);
}

/// Unknown names are refused elsewhere.
void Settings::check(const std::string& name) const {
    const auto setting = known_.find(name);
    if (setting == known_.end() || text(name).empty()) return;
    if (setting->second.is_switch)
        is_on(name);
    else if (!setting->second.choices.empty())
        choice(name);
    else if (!setting->second.takes.is_text())
        numbers(name);
}

std::string Settings::place(const std::string& name) const {
    if (source_.empty()) return "--" + name.substr(name.find('.') + 1); // an experiment's key by its short name's flag
    if (source_ == keywords) return keyword(name);
    const auto line = lines_.find(name);
    return source_ + (line == lines_.end() ? "" : ":" + std::to_string(line->second)) + ": " + name;
}

const std::string& Settings::text(const std::string& name) const {
    const auto found = given_.find(name);
    return found != given_.end() ? found->second : known_.at(name).fallback;
}

bool Settings::is_on(const std::string& name) const {
    const std::string& value = text(name);
    if (value == "on" || value == "yes" || value == "true" || value == "1") return true;
    if (value.empty() || value == "off" || value == "no" || value == "false" || value == "0") return false;
    refuse(name, "\"", value, "\" given; give on or off");
}

double Settings::number_in(const std::string& name, const std::string& word) const {
    const ga::Parameter& range = known_.at(name).takes;
    const double value = rough::number_from(word, place(name));
    if (!range.is_text() && !range.allows(value)) refuse(name, word, " is out of range (", range.expected(true), ")");
    return value;
}

double Settings::number(const std::string& name) const { return number_in(name, text(name)); }

std::vector<double> Settings::numbers(const std::string& name) const {
    std::vector<double> all;
    const auto given = words(name);
    if (known_.at(name).between == 'x' && given.size() > 2)
        refuse(name, "'", text(name), "' given; give two numbers with an x between, as in 64x48");
    for (const std::string& word : given) all.push_back(number_in(name, word));
    return all;
}

std::vector<std::string> Settings::words(const std::string& name) const {
    const char between = known_.at(name).between;
    if (between == ',') return rough::listed(text(name));
    std::vector<std::string> all;
    std::istringstream in(text(name).empty() ? "" : text(name) + between);
    for (std::string word; std::getline(in, word, between);) all.push_back(word);
    return all;
}

std::size_t Settings::choice(const std::string& name) const { return one_of(name, known_.at(name).choices); }

std::filesystem::path Settings::beside(const std::string& name, const std::string& word) const {
    return lines_.count(name) ? std::filesystem::path(source_).parent_path() / word : std::filesystem::path(word);
}

std::vector<std::filesystem::path> Settings::paths(const std::string& name) const {
    std::vector<std::filesystem::path> all;
    for (const std::string& word : rough::listed(text(name))) all.push_back(beside(name, word));
    return all;
}

std::vector<std::filesystem::path> Settings::files() const {
    std::vector<std::filesystem::path> all;
    std::error_code error;
    for (const auto& [name, value] : given_)
        if (name != "out" && name != "report" && name != "draw" && name != "history")
            for (const auto& path : paths(name))
                if (std::filesystem::is_regular_file(path, error)) all.push_back(path);
    return all;
}

std::size_t Settings::one_of(const std::string& name, const std::vector<std::string>& words) const {
    const auto found = std::ranges::find(words, text(name));
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    refuse(name, "\"", text(name), "\" given", ga::suggestion(text(name), words));
}

std::vector<std::pair<std::string, std::string>> Settings::texts_under(const std::string& prefix) const {
    std::vector<std::pair<std::string, std::string>> texts;
    for (const auto& [name, value] : given_)
        if (const auto text = rough::trim(value); name.starts_with(prefix) && !text.empty())
            texts.emplace_back(name.substr(prefix.size()), text);
    return texts;
}

Settings read_command_line(const std::vector<std::string>& given, const std::vector<Setting>& known,
                           const std::vector<std::string>& positional) {
    std::vector<std::string> words = given;
    for (const Setting& setting : known)
        for (std::size_t i = 0; i < words.size(); ++i)
            if (!setting.alone.empty() && words[i] == "--" + setting.name &&
                (i + 1 == words.size() || words[i + 1].starts_with("--")))
                words[i] += "=" + setting.alone;
    po::options_description with_words = options_of(known);
    with_words.add_options()(too_many, po::value<std::string>());
    po::positional_options_description places;
    for (const auto& name : positional) places.add(name.c_str(), repeats(known, name) ? -1 : 1);
    if (positional.empty() || !repeats(known, positional.back())) places.add(too_many, -1);
    namespace style = po::command_line_style;
    try {
        const auto parsed = po::command_line_parser(words)
                                .options(with_words)
                                .positional(places)
                                .style(style::allow_long | style::long_allow_adjacent | style::long_allow_next)
                                .run();
        for (const auto& option : parsed.options)
            if (option.string_key == too_many)
                rough::refuse("'", option.value.front(), "' given; give ",
                              positional.empty() ? "flags only" : "one " + positional.front() + " and flags only");
        return {"", known, values_of(parsed, known)};
    } catch (const po::unknown_option& error) {
        std::string name = error.get_option_name();
        name.erase(0, name.find_first_not_of('-'));
        std::vector<std::string> flags{"--help", "--quiet", "--verbose"};
        for (const Setting& setting : known) flags.push_back("--" + setting.name);
        rough::refuse("--", name, ": unknown flag", ga::suggestion("--" + name, flags));
    } catch (const po::invalid_command_line_syntax& error) {
        rough::refuse(error.get_option_name(), error.kind() == error.extra_parameter ? ": takes no value; omit it"
                                                                                     : ": lacks its value; give one");
    } catch (const po::error& error) {
        throw InputError(error.what());
    }
}

Settings read_ini(const std::filesystem::path& file, const std::vector<Setting>& known,
                  const std::vector<std::string>& overrides) {
    auto [values, lines] = file.empty() ? decltype(parsed_ini(file)){} : parsed_ini(file);
    for (const auto& override_text : overrides) {
        const auto equals = override_text.find('=');
        if (equals == std::string::npos || equals == 0)
            rough::refuse("--set: \"", override_text, "\" given; give section.key=value");
        const std::string name = override_text.substr(0, equals);
        values[name] = override_text.substr(equals + 1);
        lines.erase(name);
    }
    const auto names = names_of(known);
    const Settings settings(file.string(), known, values, lines);
    for (const auto& [name, value] : values) {
        const auto is_known = [&](const std::string& key) { return std::ranges::count(names, key) > 0; };
        if (!is_known(name) && !is_known(name.substr(0, name.find('.')) + ".*") && !is_known("*")) {
            const std::string place = settings.place(name);
            rough::refuse(file.empty() ? "--set: " : place.substr(0, place.size() - name.size()), "unknown key '", name,
                          "'", key_suggestion(name, names));
        }
    }
    return settings;
}

Settings Settings::with(const std::map<std::string, std::string>& values, const std::vector<Setting>& described) const {
    Settings changed = *this;
    for (const Setting& setting : described) changed.known_.insert_or_assign(setting.name, setting);
    for (const auto& [name, value] : values)
        if (value.empty())
            changed.given_.erase(name);
        else
            changed.given_[name] = value;
    return changed;
}

std::vector<Setting> joined(const std::vector<std::vector<Setting>>& lists) {
    std::vector<Setting> all;
    for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
    return all;
}

void expect_none(const Settings& settings, const std::vector<std::string>& names, const std::string& problem) {
    for (const std::string& name : names)
        if (settings.given(name)) settings.refuse(name, problem);
}

void expect_in_order(const Settings& settings, const std::vector<std::string>& names) {
    for (const std::string& name : names)
        if (settings.number(name + "-from") > settings.number(name + "-to"))
            settings.refuse(name + "-from", settings.text(name + "-from"), " is above ", settings.place(name + "-to"),
                            ": ", settings.text(name + "-to"), "; give a lower bound that is not above the upper one");
}

std::string the_given(const Settings& settings, const std::vector<std::string>& names, const std::string& what) {
    std::string found, flags;
    int count = 0;
    for (const std::string& name : names) {
        flags += (flags.empty() ? "" : ", ") + settings.place(name);
        if (settings.has(name) && ++count == 1) found = name;
    }
    if (count != 1) rough::refuse(what, ": not exactly one of ", flags, " is given; give one of them");
    return found;
}

std::string placed(const Settings& settings, const std::string& prefix, const rough::InputError& error) {
    const std::string line = error.what();
    std::string name = prefix + error.about;
    std::ranges::replace(name, ' ', '-');
    if (error.about.empty() || !settings.knows(name)) return line;
    const std::string rest = line.starts_with(error.about + ": ") ? line.substr(error.about.size() + 2) : line;
    return settings.place(name) + ": " + rest;
}

std::string described(const std::vector<Setting>& known) {
    std::vector<std::string> groups; // in the order of their first settings
    std::map<std::string, std::vector<Setting>> members;
    for (const Setting& setting : known)
        if (!setting.meaning.empty()) {
            if (!members.contains(setting.group)) groups.push_back(setting.group);
            members[setting.group].push_back(setting);
        }
    rough::PlainStream out;
    for (const std::string& group : groups)
        out << (group == groups.front() ? "" : "\n") << options_of(members[group], group.empty() ? "Flags" : group);
    return out.str();
}

} // namespace app
