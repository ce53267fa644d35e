#include "domain/accuracy/account.hpp"

#include <catch2/catch.hpp>

using namespace rough;
using Catch::Contains;

TEST_CASE("an account says in words what was solved, what was left out and how wrong that may be") {
    Account account;
    account.resolved_nodes = 512;
    account.grids = {512};
    account.rows = account.solved_rows = 20;
    account.solver = Solver::nested;
    CHECK(in_words(account) ==
          "Solved on 512 nodes; 20 of 20 load steps solved by nested. This is the model as given; what its "
          "grid leaves out was not estimated, as no accuracy was asked for.");
    account.grids = {64, 128, 512};
    account.solved_rows = 7;
    account.held_nodes = 3;
    CHECK_THAT(in_words(account),
               Contains("the resolved grid, as 2 coarser one(s) up to 128 nodes did not suffice; 7 of 20 "
                        "load steps solved") &&
                   Contains("read between them") && Contains("3 node(s) bear the hardness"));
    account.accuracy = 0.01;
    account.grids = {32, 64, 96, 128};
    account.read_grids = 3;
    account.solved_rows = 20;
    account.held_nodes = 0;
    account.used.resize(5);
    account.dropped.resize(2);
    account.window = {-1e-6, 2e-6};
    account.dropped_error = 0.003;
    account.estimated_error = 0.008;
    account.area_error = 0.02;
    CHECK_THAT(in_words(account),
               Contains("Read off grids of 64, 96 and 128 nodes in place of 512, after 1 coarser one(s)") &&
                   !Contains("the lightest") && !Contains("read between") && !Contains("hardness") &&
                   Contains("5 chromosome(s) modelled, 2 shorter one(s) left out: gaps change by -1e-06 to "
                            "2e-06 mm, the curve by at most 0.003.") &&
                   Contains("off by an estimated 0.008 at most") && Contains("0.01 was asked for") &&
                   Contains("fractions are off by an estimated 0.02"));
    account.resolved_rows = 2;
    CHECK_THAT(in_words(account), Contains("; the first 2 load steps, the lightest, on the 512 nodes"));
}
