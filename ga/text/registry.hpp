#pragma once

#include "ga/blocks/pair.hpp"
#include "ga/stopping/rules.hpp"
#include "ga/text/nearest.hpp"

namespace ga {

/// One argument of a stage: VALUE, or KEY=VALUE.
struct ArgumentText {
    std::string key;        ///< empty if only a value was given
    std::string value;      ///< value as it was written
    std::size_t column = 0; ///< column in the text, from 1
};

/// The arguments of an operator, each checked against its parameter.
class Arguments {
  public:
    /// Assigns a stage's arguments to parameters: KEY=VALUE by name, arguments without a key in the order of
    /// the parameters.
    /// @param stage  name of the stage in messages
    /// @param where  name of the text in messages
    Arguments(const std::vector<Parameter>& parameters, const std::vector<ArgumentText>& given,
              const std::string& stage, std::size_t column, std::string where);

    /// Whether a parameter was given or has a default.
    bool has(const std::string& name) const { return values_.count(name) > 0; }
    /// The value of a number, which is in the parameter's range.
    double number(const std::string& name) const { return *parsed(word(name)); }
    /// The value of a whole number that is at least 0.
    std::size_t count(const std::string& name) const { return static_cast<std::size_t>(number(name)); }
    /// The value of a word.
    const std::string& word(const std::string& name) const { return values_.at(name).front().value; }
    /// All words of a parameter that takes several.
    std::vector<std::string> words(const std::string& name) const;
    /// Assigns the values to an object with these parameters and validates it.
    template <class T>
    [[gnu::cold]] void fill(T& described) const {
        put(bound_parameters(described));
        if constexpr (requires { described.validate(); }) described.validate();
    }
    /// Throws the error for the value of a parameter, with its column.
    [[noreturn]] void refuse(const std::string& name, const std::string& message) const;

    /// The text as a number; none if it is not entirely a number.
    static std::optional<double> parsed(const std::string& text);

  private:
    void put(const std::vector<BoundParameter>& fields) const;

    std::string where_;
    std::map<std::string, std::vector<ArgumentText>> values_;
};

/// The words of text pipelines for one type of problem: operators, combinations and choices of genes.
/// `vocabulary<P>()` has the engine's words; a domain adds more.
template <Problem P>
class Registry {
  public:
    using Genome = typename P::Genome; ///< genome of the problem
    /// Pipelines in braces after a stage.
    using Bodies = std::vector<Pipeline<P>>;
    /// A function that makes a stage from its arguments.
    using Make = std::function<Pipeline<P>(const Arguments&, const Bodies&, const Registry&)>;

    /// An operator for text. A name of two words ("cross sbx") is a member of the family "cross". A member
    /// with only the family's name is its default.
    struct Entry {
        std::string name;                  ///< name of one word, or of two
        std::string group;                 ///< heading in the listing
        std::string meaning;               ///< meaning in one line
        std::vector<Parameter> parameters; ///< parameters in the order of arguments without a key
        std::string lacks = {};            ///< member that the problem lacks; empty if the operator works
        std::size_t bodies = 0;            ///< number of pipelines in braces, 0 or 1
        bool pairs_of_words = false;       ///< whether "fitness 0.99" means fitness=0.99
        Make make = {};                    ///< makes the stage; empty if the operator does not work
    };

