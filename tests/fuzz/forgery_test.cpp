// Files that rugosa has written itself and reads back, altered in one place and sealed correctly.

#include "apps/commands/optimise/children.hpp"
#include "apps/external/problem.hpp"
#include "apps/prompt/terminal.hpp"
#include "domain/database/screen.hpp"
#include "domain/text/atomic_file.hpp"
#include "ga/checkpoint/checkpoint.hpp"
#include "tests/catch.hpp"
#include "tests/domain/database/small_setup.hpp"
#include "tests/folder.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <SQLiteCpp/VariadicBind.h>

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// A value of another type, size or range than the old one.
json odd_value(json old, ga::Stream& random) {
    const json many = old.is_array() ? json(std::vector<json>(40, old.empty() ? json() : old[0])) : json({old, old});
    const std::vector<json> others{nullptr,       "\x1b[2J\n<script>", -1,   1e308, std::nan(""), UINT64_MAX,
                                   json::array(), json::object(),      many, 3};
    if (const std::size_t choice = random.below(14); choice < others.size()) return others[choice];
    // one part less or more, or a number a little off
    if (old.is_number()) return random.chance(0.5) ? json(-2.5 * old.get<double>()) : json(old.get<double>() + 1);
    if (!old.is_array() || old.empty()) return true;
    if (random.chance(0.5))
        old.erase(old.size() - 1);
    else
        old.push_back(json(old[0]));
    return old;
}

/// The value with one of its parts changed, at any depth.
json forged(json value, ga::Stream& random) {
    json* part = &value;
    while (part->is_structured() && !part->empty() && random.chance(0.93))
        part = &*std::next(part->begin(), static_cast<long>(random.below(part->size())));
    *part = odd_value(*part, random);
    return value;
}

/// Calls `read` for forgeries of a value. It may succeed, for it may not notice a possible value, or throw an
/// error of one line; at least `refused` times it does.
void forge(const std::string& kind, const json& good, int times, int refused,
           const std::function<void(const json&)>& read) {
    CHECK_NOTHROW(read(good));
    for (int i = 0; i < times; ++i) {
        ga::Stream random(ga::fold(ga::fold(std::uint64_t{1}, kind), static_cast<std::uint64_t>(i)));
        const json bad = forged(good, random);
        std::string message;
        try {
            read(bad);
        } catch (const rough::InputError& error) {
            message = error.what();
        } catch (const ga::UsageError& error) {
            message = error.what();
        } catch (const rough::NotConverged&) {
        } catch (const std::exception& error) {
            FAIL_CHECK(kind << ", forgery " << i << ": " << error.what() << "\n" << json::diff(good, bad));
        }
        refused -= !message.empty();
        CHECK(message.find("json.exception") == std::string::npos); // no library's name
    }
    INFO(kind);
    CHECK(refused <= 0);
}

/// Answers an evaluation by sums of the genes.
template <class P>
struct Summing : ga::Evaluator<P> {
    app::BestKnown record;
    void outcomes(const P& problem, std::span<ga::EvaluationCall<P>> calls, const ga::Watch&) override {
        for (auto& call : calls) {
            double sum = 0, weighted = 0;
            for (const auto gene : *call.genome) {
                sum += static_cast<double>(gene);
                weighted += static_cast<double>(gene) * ++place_;
            }
            place_ = 0;
            app::Evaluation answer{{sum, weighted}, {sum - 3, -1}};
            answer.objectives.resize(problem.objectives().size());
            record.take({app::genes_text(*call.genome), answer});
            *call.answer = std::move(answer);
        }
    }

  private:
    double place_ = 0;
};

