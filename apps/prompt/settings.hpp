#pragma once

#include "domain/errors.hpp"
#include "ga/base/errors.hpp"
#include "ga/pipeline/parameters.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

namespace app {

/// A parameter that a user may set: a flag of a command, a key of an experiment, a keyword of Python.
struct Setting {
    std::string name;       ///< flag without its dashes, or section.key
    std::string fallback;   ///< what it is if not given; "" is nothing
    std::string meaning;    ///< one line, with the unit; "" leaves it out of the help page
    bool is_switch = false; ///< a flag without a value
    std::string group = {}; ///< heading in the help page; "" for the command's own
    /// What may be given, which is checked when settings are read: any words, or a number in a range.
    ga::Parameter takes = ga::word_list({}, {});
    std::vector<std::string> choices = {}; ///< one of these words, where there are any
    std::string alone = {};                ///< what a flag without a value stands for; "": it needs one
    char between = 0; ///< parts several values: ',', 'x' of a pair along x and y, a line's end; 0: one value

    Setting(std::string name, std::string fallback, std::string meaning, bool is_switch = false);
    Setting(const ga::Parameter& parameter); ///< one that ga::number or ga::whole describes
    /// The same with several values, so parted.
    Setting several(char between = ',') const;
    /// The same for these words alone.
    Setting of(std::vector<std::string> words) const;
};

///@{
/// Parameters that several commands have, and a number above 0.
Setting seed_setting();
Setting threads_setting();
Setting force_setting();
Setting pictures_setting();
Setting positive(const std::string& name, const std::string& fallback, const std::string& meaning);
/// A pressure (MPa) whose squares fit double precision.
Setting pressure(const std::string& name, const std::string& fallback, const std::string& meaning);
///@}

/// A setting's name as Python has it: strip_width.
std::string keyword(std::string name);

/// Values by name. The constructor and every reader throw rough::InputError naming the setting, what was
/// given and what was expected.
class Settings {
  public:
    static constexpr const char* keywords = "()";
    /// `source` is an .ini file, "" for a command line or `keywords` for a call in Python; `lines` are those
    /// of the file, by name, of what was not given on the command line.
    Settings(std::string source, std::vector<Setting> known, std::map<std::string, std::string> given,
             std::map<std::string, int> lines = {});

    bool knows(const std::string& name) const { return known_.count(name) > 0; }
    bool given(const std::string& name) const { return given_.count(name) > 0; }
    bool has(const std::string& name) const { return !text(name).empty(); }
    const std::string& text(const std::string& name) const;
    bool is_on(const std::string& name) const;
    double number(const std::string& name) const;
    /// Of a setting with several values.
    std::vector<double> numbers(const std::string& name) const;
    std::vector<std::string> words(const std::string& name) const;
    /// The place of its word among the setting's choices.
    std::size_t choice(const std::string& name) const;
    /// Sets a value to what stands for the setting, if anything does; an enumeration, or a bool that is no
    /// switch, by the place among the setting's choices.
    template <class Value>
    void take(const std::string& name, Value& value) const {
        if (!has(name))
            return;
        if constexpr (std::is_same_v<Value, bool>)
            value = known_.at(name).is_switch ? is_on(name) : choice(name) > 0;
        else if constexpr (std::is_same_v<Value, std::string>)
            value = text(name);
        else if constexpr (std::is_same_v<Value, std::vector<double>>)
            value = numbers(name);
        else if constexpr (std::is_enum_v<Value>)
            value = static_cast<Value>(choice(name));
        else
            value = static_cast<Value>(number(name));
    }
    /// Of a setting that takes whole numbers.
    template <class Whole = long>
    Whole whole(const std::string& name) const {
        return static_cast<Whole>(number(name));
    }
    /// A file: as given on the command line, or beside the .ini that names it.
    std::filesystem::path path(const std::string& name) const { return beside(name, text(name)); }
    /// The same of several, with commas between.
    std::vector<std::filesystem::path> paths(const std::string& name) const;
    std::size_t one_of(const std::string& name, const std::vector<std::string>& words) const;

    /// Every file that is there and that a value names, but those of --out and --report: those that are read.
    std::vector<std::filesystem::path> files() const;

