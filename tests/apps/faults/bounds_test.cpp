#include "domain/text/atomic_file.hpp"
#include "tests/apps/found.hpp"
#include "tests/apps/program.hpp"
#include "tests/sanitized.hpp"

#include <catch2/catch.hpp>

#include <sys/resource.h>
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
        if (::chdir(where.c_str()) == 0)
            ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
        ::_exit(127);
    }
    int status = 0;
    rusage used{};
    ::wait4(child, &status, 0, &used);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            rough::read_whole(where / "err"), used.ru_maxrss / 1024,
            seconds(used.ru_utime) + seconds(used.ru_stime)};
}

} // namespace

TEST_CASE("input beyond the limits is refused at once and in little memory", "[bounds]") {
    if (tests::sanitized)
        return; // a sanitizer takes memory too
    const Folder folder;
    fs::copy_file(RUGOSA_TEST_DATA "/target_paper.csv", folder / "target.csv");
    for (const auto& [name, bytes] : {std::pair("small.txt", 300'000'000), {"large.txt", 2'000'000'000}}) {
        folder.write(name, "");
        fs::resize_file(folder / name, static_cast<std::uintmax_t>(bytes));
    }
    const std::string design = "design --target target.csv --nodes 64 --out o --pipeline ";
    for (const auto& [words, named] : std::vector<std::pair<std::string, std::string>>{
             {"contact --profile small.txt --spacing 0.1 --out c.csv", "binary"},
             {"contact --profile large.txt --spacing 0.1 --out c.csv", "bytes"},
             {"contact --genome small.txt --out c.csv", "bytes"},
             {"design --target small.txt --out o", "bytes"},
             {"run small.txt --out o", "bytes"},
             {"database info small.txt", "database"},
             {"database build x.db --ridges 1000 --series 16 --shortest 1e-300", "genome law"},
             {design + "'sample 4 | score | islands 1e8 rounds=2 { score }'", "10000"},
             {design + "'sample 1e10 | score'", "sample"}}) {
        const Spent refused = spent(words, folder.path());
        INFO(words << ": " << refused.err << refused.megabytes << " MB, " << refused.processor_seconds
                   << " s");
        CHECK(refused.code == 2);
        CHECK_THAT(refused.err, Catch::Contains(named));
        CHECK(refused.megabytes < 200);
        CHECK(refused.processor_seconds < 1);
    }
}

TEST_CASE("an endless loop and a population beyond memory end with a result, in bounded memory", "[bounds]") {
    if (tests::sanitized)
        return;
    for (const char* pipeline :
         {"sample 4 | repeat 1e9 { score }", "sample 4 | score | tournament 2 size=1e9"}) {
        const Folder folder;
        fs::copy_file(RUGOSA_TEST_DATA "/target_paper.csv", folder / "target.csv");
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

TEST_CASE("every test that the table of faults names exists") {
    const std::string page = rough::read_whole(RUGOSA_SOURCE "/tests/README.md");
    const auto places =
        app::testing::found(page.substr(page.find("| fault |")), "`((?:apps|domain|ga)/[^`]*)`");
    CHECK(places.size() >= 10);
    for (const std::string& place : places) {
        INFO(place);
        CHECK(fs::exists(RUGOSA_SOURCE "/tests/" + place));
    }
}
