#include "domain/mwm/sobol.hpp"
#include "tests/catch.hpp"

#include <fstream>
#include <numbers>
#include <sstream>

using namespace rough;

TEST_CASE("the Sobol database has the pairs and phases of the reference") {
    std::ifstream in(RUGOSA_TEST_DATA "/database.csv");
    REQUIRE(in);
    std::string line;
    std::getline(in, line);
    const DatabaseLayout layout{.shortest = 0.84942 / 511};
    const auto pairs = sobol_pairs(layout);
    const auto phases = sobol_phases(5, 19);
    int rows = 0;
    while (std::getline(in, line)) {
        std::istringstream cells(line);
        std::string kind, cell;
        std::getline(cells, kind, ',');
        std::getline(cells, cell, ',');
        const auto index = static_cast<std::size_t>(std::stoi(cell)) - 1;
        std::vector<double> values;
        while (std::getline(cells, cell, ','))
            if (!cell.empty()) values.push_back(std::stod(cell));
        if (kind == "pair_H_gamma") {
            CHECK(pairs.at(index).first == Approx(values[0]).epsilon(1e-15));
            CHECK(pairs.at(index).second == Approx(values[1]).epsilon(1e-15));
        } else
            for (std::size_t column = 0; column < 5; ++column)
                CHECK(phases.at(index)[column] == Approx(values[column]).epsilon(1e-15));
        ++rows;
    }
    CHECK(rows == 39);
    CHECK(sobol_database(layout).size() == 100);
}