    /// "--nodes", of a call in Python "nodes", "paper.ini:12: model.nodes" or, where no line of the file
    /// gives it, "paper.ini: model.nodes"; for messages.
    std::string place(const std::string& name) const;
    /// Throws rough::InputError that begins with the place of a setting.
    [[noreturn]] void refuse(const std::string& name, const std::string& problem) const;
    /// The same with some values changed; "" takes one away. Some settings may be described anew.
    Settings with(const std::map<std::string, std::string>& values,
                  const std::vector<Setting>& described = {}) const;
    /// The names given whose beginning is `prefix`, without it, in alphabetical order.
    std::vector<std::string> names_under(const std::string& prefix) const;
    /// The same names with what stands for them, as those of variants with their pipelines; "" takes one
    /// away.
    std::vector<std::pair<std::string, std::string>> texts_under(const std::string& prefix) const;

  private:
    std::filesystem::path beside(const std::string& name, const std::string& word) const;
    /// The number that a word is. Throws rough::InputError on one that the setting's range does not hold.
    double number_in(const std::string& name, const std::string& word, const ga::Parameter& range) const;
    void check(const std::string& name) const;

    std::string source_;
    std::map<std::string, Setting> known_;
    std::map<std::string, std::string> given_;
    std::map<std::string, int> lines_; ///< of the file
};

/// A parameter with the place of its value: where the set-up of a command keeps it.
struct Field {
    Setting setting;
    std::function<void(const Settings&, const std::string& name)> take; ///< into the value

    template <class Value>
    Field(Setting described, Value& value)
        : setting(std::move(described)),
          take([&value](const Settings& settings, const std::string& name) { settings.take(name, value); }) {}
};
using Fields = std::vector<Field>;
/// Their settings, each name behind `prefix`, under a heading of the help page.
std::vector<Setting> settings_of(const Fields& fields, const std::string& prefix = "",
                                 const std::string& group = "");
/// Sets the values of those that were given, or that have a fallback.
void take(const Settings& settings, const Fields& fields, const std::string& prefix = "");

/// Reads a command line. Throws rough::InputError on an unknown flag (with the nearest name), an empty value
/// or a word too many. `positional` names settings that need no flag; one with several values takes all
/// words.
Settings read_command_line(const std::vector<std::string>& words, const std::vector<Setting>& known,
                           const std::vector<std::string>& positional = {});

/// Reads an .ini file, then `overrides` ("section.key=value"). A key that ends in ".*" among `known` admits
/// any key of that section; an empty value is none. Throws rough::InputError on an unknown section or key
/// (with the nearest name).
Settings read_ini(const std::filesystem::path& file, const std::vector<Setting>& known,
                  const std::vector<std::string>& overrides = {});

/// Settings one list after another.
std::vector<Setting> joined(const std::vector<std::vector<Setting>>& lists);

std::vector<std::string> names_of(const std::vector<Setting>& settings);
/// Throws rough::InputError on the first of these that was given: its place and `problem`.
void expect_none(const Settings& settings, const std::vector<std::string>& names, const std::string& problem);
/// The message of a rough::InputError with the place in front of the setting that sets the value it is about:
/// "datum" is --datum, or model.datum of an experiment where `prefix` is "model.".
std::string placed(const Settings& settings, const std::string& prefix, const rough::InputError& error);
/// What `work` gives; a rough::InputError of the domain, which knows values and no flags, is placed.
template <class Work>
auto placing(const Settings& settings, const std::string& prefix, Work work) {
    try {
        return work();
    } catch (const rough::InputError& error) {
        throw rough::InputError(placed(settings, prefix, error));
    }
}
/// What `work` gives, its ga::UsageError as a rough::InputError that begins with the key's place: for text of
/// an experiment that ga reads.
template <class Work>
auto read_at(const Settings& settings, const std::string& key, Work work) {
    try {
        return work();
    } catch (const ga::UsageError& error) {
        throw rough::InputError(settings.place(key) + ": " + error.what());
    }
}

/// The settings as a help page lists them.
std::string described(const std::vector<Setting>& known);

} // namespace app