/// Forges the checkpoint of a search that was stopped.
template <class G>
void forge_search(const std::string& genes, const std::string& pipeline, bool several) {
    using P = app::OutsideProblem<G>;
    const tests::Folder folder;
    const std::vector<bool> minimise(several ? 2 : 1, false);
    app::OutsideSearch search;
    search.genes = app::genes_from(genes);
    const P problem(search, minimise);
    search.pipeline = pipeline;
    const auto stage = app::stage_of<P>(search, minimise.size());
    const auto run = [&](bool resume, long evaluations) {
        Summing<P> evaluator;
        evaluator.record.minimise = minimise;
        ga::Checkpoints<P> keeper(folder / "run", "", resume, resume ? 1e9 : 0);
        keeper.keep("record", evaluator.record);
        ga::run_by(evaluator, stage, problem, {}, {.threads = 1, .budget = {.evaluations = evaluations, .seconds = 5}},
                   {}, &keeper);
        for (const app::Solution& solution : evaluator.record.front()) CHECK(json::parse(solution.genes).is_array());
    };
    run(false, 40);
    forge(genes + pipeline, json::from_cbor(ga::opened(folder / "run")), 80, 25, [&](const json& content) {
        const auto bytes = json::to_cbor(content);
        ga::seal(folder / "run", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        run(true, 300);
    });
}

/// Runs a command of the program in this process.
void command(const std::string& words) { run_part(app::commands(), app::split_command(words)); }

/// Numbers as a database stores them.
std::string packed(const std::vector<double>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
}

std::vector<double> unpacked(std::string_view bytes) {
    std::vector<double> values(bytes.size() / sizeof(double));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(double));
    return values;
}

} // namespace

TEST_CASE("forged checkpoints of reals, words, bits, permutations and fronts are refused or harmless") {
    const std::string generation = " | score | repeat 9 { tournament 2 | ";
    forge_search<std::vector<double>>("real:3:-1:1,choice:2:a:b:c",
                                      "sample 8" + generation + "cross blend | mutate 0.3 | score | elite 1 }", false);
    forge_search<std::vector<double>>("real:3:-1:1", "sample 8" + generation + "self-adaptive | score | elite 1 }",
                                      false);
    forge_search<std::vector<double>>("real:2:-1:1", "sample 1 | score | repeat 30 { cma-es | score }", false);
    forge_search<std::vector<double>>("real:2:-1:1", "sample 8 | score | repeat 30 { l-shade | score | duel }", false);
    forge_search<std::vector<bool>>("bits:9",
                                    "sample 8" + generation + "cross uniform | mutate 0.1 | score | elite 1 }", false);
    forge_search<ga::Permutation>(
        "permutation:7", "sample 8" + generation + "cross order | mutate 0.1 reverse | score | elite 1 }", false);
    forge_search<ga::Permutation>("permutation:7",
                                  "sample 8 | pareto f1 f2 | repeat 9 { tournament 2 | cross order | "
                                  "pareto f1 f2 | plus 8 } | front",
                                  true);
}

