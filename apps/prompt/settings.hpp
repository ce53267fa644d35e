#pragma once

#include "domain/errors.hpp"
#include "domain/text/words.hpp"
#include "ga/pipeline/parameters.hpp"

#include <filesystem>
#include <map>
#include <type_traits>

namespace app {

/// A parameter that a user may set: a flag of a command, a key of an experiment, a keyword of Python.
struct Setting {
    std::string name;       ///< flag without its dashes, or section.key
    std::string fallback;   ///< value if it is not given; "": no value
    std::string meaning;    ///< one line, with the unit; "" leaves it out of the help page
    bool is_switch = false; ///< a flag without a value
    std::string group = {}; ///< heading in the help page; "": the first one
    /// Allowed values, which are checked when settings are read: any words, or a number in a range.
    ga::Parameter takes = ga::word_list({}, {});
    std::vector<std::string> choices = {}; ///< allowed words; empty: any value that `takes` allows
    std::string alone = {};                ///< value of the flag if none follows it; "": one must follow
    char between = 0; ///< separates several values: ',', 'x' of a pair along x and y, a line's end; 0: one value

    Setting(std::string name, std::string fallback, std::string meaning, bool is_switch = false);
    Setting(const ga::Parameter& parameter); ///< one that ga::number or ga::whole describes
    /// A copy that takes several values, separated by this character.
    Setting several(char between = ',') const;
    /// A copy that takes one of these words.
    Setting of(std::vector<std::string> words) const;
};

///@{
/// Parameters of several commands.
Setting seed_setting();
Setting threads_setting();
Setting force_setting();
Setting pictures_setting();
Setting max_pressure_setting(const std::string& prefix = "", const std::string& fallback = "");
///@}
/// A whole number from `lower` to `upper`.
Setting whole(const std::string& name, const std::string& fallback, double lower, double upper,
              const std::string& meaning);
/// A number above 0.
Setting positive(const std::string& name, const std::string& fallback, const std::string& meaning);
/// A pressure (MPa) whose squares fit double precision.
Setting pressure(const std::string& name, const std::string& fallback, const std::string& meaning);

/// The name of a setting in Python: strip_width.
std::string keyword(std::string name);

/// Values by name. The constructor and every reader throw rough::InputError that names the setting, its value
/// and the allowed values.
class Settings {
  public:
    static constexpr const char* keywords = "()";
    /// `source` is an .ini file, "" for a command line, or `keywords` for a call in Python. `lines` are the
    /// file's lines by name, without those that the command line replaces.
    Settings(std::string source, std::vector<Setting> known, std::map<std::string, std::string> given,
             std::map<std::string, int> lines = {});

    bool knows(const std::string& name) const { return known_.count(name) > 0; }
    bool given(const std::string& name) const { return given_.count(name) > 0; }
    bool has(const std::string& name) const { return !text(name).empty(); }
    const std::string& text(const std::string& name) const;
    bool is_on(const std::string& name) const;
    double number(const std::string& name) const;
    ///@{
    /// The values of a setting with several.
    std::vector<double> numbers(const std::string& name) const;
    std::vector<std::string> words(const std::string& name) const;
    ///@}
    /// The place of its word among the setting's choices.
    std::size_t choice(const std::string& name) const;
    /// Sets a value to that of the setting, if it has one. An enumeration, and a bool that is not a switch,
    /// get the place among the setting's choices.
    template <class Value>
    void take(const std::string& name, Value& value) const {
        if (!has(name)) return;
        if constexpr (std::is_same_v<Value, bool>)
            value = known_.at(name).is_switch ? is_on(name) : choice(name) > 0;
        else if constexpr (std::is_same_v<Value, std::string>)
            value = text(name);
        else if constexpr (std::is_same_v<Value, std::vector<double>>)
            value = numbers(name);
        else if constexpr (std::is_enum_v<Value>)
            value = static_cast<Value>(choice(name));
        else if constexpr (std::is_integral_v<Value>)
            value = whole<Value>(name);
        else
            value = static_cast<Value>(number(name));
    }
    /// The value of a setting that takes whole numbers. Throws rough::InputError if the type has no such number.
    template <class Whole = long>
    Whole whole(const std::string& name) const {
        using Limits = std::numeric_limits<Whole>;
        const double value = number(name), last = std::min(0x1p53, static_cast<double>(Limits::max()));
        if (!(value >= std::max(-0x1p53, static_cast<double>(Limits::min())) && value <= last))
            refuse(name, text(name), " is out of range; give a whole number up to ", ga::number(last));
        return static_cast<Whole>(value);
    }
    /// A file: relative to the working directory, or to the .ini file that names it.
    std::filesystem::path path(const std::string& name) const { return beside(name, text(name)); }
    /// Several files, with commas between, each as by `path`.
    std::vector<std::filesystem::path> paths(const std::string& name) const;
    std::size_t one_of(const std::string& name, const std::vector<std::string>& words) const;

