#include "apps/commands/commands.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/terminal.hpp"
#include "domain/problem/stored.hpp"
#include "tests/apps/results.hpp"

#include <set>

using namespace app::testing;

namespace {

/// A folder with good and bad files of every kind.
struct Desk : Folder {
    Desk() {
        write("g.json", one_wave);
        write("gamma.json", genome_text(1, 0.8, 0.5, {{1, {0.3}}}));
        write("scan.txt", "x [um];z [um]\n0;1\n1;3\n2;0.5\n3;2\n4;1\n");
        write("conductance.csv", "pressure_MPa,conductance_S_per_m2\n1,10\n");
        write("one.txt", "1\n3\n0.5\n2\n1\n");
        write("map.txt", "0 1 2 1\n1 2 3 2\n");
        write("recorded.csv", "# kernel: strip\n# length_mm: 0.004\n# strip_width_mm: "
                              "1e-5\npressure_MPa,stiffness_MPa_per_mm\n1e-6,0.1\n");
        write("datum.csv", "# kernel: free\n# length_mm: 0.004\n# datum_mm: "
                           "0.004\npressure_MPa,stiffness_MPa_per_mm\n1e-6,90\n");
        write("t.csv", "pressure_MPa,stiffness_MPa_per_mm\n1e-6,0.1\n5e-6,0.12\n1e-5,0.14\n");
        write("word.csv", "pressure_MPa,stiffness_MPa_per_mm\n1e-5,0.5\n5e-5,x\n");
        write("noise", std::string("\x01\x7f\xff\xfe\n\x80\n\x00key", 10));
        write("key.ini", "[paper]\nx=1\n");
        write("line.ini", "[paper]\nno equals\n");
        write("kind.ini", "\xEF\xBB\xBF[experiment]\nkind = foo\n");
        write("variant.ini",
              "[target]\nfile = t.csv\n[paper]\nmax-pressure = 1e-5\n[variants]\nmine = scor | best 1\n");
        write("result.json", "{}");
    }
};

struct Wrong {
    std::string words;              ///< the command line
    std::vector<std::string> named; ///< parts of the message: the place, the value, the fix
};

const std::string paper = "run '" RUGOSA_SOURCE "/experiments/paper/paper.ini' ";

const std::vector<Wrong> wrong_uses{
    {"", {"no subcommand", "contact", "--help"}},
    {"contct", {"'contct'", "did you mean 'contact'"}},
    {"contact", {"--genome", "--profile"}},
    {"contact --genome g.json", {"--out", "missing"}},
    {"contact --genome g.json --out c.csv --node 9", {"--node:", "did you mean '--nodes'"}},
    {"contact --genome g.json --out c.csv --nodes 9 --nodes 9", {"--nodes", "given twice"}},
    {"contact --genome noise --out c.csv", {"noise", "JSON", "line 1"}},
    {"contact --genome gamma.json --out c.csv", {"gamma.json", "gamma", "0.5"}},
    {"contact --profile one.txt --out c.csv", {"--spacing: ", "one.txt"}},
    {"target --check conductance.csv", {"--resistivity: ", "conductance.csv"}},
    {"design --target t.csv --nodes 8", {"--nodes: 8", "16"}},
    {"contact --profile scan.txt --unit ell --out c.csv", {"--unit", "'ell'"}},
    {"contact --genome g.json --out g.json", {"--out", "g.json", "is read here"}},
    {"contact --genome g.json --out c.csv --nodes ''", {"--nodes: \"\" given; give a value"}},
    {"contact --genome g.json --out c.csv --datum 0.1", {"--datum: 0.1 mm", "0.2127", "(L + spacing)/4"}},
    {"design --target word.csv", {"word.csv:3", "\"x\""}},
    {"design --target t.csv --points 5", {"--points", "--like only"}},
    {"design --target t.csv --variant sgo", {"\"sgo\"", "did you mean 'sog'"}},
    {"design --target t.csv --pipeline 'scor | best 1'", {"column 1", "'scor'", "did you mean 'score'"}},
    {"design --target t.csv --noise-length 0.001", {"--noise-length: 0.001", "0.00166"}},
    {"design --target t.csv --hurst-from 3", {"--hurst-from: 3 is above", "--hurst-to: 2.5"}},
    {"design --target t.csv --max-pressure 5e-6", {"--max-pressure: 5e-6", "t.csv, 1.00000 × 10⁻⁵ MPa"}},
    {"design --target recorded.csv",
     {"recorded.csv", "kernel strip (here free), length_mm 0.004 (here 0.84942", "strip_width_mm 1e-5",
      ": --kernel strip --length 0.004 --strip-width 1e-5\n"}},
    {"target --check datum.csv", {"length_mm 0.004", "datum_mm 0.004 (here", "depends on it: --length 0.004\n"}},
    {"design --target t.csv --out .", {"--out", "holds result.json", "--force"}},
    {"design --target t.csv --database g.json", {"g.json", "genome database"}},
    {"database bild", {"'bild'", "did you mean 'build'"}},
    {"database build x.db --hurst-from 0", {"--hurst-from: 0 is out of range (a number above 0 to 10)"}},
    {"target --formula 'sqr(p)' --to 1 --out x.csv", {"--formula", "column 1", "sqrt"}},
    {"run", {"no experiment"}},
    {"run key.ini", {"key.ini:2:", "'paper.x'", "; use one of paper."}},
    {"run line.ini", {"line.ini:2:", "\"no equals\"", "key = value"}},
    {"run kind.ini", {"kind.ini:2: experiment.kind:", "\"foo\"", "chart, compare"}},
    {"run variant.ini", {"variant.ini:6: variants.mine:", "'scor'", "'score'"}},
    {"run key.ini --set paper.x= --set foo.bar=3", {"'foo.bar'", "; use one of database.*, "}},
    {paper + "more", {"'more'", "one experiment"}},
    {paper + "--set paper.threshhold=1", {"'paper.threshhold'", "did you mean 'paper.threshold'"}},
    {paper + "--resume", {"--resume", "--out"}},
    {"contact --genome g.json --nodes 8x8 --accuracy 0.1 --hardness 1 --out c.csv", {"hardness"}},
    {"contact --genome g.json --hardness 1 --friction 0.3 --out c.csv", {"--friction"}},
    {"profile --profile scan.txt --lambda-c 0.1 --lambda-s 0.2", {"lambda-c"}},
    {"design --target t.csv --variant mcco", {"goal2"}},
    {"design --from g.json --control 1:9 --target t.csv", {"1:1"}},
    {"optimise --genes real:5:2:1 --evaluate cat", {"real:5:2:1"}},
    {"optimise --genes bits:4", {"--evaluate: missing"}},
    {"compare --problems tsp --variants \"a=sample 3 | cross sbx | score | best 1\"", {"'a' on tsp14"}},
};

/// Every command that takes flags, by all of its name.
std::map<std::string, app::Command> every_command() {
    std::map<std::string, app::Command> all;
    for (const app::Command& command : app::commands()) {
        if (command.parts.empty()) all.emplace(command.name, command);
        for (const app::Command& part : command.parts) all.emplace(command.name + " " + part.name, part);
    }
    return all;
}

/// Values that a parameter does not take.
std::vector<std::string> wrong_values(const app::Setting& setting) {
    if (setting.is_switch || !setting.choices.empty()) return {"neither"};
    if (setting.takes.is_text()) return {};
    std::vector<std::string> values{"word", "nan", "1e999"};
    for (const double beyond : {setting.takes.lower - 1, setting.takes.upper * 2})
        if (std::isfinite(beyond) && !setting.takes.allows(beyond)) values.push_back(ga::number(beyond));
    if (setting.takes.kind == ga::Parameter::Kind::whole) values.push_back(ga::number(setting.takes.lower + 0.5));
    return values;
}

std::set<std::string> sorted(const std::vector<std::string>& names) { return {names.begin(), names.end()}; }

std::string refused(const std::function<app::Settings()>& read) {
    try {
        read();
    } catch (const rough::InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST_CASE("a wrong value is refused alike from a flag, a key and a keyword") {
    const Folder folder;
    std::size_t ranges = 0;
    for (const auto& [name, command] : every_command())
        for (const app::Setting& setting : command.settings)
            for (const std::string& value : wrong_values(setting)) {
                INFO(name << " --" << setting.name << " " << value);
                ++ranges;
                const std::vector<app::Setting>& known = command.settings;
                const std::string flag = "--" + setting.name;
                const std::string by_flag = refused([&] {
                    return setting.is_switch ? app::Settings("", known, {{setting.name, value}})
                                             : app::read_command_line({flag, value}, known);
                });
                CHECK_THAT(by_flag, Catch::StartsWith(flag + ": ") && Catch::Contains(value));
                CHECK(by_flag.find('\n') == std::string::npos);
                const std::string rest = by_flag.substr(std::min(by_flag.size(), flag.size()));
                const auto in_python = [&] {
                    return app::Settings(app::Settings::keywords, known, {{setting.name, value}});
                };
                CHECK(refused(in_python) == app::keyword(setting.name) + rest);
                app::Setting key = setting;
                key.name = "model." + setting.name;
                folder.write("x.ini", "[model]\n" + setting.name + " = " + value + "\n");
                CHECK(refused([&] { return app::read_ini(folder / "x.ini", {key}); }) ==
                      (folder / "x.ini").string() + ":2: " + key.name + rest);
            }
    CHECK(ranges > 100);
    for (const auto& [name, command] : every_command())
        for (const app::Setting& setting : command.settings)
            if (!wrong_values(setting).empty() && !setting.is_switch) {
                check_refused(rugosa(name + " --" + setting.name + " neither", folder.path()),
                              "--" + setting.name + ": \"neither\"");
                break;
            }
}

TEST_CASE("a model is the same from flags, keys, keywords and its stored form") {
    const std::map<std::string, std::string> given{
        {"nodes", "77"},    {"length", "0.5"}, {"kernel", "strip"}, {"strip-width", "0.01"}, {"modulus", "200"},
        {"poisson", "0.3"}, {"steps", "7"},    {"reach", "0.5"},    {"solver", "nnls"},      {"tolerance", "1e-8"}};
    std::vector<std::string> words;
    std::string ini = "[model]\n";
    for (const auto& [name, value] : given) {
        words.insert(words.end(), {"--" + name, value});
        ini += name + " = " + value + "\n";
    }
    const Folder folder;
    folder.write("model.ini", ini);
    const nlohmann::json by_flags = model_from(app::read_command_line(words, app::model_settings()));
    CHECK(by_flags.at("body").at("effective_modulus") == Approx(200 / 0.91).epsilon(1e-15));
    CHECK(by_flags ==
          nlohmann::json(model_from(app::read_ini(folder / "model.ini", app::model_settings("model.")), "model.")));
    CHECK(by_flags == nlohmann::json(model_from(app::Settings(app::Settings::keywords, app::model_settings(), given))));
    CHECK(by_flags == nlohmann::json(by_flags.get<rough::Model>()));
}

TEST_CASE("wrong use ends with 2 and one line of place, problem and fix, without files") {
    const Desk desk;
    const auto before = sorted(desk.names());
    for (const Wrong& wrong : wrong_uses) {
        const Ended ended = rugosa(wrong.words, desk.path());
        INFO("rugosa " << wrong.words);
        check_refused(ended, "rugosa: ");
        CHECK(ended.out.empty());
        for (const std::string& part : wrong.named) CHECK_THAT(ended.err, Catch::Contains(part));
        CHECK(std::none_of(ended.err.begin(), ended.err.end() - 1, [](char c) { return c >= 0 && c < ' '; }));
        CHECK(sorted(desk.names()) == before);
    }
}

TEST_CASE("every help page has a usage and examples with valid flags") {
    const Desk desk;
    for (const auto& [command, described] : every_command()) {
        const Ended help = rugosa(command + " --help", desk.path());
        INFO(command << "\n" << help.out);
        CHECK(help.code == 0);
        CHECK(help.err.empty());
        CHECK_THAT(help.out, Catch::StartsWith("Usage: rugosa " + command));
        CHECK(rugosa(command + " -h", desk.path()).out == help.out);
        const auto examples = found(help.out, "\n  rugosa ([^\n]*)");
        CHECK_FALSE(examples.empty());
        // A flag given twice is refused after all flags have been read.
        const std::map<std::string, std::string> twice{{"database build", " --seed 1 --seed 1"},
                                                       {"database info", " --file a --file b"},
                                                       {"report", " --out a --out b"}};
        const auto other = twice.find(command);
        for (const std::string& example : examples) {
            if (command == "operators") continue;
            const Ended taken = rugosa(example.substr(0, example.find("   (")) +
                                           (other == twice.end() ? " --force --force" : other->second),
                                       desk.path());
            INFO(example);
            CHECK(taken.code == 2);
            CHECK_THAT(taken.err, Catch::Contains("given twice"));
        }
    }
    CHECK(rugosa("help design").out == rugosa("design --help").out);
    CHECK_THAT(rugosa("--help").out, Catch::Contains("Exit codes"));
    CHECK_THAT(rugosa("--version").out, Catch::StartsWith("rugosa "));
}

TEST_CASE("a flag without effect is reported") {
    const Desk desk;
    const std::vector<std::pair<std::string, std::string>> cases{
        {"contact --genome g.json --strip-width 0.1 --out a.csv",
         "--strip-width is without effect: the kernel is free"},
        {"contact --genome g.json --datum 1 --kernel periodic --out d.csv",
         "--datum is without effect: the kernel is periodic"},
        {"target --check whole.csv --resistivity 3",
         "--resistivity is without effect: no target is an electrical conductance"}};
    desk.write("whole.csv", "pressure_MPa,contact_fraction\n1e-3,0.5\n");
    for (const auto& [words, note] : cases) {
        const Ended ended = rugosa(words, desk.path());
        INFO(words << "\n" << ended.err << ended.out);
        CHECK(ended.err.empty());
        CHECK_THAT(ended.out, Catch::Contains("note: " + note + "\n"));
        CHECK(rugosa(words + " --quiet --force", desk.path()).out.empty());
    }
}

TEST_CASE("contact notes a jump at periodic ends, short waves and a missing modulus") {
    const Desk desk;
    desk.write("jump.json", genome_text(1e-3, 1, 1.7, {{1, {0}}, {2, {1.5}}}));
    desk.write("meets.json", genome_text(1e-3, 1, 2, {{1, {0}}, {2, {1.5}}}));
    const auto said = [&](const std::string& words) {
        const Ended ended = rugosa("contact --out c.csv --force " + words, desk.path());
        INFO(words << ended.err);
        CHECK(ended.code == 0);
        return ended.out;
    };
    const std::string jump = "of its height range; a periodic body has a step there";
    CHECK_THAT(said("--genome jump.json --kernel periodic"), Catch::Contains(jump));
    CHECK(said("--genome meets.json --kernel periodic").find(jump) == std::string::npos);
    desk.write("ramp.txt", heights_text(64, [](int i) { return 0.01 * i; }));
    CHECK_THAT(said("--spacing 0.01 --detrend none --kernel periodic --profile ramp.txt"),
               Catch::Contains("ends differ by 0.63") && Catch::Contains(jump));
    const std::string waves = "nodes long, under 8";
    CHECK_THAT(said("--genome meets.json --nodes 14"), Catch::Contains("6.50 " + waves));
    CHECK(said("--genome meets.json --nodes 18").find(waves) == std::string::npos);
    const std::string modulus = "E is 1 MPa";
    CHECK_THAT(said("--genome meets.json"), Catch::Contains(modulus));
    CHECK(said("--genome meets.json --modulus 1").find(modulus) == std::string::npos);
}

TEST_CASE("quiet and verbose runs differ in their output, not in their results") {
    const Folder folder;
    folder.write("scan.txt", "x [um];z [um]\n0;1\n1;3\n2;0.5\n3;2\n4;1\n");
    const auto plain = rugosa("contact --profile scan.txt --out plain.csv", folder.path());
    const auto quiet = rugosa("contact --quiet --profile scan.txt --out quiet.csv", folder.path());
    const auto verbose = rugosa("contact --profile scan.txt --out verbose.csv --verbose", folder.path());
    CHECK_THAT(plain.out, Catch::Contains("5 points"));
    CHECK_THAT(plain.out, Catch::Contains("E is 1 MPa"));
    CHECK(std::ranges::count(plain.out, '\n') == 5); // with a warning, the band and the answer
    CHECK(quiet.out.empty());
    CHECK(verbose.out.find('\033') == std::string::npos); // a pipe gets no colour
    CHECK_THAT(verbose.out, Catch::StartsWith(plain.out.substr(0, plain.out.rfind("plain.csv: at"))) &&
                                Catch::Contains("KKT") && Catch::Contains("\nverbose.csv: at"));
    for (const auto& ended : {plain, quiet, verbose}) {
        CHECK(ended.code == 0);
        CHECK(ended.err.empty());
    }
    const std::string curve = rough::read_whole(folder / "plain.csv");
    CHECK(rough::read_whole(folder / "quiet.csv") == curve);
    CHECK(rough::read_whole(folder / "verbose.csv") == curve);
    CHECK(rugosa("contact --quiet --verbose", folder.path()).code == 2);
}

TEST_CASE("a text for the terminal has no control characters and stays on one line") {
    CHECK(app::printable("grün – 3 µm") == "grün – 3 µm");
    CHECK(app::printable("a\x1b[2J\nb\tc\rd\x7f") == "a?[2J b c d?");
    CHECK(app::printable("\xc2\x9b"
                         "31m\xe2\x80\xae") == "?31m?"); // C1; right to left
    CHECK_THAT(app::printable("\x9b"
                              "31m\xff"),
               !Catch::Contains("\x9b") && !Catch::Contains("\xff"));
}