TEST_CASE("forged checkpoints and results of a design are refused or harmless") {
    const tests::Folder folder;
    app::Words quiet{"--quiet"};
    app::parse_verbosity(quiet);
    folder.write("t.csv", "pressure_MPa,stiffness_MPa_per_mm\n4e-5,0.4\n8e-5,0.6\n1.6e-4,0.8\n");
    const std::string in = folder.path().string();
    const std::string design =
        "design --target '" + in + "/t.csv' --out '" + in +
        "/o' --nodes 32 --steps 6 --threads 1 "
        "--pictures off --alternatives 1 --pipeline 'sample 4 | score | repeat 3 { tournament 2 | "
        "cross uniform | mutate 0.2 | score | refine lm 1 | elite 1 } | best 1' ";
    command(design + "--evaluations 10");
    const fs::path checkpoint = folder / "o/checkpoint.cbor", result = folder / "o/result.json";
    forge("design", json::from_cbor(ga::opened(checkpoint)), 60, 15, [&](const json& content) {
        const auto bytes = json::to_cbor(content);
        ga::seal(checkpoint, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        command(design + "--evaluations 14 --resume");
    });
    fs::remove(checkpoint);
    fs::remove(checkpoint.string() + ".before");
    json brief = json::parse(rough::read_whole(result)); // the parts that --resume reads
    brief = {{"inputs", brief["inputs"]}, {"verdict", brief["verdict"]}, {"summary", {{"found", true}}}};
    forge("result.json", brief, 60, 25, [&](const json& content) {
        folder.write("o/result.json", content.dump(-1, ' ', false, json::error_handler_t::replace));
        command(design + "--resume");
    });
    const json genome = json::parse(rough::read_whole(folder / "o/genome.json"));
    forge("genome.json", genome, 60, 20,
          [&](const json& content) { rough::read_genome_file(folder.write("g.json", content.dump())); });
}

TEST_CASE("a forged database is refused or harmless") {
    const tests::Folder folder;
    rough::testing::built(folder / "good.db", {.genomes = 6, .batch = 3});
    rough::Target target;
    target.x = Eigen::VectorXd::LinSpaced(5, 1e-4, 5e-4);
    target.y = Eigen::VectorXd::Constant(5, 0.5);
    json good = json::object();
    {
        SQLite::Database sqlite(folder / "good.db");
        for (const std::string table : {"pressure", "contact", "genome"}) {
            SQLite::Statement rows(sqlite, "SELECT first, numbers FROM " + table);
            while (rows.executeStep())
                good[table][rows.getColumn(0).getString()] = unpacked(rows.getColumn(1).getString());
        }
        SQLite::Statement setup(sqlite, "SELECT name, value FROM setup WHERE name <> 'checksum'");
        while (setup.executeStep()) good["setup"][setup.getColumn(0).getString()] = setup.getColumn(1).getString();
        good["batch"] = {{"0", 3}, {"3", 3}};
    }
    forge("database", good, 150, 50, [&](const json& content) {
        const fs::path file = folder / "bad.db";
        fs::copy_file(folder / "good.db", file, fs::copy_options::overwrite_existing);
        {
            SQLite::Database sqlite(file, SQLite::OPEN_READWRITE);
            const auto text = [](const json& j) { return j.is_string() ? j.get<std::string>() : j.dump(); };
            const auto signed_number = [](std::uint64_t n) { return static_cast<std::int64_t>(n); };
            const auto whole = [](const json& j) {
                return !j.is_number_integer() ? 7 : j < 0 ? UINT64_MAX : j.get<std::uint64_t>();
            };
            const auto numbers = [](const json& j) {
                std::vector<double> all;
                for (const json& each : j.is_array() ? j : json::array({j}))
                    all.push_back(each.is_number() ? each.get<double>() : HUGE_VAL);
                return all;
            };
            const auto run = [&](const std::string& sql, const auto&... values) {
                SQLite::Statement statement(sqlite, sql);
                SQLite::bind(statement, values...);
                statement.exec();
            };
            std::string lines; // its checksum is stored (domain/database/store.cpp)
            sqlite.exec("DELETE FROM setup; DELETE FROM batch");
            if (content.contains("setup") && content["setup"].is_object())
                for (const auto& [name, value] : content["setup"].items()) {
                    lines += name + "=" + text(value) + "\n";
                    run("INSERT INTO setup VALUES(?, ?)", name, text(value));
                }
            run("INSERT INTO setup VALUES('checksum', ?)", std::to_string(rough::checksum(lines)));
            for (const char* first : {"0", "3"}) {
                const json& batches = content.contains("batch") ? content["batch"] : json();
                const std::uint64_t count = batches.is_object() && batches.contains(first) ? whole(batches[first]) : 3;
                const std::uint64_t place = std::stoul(first);
                run("INSERT INTO batch VALUES(?, ?)", signed_number(place), signed_number(count));
                for (const std::string table : {"pressure", "contact", "genome"}) {
                    const json& rows = content.contains(table) ? content[table] : json();
                    const std::string bytes =
                        packed(numbers(rows.is_object() && rows.contains(first) ? rows[first] : rows));
                    const std::uint64_t sum =
                        rough::checksum(bytes, rough::checksum(table, place * ga::golden_step + count));
                    run("UPDATE " + table + " SET numbers = CAST(? AS BLOB), checksum = ? WHERE first = ?", bytes,
                        signed_number(sum), signed_number(place));
                }
            }
        }
        rough::GenomeStore store = rough::GenomeStore::open(file);
        const rough::DesignSetup setup{.model = store.setup().model, .targets = {target}};
        rough::stored_answers(store, setup, 1, 1);
        rough::build(store, {.genomes = 9, .batch = 3, .threads = 1});
        store.curves(true);
        for (const rough::Span& span : store.batches()) store.responses(span);
    });
}
