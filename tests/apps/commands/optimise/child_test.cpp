#include "apps/commands/optimise/children.hpp"
#include "tests/catch.hpp"
#include "tests/folder.hpp"

#include <csignal>
#include <fcntl.h>
#include <unistd.h>

using namespace app;

namespace {

bool never() { return false; }

class Nowhere {
  public:
    Nowhere() : file(open("/dev/null", O_WRONLY | O_CLOEXEC)) { std::signal(SIGPIPE, SIG_IGN); }
    ~Nowhere() { close(file); }
    const int file;
};

} // namespace

TEST_CASE("a command is split at its blanks, but not inside quotes") {
    CHECK(split_command("  a  b\tc ") == Words{"a", "b", "c"});
    CHECK(split_command("awk '{ print \"x\\n\" }'") == Words{"awk", "{ print \"x\\n\" }"});
    CHECK(split_command("a \"b \\\"c\\\\ $d\" '' e\\ f g'h'\"i\"") == Words{"a", "b \"c\\ $d", "", "e f", "ghi"});
    CHECK(split_command("a b\\") == Words{"a", "b\\"}); // nothing follows the last one
    CHECK_THROWS_AS(split_command("a 'b"), rough::InputError);
    CHECK_THROWS_AS(split_command(" "), rough::InputError);
}

TEST_CASE("a child reads and writes lines of any length") {
    const Nowhere nowhere;
    Child child({"cat"}, nowhere.file);
    const std::string longer(1'000'000, 'x'); // more than a pipe holds
    CHECK(child.answer("one", 10, never) == "one");
    CHECK(child.answer(longer, 10, never) == longer);
}

TEST_CASE("the end of a child is reported with its unfinished line") {
    const Nowhere nowhere;
    Child child({"sh", "-c", "printf half; exit 3"}, nowhere.file);
    CHECK(child.answer("", 10, never) == std::nullopt);
    CHECK(child.unfinished() == "half");
    CHECK(child.end(0.2) == "ended with exit code 3");
    Child killed({"sh", "-c", "kill -SEGV $$"}, nowhere.file);
    killed.answer("", 10, never);
    CHECK(killed.end(0.2) == "was ended by signal 11");
    CHECK_THROWS_AS(Child({"no-program-of-this-name"}, nowhere.file), rough::InputError);
}

TEST_CASE("a child may finish its work when its input ends, or is killed") {
    const Nowhere nowhere;
    const tests::Folder folder;
    const std::string mark = (folder / "mark").string();
    { const Child last({"sh", "-c", "cat >/dev/null; echo done >'" + mark + "'"}, nowhere.file); }
    CHECK(std::filesystem::exists(mark));
    pid_t deaf = 0;
    {
        Child child({"sh", "-c", "trap '' TERM; echo $$; exec sleep 1000"}, nowhere.file);
        deaf = std::stoi(child.answer("", 10, never).value());
        CHECK(kill(deaf, 0) == 0);
    }
    CHECK(kill(deaf, 0) == -1); // not even a zombie is left
    CHECK(errno == ESRCH);
}

TEST_CASE("the best and the front depend on what was evaluated, not on its order") {
    std::vector<Solution> all{{"a", {{1, 5}}},      {"b", {{1, 5}}},       {"c", {{2, 4}}}, {"d", {{2, 3}}},
                              {"e", {{9, 9}, {1}}}, {"f", {{0, 6}, {-1}}}, {"g", {{2, 4}}}};
    std::sort(all.begin(), all.end(), [](const auto& x, const auto& y) { return x.genes < y.genes; });
    do {
        BestKnown known;
        known.minimise = {false, false};
        for (const Solution& solution : all) known.take(solution);
        REQUIRE(known.best()->genes == "c");
        std::string front;
        for (const Solution& solution : known.front()) front += solution.genes;
        REQUIRE(front == "caf");
    } while (
        std::next_permutation(all.begin(), all.end(), [](const auto& x, const auto& y) { return x.genes < y.genes; }));
}
