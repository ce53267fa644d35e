#include "tests/apps/program.hpp"

#include <catch2/catch.hpp>

using namespace app::testing;

TEST_CASE("the program says more or less as it is told, the results stay the same") {
    const Folder folder;
    folder.write("scan.txt", "x [um];z [um]\n0;1\n1;3\n2;0.5\n3;2\n4;1\n");
    const auto plain = rugosa("contact --profile scan.txt --out plain.csv", folder.path());
    const auto quiet = rugosa("contact --quiet --profile scan.txt --out quiet.csv", folder.path());
    const auto verbose = rugosa("contact --profile scan.txt --out verbose.csv --verbose", folder.path());
    CHECK_THAT(plain.out, Catch::Contains("5 points"));
    CHECK_THAT(plain.out, Catch::Contains("E is 1 MPa"));
    CHECK(std::count(plain.out.begin(), plain.out.end(), '\n') == 3); // with the band
    CHECK(quiet.out.empty());
    CHECK_THAT(verbose.out, Catch::StartsWith(plain.out) && Catch::Contains("KKT"));
    for (const auto& ended : {plain, quiet, verbose}) {
        CHECK(ended.code == 0);
        CHECK(ended.err.empty());
    }
    const std::string curve = rough::read_whole(folder / "plain.csv");
    CHECK(rough::read_whole(folder / "quiet.csv") == curve);
    CHECK(rough::read_whole(folder / "verbose.csv") == curve);
    CHECK(rugosa("contact --quiet --verbose", folder.path()).code == 2);
}

TEST_CASE("no colour and no progress reach a pipe") {
    const Folder folder;
    const auto refused = rugosa("contact --genome none.json --out c.csv", folder.path());
    CHECK(refused.err.find('\033') == std::string::npos);
    const auto built = rugosa("database build g.db --genomes 3000 --nodes 64", folder.path());
    CHECK(built.err.empty());
    CHECK(built.out.find('\033') == std::string::npos);
}