    /// The existing files that the values name, except --out, --report and --draw: those that are read.
    std::vector<std::filesystem::path> files() const;

    /// The name of the setting in messages: "--nodes", "nodes" in Python, "paper.ini:12: model.nodes", or
    /// "paper.ini: model.nodes" if no line of the file gives it.
    std::string place(const std::string& name) const;
    /// Throws rough::InputError: the place of a setting, ": " and the parts of the problem.
    template <class... Parts>
    [[noreturn]] void refuse(const std::string& name, const Parts&... problem) const {
        rough::refuse(place(name), ": ", problem...);
    }
    /// A copy with some values changed, or removed by "". `described` replaces the descriptions of settings.
    Settings with(const std::map<std::string, std::string>& values, const std::vector<Setting>& described = {}) const;
    /// The given values by name.
    const std::map<std::string, std::string>& values() const { return given_; }
    /// The given names that begin with `prefix`, without it, each with its text unless that is empty:
    /// variants and their pipelines. In alphabetical order.
    std::vector<std::pair<std::string, std::string>> texts_under(const std::string& prefix) const;

  private:
    std::filesystem::path beside(const std::string& name, const std::string& word) const;
    double number_in(const std::string& name, const std::string& word) const;
    void check(const std::string& name) const;

    std::string source_;
    std::map<std::string, Setting> known_;
    std::map<std::string, std::string> given_;
    std::map<std::string, int> lines_;
};

/// A parameter with a reference to its value, which a set-up of a command holds.
struct Binding {
    Setting setting;
    std::function<void(const Settings&, const std::string& name)> take; ///< sets the value

    template <class Value>
    Binding(Setting described, Value& value)
        : setting(std::move(described)),
          take([&value](const Settings& settings, const std::string& name) { settings.take(name, value); }) {}
};
using Bindings = std::vector<Binding>;
/// Their settings, each name behind `prefix`, under a heading of the help page.
std::vector<Setting> settings_of(const Bindings& bindings, const std::string& prefix = "",
                                 const std::string& group = "");
/// Sets the values of the bindings that are given or have a fallback.
void take(const Settings& settings, const Bindings& bindings, const std::string& prefix = "");

/// Reads a command line. Throws rough::InputError on an unknown flag (with the nearest name), an empty value or a word
/// too many. `positional` names settings that need no flag; one with several values takes all words.
Settings read_command_line(const std::vector<std::string>& words, const std::vector<Setting>& known,
                           const std::vector<std::string>& positional = {});

/// Reads an .ini file, then `overrides` ("section.key=value"). A known key that ends in ".*" admits any key
/// of that section, and "*" any key. An empty value counts as not given. Throws rough::InputError on an
/// unknown section or key (with the nearest name).
Settings read_ini(const std::filesystem::path& file, const std::vector<Setting>& known,
                  const std::vector<std::string>& overrides = {});

/// The settings of several lists.
std::vector<Setting> joined(const std::vector<std::vector<Setting>>& lists);

using rough::names_of;
/// Throws rough::InputError on the first of these that was given: its place and `problem`.
void expect_none(const Settings& settings, const std::vector<std::string>& names, const std::string& problem);
/// Throws rough::InputError if NAME-from is above NAME-to for one of these names.
void expect_in_order(const Settings& settings, const std::vector<std::string>& names);
/// The one of these settings that is given. Throws rough::InputError, `what` first, unless exactly one is.
std::string the_given(const Settings& settings, const std::vector<std::string>& names, const std::string& what);
/// The message of a rough::InputError, after the place of the setting whose value it is about, if there is
/// one. "datum" is --datum, or model.datum of an experiment if `prefix` is "model.".
std::string placed(const Settings& settings, const std::string& prefix, const rough::InputError& error);
/// Returns work(). The domain knows values and no flags; its rough::InputError is placed.
template <class Work>
auto placing(const Settings& settings, const std::string& prefix, Work work) {
    try {
        return work();
    } catch (const rough::InputError& error) {
        throw rough::InputError(placed(settings, prefix, error));
    }
}
/// Returns work(), which reads the text of a key. Its ga::UsageError becomes a rough::InputError that begins
/// with the key's place.
template <class Work>
auto read_at(const Settings& settings, const std::string& key, Work work) {
    try {
        return work();
    } catch (const ga::UsageError& error) {
        settings.refuse(key, error.what());
    }
}

/// The settings as lines of a help page.
std::string described(const std::vector<Setting>& known);

} // namespace app