    /// Adds an operator; make(arguments, bodies, registry) returns its stage. Throws UsageError if the name is taken.
    [[gnu::cold]] void add(Entry entry, Make make) {
        if (find(entry.name))
            throw UsageError("operator '" + entry.name + "' is registered twice; choose another name");
        entry.make = std::move(make);
        entries_.push_back(std::move(entry));
    }
    /// Adds operators that describe themselves. If one has a member `body`, that is the pipeline in braces.
    /// An operator whose `needs` the problem does not meet is only listed.
    template <Described... Ops>
    void add() {
        (add_one<Ops>(), ...);
    }
    /// The entry of a type that describes itself.
    template <Described T>
    [[gnu::cold]] static Entry entry_of() {
        const Words words = T::words();
        return {words.name, words.group, words.meaning, parameters_of<T>()};
    }
    /// Adds stopping rules, which `until` takes by their names.
    template <class... R>
    requires(std::derived_from<R, StoppingRule>&&...) void add_rule() { (add_one_rule<R>(), ...); }
    /// The stopping rules that were given, in the order they were added.
    std::vector<Rule<Genome>> rules(const Arguments& arguments) const {
        std::vector<Rule<Genome>> found;
        for (const auto& [name, make] : rules_)
            if (arguments.has(name)) found.push_back(make(arguments));
        return found;
    }
    /// Adds an operator without arguments: add("reduce dominant", "domain", "...", transform(...)).
    template <class Op>
    requires std::derived_from<Op, Operator>
    void add(std::string name, std::string group, std::string meaning, Op op) {
        add({std::move(name), std::move(group), std::move(meaning), {}},
            [stage = Pipeline<P>(std::move(op))](const auto&...) { return stage; });
    }
    /// Adds a combination of two individuals, which `pair` takes by its name.
    void add(Combine<Genome> combine, std::string meaning) {
        combines_.push_back({std::move(combine), std::move(meaning)});
    }
    /// Adds a choice of genes, which `refine` takes as `genes=NAME`.
    void add(Variables<Genome> variables, std::string meaning) {
        variables_.push_back({std::move(variables), std::move(meaning)});
    }

    const std::vector<Entry>& entries() const { return entries_; } ///< operators in the order of adding
    /// Combinations for `pair`, with their meanings.
    const std::vector<std::pair<Combine<Genome>, std::string>>& combines() const { return combines_; }
    /// Choices of genes for `refine`, with their meanings.
    const std::vector<std::pair<Variables<Genome>, std::string>>& variables() const { return variables_; }

    /// The operator of a name, or null if the name is unknown.
    const Entry* find(const std::string& name) const {
        const auto found = std::ranges::find(entries_, name, &Entry::name);
        return found == entries_.end() ? nullptr : &*found;
    }
    /// The first words of all names, without duplicates.
    std::vector<std::string> names() const {
        std::vector<std::string> names = {"pair"};
        for (const auto& entry : entries_)
            if (const std::string first = entry.name.substr(0, entry.name.find(' ')); names.back() != first)
                names.push_back(first);
        return names;
    }
    /// The second words of a family's names.
    std::vector<std::string> members(const std::string& family) const {
        std::vector<std::string> members;
        for (const auto& entry : entries_)
            if (entry.name.starts_with(family + " ")) members.push_back(entry.name.substr(family.size() + 1));
        return members;
    }

  private:
    template <class Op>
    [[gnu::cold]] void add_one() {
        constexpr bool is_block = requires(Op op) { op.body; };
        Entry entry = entry_of<Op>();
        entry.bodies = is_block ? 1 : 0;
        Make make;
        if constexpr (requires { Op::needs; } && !Callable<Op, P>)
            entry.lacks = Op::needs;
        else
            make = +[](const Arguments& a, const Bodies& bodies, const Registry&) {
                Op op;
                if constexpr (is_block) op.body = bodies[0];
                a.fill(op);
                return Pipeline<P>(std::move(op));
            };
        add(std::move(entry), std::move(make));
    }
    template <class R>
    [[gnu::cold]] void add_one_rule() {
        rules_.push_back({R::words().name, +[](const Arguments& a) {
                              R rule;
                              a.fill(rule);
                              return rule_of<Genome>(std::move(rule));
                          }});
        for (auto& entry : entries_)
            if (entry.pairs_of_words)
                for (const Parameter& parameter : parameters_of<R>()) entry.parameters.push_back(parameter);
    }

    std::vector<Entry> entries_;
    std::vector<std::pair<std::string, std::function<Rule<Genome>(const Arguments&)>>> rules_;
    std::vector<std::pair<Combine<Genome>, std::string>> combines_;
    std::vector<std::pair<Variables<Genome>, std::string>> variables_;
};

} // namespace ga
