#include "domain/text/zip.hpp"
#include "tests/apps/results.hpp"
#include "tests/domain/contact/maps.hpp"
#include "tests/sanitized.hpp"

#include <boost/algorithm/string/replace.hpp>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

using app::testing::Folder;

namespace fs = std::filesystem;

namespace {

struct Spent {
    int code;
    std::string err;
    long megabytes; ///< maximum resident memory
    double processor_seconds;
};

Spent spent(const std::string& words, const fs::path& where) {
    const std::string command = "exec '" RUGOSA_PROGRAM "' " + words + " >log 2>err </dev/null";
    const pid_t child = ::fork();
    if (child == 0) {
        if (::chdir(where.c_str()) == 0) ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
        ::_exit(127);
    }
    int status = 0;
    rusage used{};
    ::wait4(child, &status, 0, &used);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), rough::read_whole(where / "err"),
            used.ru_maxrss / 1024, seconds(used.ru_utime) + seconds(used.ru_stime)};
}

} // namespace

TEST_CASE("input beyond the limits is refused at once and in little memory", "[bounds]") {
    if (tests::sanitized) return; // a sanitizer takes memory too
    const Folder folder;
    fs::copy_file(RUGOSA_SOURCE "/experiments/targets/drawn.csv", folder / "target.csv");
    for (const auto& [name, bytes] : {std::pair("small.txt", 300'000'000), {"large.txt", 2'000'000'000}}) {
        folder.write(name, "");
        fs::resize_file(folder / name, static_cast<std::uintmax_t>(bytes));
    }
    const std::string design = "design --target target.csv --nodes 64 --out o --pipeline ";
    folder.write("few.txt", "0\n2\n1\n3\n");
    std::string layers;
    for (int layer = 0; layer < 33; ++layer) layers += " --layer 0.1";
    for (const auto& [words, named] : std::vector<std::pair<std::string, std::string>>{
             {"contact --profile small.txt --spacing 0.1 --out c.csv", "binary"},
             {"contact --profile large.txt --spacing 0.1 --out c.csv", "bytes"},
             {"contact --genome small.txt --out c.csv", "bytes"},
             {"design --target small.txt --out o", "bytes"},
             {"run small.txt --out o", "bytes"},
             {"database info small.txt", "database"},
             {"database build x.db --ridges 1000 --series 16 --shortest-wave 1e-300", "genome law"},
             {design + "'sample 4 | score | islands 1e8 rounds=2 { score }'", "10000"},
             {"design --target /dev/zero --out o", "is a device"},
             {"contact --profile /dev/urandom --spacing 0.1 --out c.csv", "is a device"},
             {"contact --profile few.txt --spacing 0.1 --kernel periodic --out c.csv" + layers, "more than 32 layers"},
             {design + "'sample 1e10 | score'", "sample"}}) {
        const Spent refused = spent(words, folder.path());
        INFO(words << ": " << refused.err << refused.megabytes << " MB, " << refused.processor_seconds << " s");
        CHECK(refused.code == 2);
        CHECK_THAT(refused.err, Catch::Contains(named));
        CHECK(refused.megabytes < 200);
        CHECK(refused.processor_seconds < 1);
    }
}

TEST_CASE("reading takes at most 20 times the file or 200 MB, for every class of bound", "[bounds]") {
    if (tests::sanitized) return;
    const Folder folder;
    const auto times = [](std::size_t n, const std::string& text) {
        std::string all;
        all.reserve(n * text.size());
        while (n-- > 0) all += text;
        return all;
    };
    const auto x3p = [&](const std::string& more, const std::string& points, const std::string& data) {
        const std::string axes =
            "<CX><AxisType>I</AxisType><Increment>1e-6</Increment></CX>"
            "<CY><AxisType>I</AxisType><Increment>1e-6</Increment></CY><CZ><DataType>D</DataType></CZ>";
        return rough::zipped({{"main.xml", "<p><Record1><Axes>" + axes + "</Axes></Record1>" + more + "<Record3>" +
                                               points + "</Record3></p>"},
                              {"data.bin", data}});
    };
    const auto matrix = [](int x, int y) {
        return "<MatrixDimension><SizeX>" + std::to_string(x) + "</SizeX><SizeY>" + std::to_string(y) +
               "</SizeY><SizeZ>1</SizeZ></MatrixDimension><DataLink><PointDataLink>data.bin</PointDataLink></"
               "DataLink>";
    };
    struct Case {
        std::string bound, command, named;
        std::function<std::string()> content; // made when it is needed: a child begins with this memory
    };
    const std::string profile = "contact --out c.csv --spacing 0.1 --profile ",
                      surface = "contact --out c.csv --spacing 0.1 --surface ",
                      genome = "contact --out c.csv --genome ";
    const std::vector<Case> cases{
        {"cells of a row", profile, "columns", [&] { return times(9, "1 2 3 4\n") + times(1'000'000, "1.5 "); }},
        {"rows of all widths", profile, "columns, but the other rows have",
         [&] {
             std::string rows = times(1'000'000, "1 ") + "\n"; // each width is as common as the widest
             for (std::size_t width = 1; width < 1000; ++width) rows += times(width, "1 ") + "\n";
             return rows;
         }},
        {"characters in a line", profile, "numbers in a line", [&] { return times(11'000'000, "1 "); }},
        {"lines", profile, "constant", [&] { return times(11'900'000, "\n") + "1 2\n2 3\n"; }},
        {"lines", surface, "lines", [&] { return times(12'100'000, "\n"); }},
        {"cells", profile, "constant", [&] { return times(2'000'000, "1\n"); }},
        {"cells of an entry", surface, "too large",
         [&] { return x3p("", matrix(3000, 2000), std::string(48'000'000, '\0')); }},
        {"cells beyond an entry", surface, "ends early", [&] { return x3p("", matrix(4000, 5000), "few"); }},
        {"elements of XML", surface, "elements", [&] { return x3p(times(1'000'001, "<a/>"), matrix(2, 2), ""); }},
        {"attributes of XML", surface, "attributes",
         [&] { return x3p("<a " + times(1'000'001, "a='' ") + "/>", matrix(2, 2), ""); }},
        {"entries of a zip archive", surface, "no axes",
         [&] {
             std::vector<std::pair<std::string, std::string>> entries{{"main.xml", "<p/>"}};
             for (int i = 0; i < 20000; ++i) entries.emplace_back(std::to_string(i), "");
             return rough::zipped(entries);
         }},
        {"levels of JSON", genome, "deep", [&] { return times(900'000, "["); }},
        {"values of JSON", genome, "values", [&] { return "[" + times(7'000'000, "0,") + "0]"; }},
        {"names in an .ini file", "run --out o ", "characters",
         [&] { return "[" + times(100'000, "a") + "]\n" + times(12'000, "k=1\n"); }},
        {"objects of a page", "report ", "values",
         [&] { return R"({"kind":"chart","x":[)" + times(2'990'000, "{},") + "{}]}"; }},
        {"values that a page shows", "report ", "scenes has more than",
         [&] { return R"({"kind":"chart","scenes":[)" + times(2'000'000, "0,") + "0]}"; }},
        {"objects of JSON", genome, "twice",
         [&] {
             return R"({"series":[{"A":1,"H":1,"gamma":2,"lambda":1,"chromosomes":[)" +
                    times(300'000, R"({"n":1,"phases":[1]},)") + R"({"n":1,"phases":[1]}]}]})";
         }},
        {"points of a target", "design --out o --target ", "points",
         [&] { return "pressure_MPa,stiffness_MPa_per_mm\n" + times(3'990'000, "1,2\n"); }}};
    for (const Case& one : cases) {
        folder.write("input", one.content());
        const Spent refused = spent(one.command + "input", folder.path());
        const auto most = std::max<long>(200, static_cast<long>(fs::file_size(folder / "input") / 50'000));
        INFO(one.bound << ": " << refused.err << refused.megabytes << " MB of " << most);
        CHECK(refused.code == 2);
        CHECK_THAT(refused.err, Catch::Contains(one.named));
        CHECK(refused.megabytes <= most);
    }
}

TEST_CASE("a target in a pipe is read once and used like a file") {
    const Folder folder;
    fs::copy_file(RUGOSA_SOURCE "/experiments/targets/drawn.csv", folder / "file");
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    const auto [code, text, error, seconds] = app::testing::rugosa("target --check file", folder.path());
    const auto piped = app::testing::rugosa("target --check pipe", folder.path(), "(timeout 60 cat file > pipe &);");
    CHECK(piped.code == code);
    CHECK(piped.err == error);
    CHECK(boost::replace_all_copy(piped.out, "pipe", "file") == text);
}

TEST_CASE("a program without memory or threads ends with one line and exit code 2", "[bounds]") {
    if (tests::sanitized) return;
    const Folder folder;
    fs::copy_file(RUGOSA_SOURCE "/experiments/targets/drawn.csv", folder / "t.csv");
    for (const char* limit : {"100000", "200000"}) { // kB of address space
        const auto ended =
            app::testing::rugosa("design --target t.csv --threads 64 --evaluations 50 --force --pictures off --out o",
                                 folder.path(), "sh -c 'ulimit -v " + std::string(limit) + "; exec \"$0\" \"$@\"'");
        INFO(limit << ": " << ended.err);
        CHECK(ended.code == 2);
        CHECK(ended.error_lines() == 1);
    }
}

TEST_CASE("an endless loop and a population beyond memory end with a result, in bounded memory", "[bounds]") {
    if (tests::sanitized) return;
    for (const char* pipeline : {"sample 4 | repeat 1e9 { score }", "sample 4 | score | tournament 2 size=1e9"}) {
        const Folder folder;
        fs::copy_file(RUGOSA_SOURCE "/experiments/targets/drawn.csv", folder / "target.csv");
        const Spent ended =
            spent("design --target target.csv --nodes 64 --pictures off --seconds 4 --out o --pipeline '" +
                      std::string(pipeline) + "'",
                  folder.path());
        INFO(pipeline << ": " << ended.err << ended.megabytes << " MB");
        CHECK((ended.code == 0 || ended.code == 3));
        CHECK(ended.megabytes < 400);
        CHECK(fs::exists(folder / "o/result.json"));
    }
}

TEST_CASE("the curve of a map takes at most 180 bytes for each node", "[bounds]") {
    if (tests::sanitized) return;
    const Folder folder;
    const auto megabytes = [&](rough::Index n) {
        std::ostringstream text;
        text << maps::self_affine(n, 0.8, 3, 0.1).heights.reshaped(n, n);
        folder.write("map.txt", text.str());
        const Spent ended = spent("contact --surface map.txt --spacing 0.002 --kernel free --resolution off "
                                  "--to-pressure 0.005 --steps 10 --threads 1 --force --out c.csv",
                                  folder.path());
        REQUIRE(ended.code == 0);
        return static_cast<double>(ended.megabytes);
    };
    CHECK((megabytes(512) - megabytes(64)) * 1024 * 1024 < 180 * (512 * 512 - 64 * 64));
}

TEST_CASE("the table of readers lists every source that reads, and its tests exist") {
    const std::string page = rough::read_whole(RUGOSA_SOURCE "/tests/README.md");
    const std::size_t begin = page.find("## Readers"), end = page.find("## Faults");
    const std::string table = page.substr(begin, end - begin);
    const std::regex reads(R"(\b(read_whole|ifstream|fopen|pread|SQLite::Database>|zip_open_from_source|from_cbor|)"
                           R"(bounded_json|json::parse|json\.loads?|read_text|MPI_Mrecv)\(|std::ifstream )");
    for (const char* folder : {"ga", "domain", "apps", "experiments"})
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(RUGOSA_SOURCE) / folder)) {
            const fs::path kind = entry.path().extension();
            const std::string source = entry.path().lexically_relative(RUGOSA_SOURCE).string();
            if ((kind != ".cpp" && kind != ".hpp" && kind != ".py") || source.ends_with("atomic_file.hpp") ||
                source.ends_with("build_backend.py")) // a declaration; run before the program exists
                continue;
            INFO(source);
            if (std::regex_search(rough::read_whole(entry.path()), reads))
                CHECK(table.find("`" + source + "`") != std::string::npos);
        }
    for (const std::string& test : app::testing::found(table, "`((?:apps|domain|ga|fuzz)/[^`]*)`"))
        CHECK((fs::exists(RUGOSA_SOURCE "/tests/" + test) || fs::exists(fs::path(RUGOSA_SOURCE) / test)));
}

TEST_CASE("every test that the table of faults names exists") {
    const std::string page = rough::read_whole(RUGOSA_SOURCE "/tests/README.md");
    const auto places = app::testing::found(page.substr(page.find("| fault |")), "`((?:apps|domain|ga)/[^`]*)`");
    CHECK(places.size() >= 10);
    for (const std::string& place : places) {
        INFO(place);
        CHECK(fs::exists(RUGOSA_SOURCE "/tests/" + place));
    }
}
