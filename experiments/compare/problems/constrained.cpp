#include "apps/report/csv.hpp"
#include "apps/report/render.hpp"
#include "domain/text/words.hpp"
#include "experiments/compare/problems/problems.hpp"

#include <muParser.h>

namespace app {
namespace {

constexpr double max_equality = 1e-4; // of an equality, as in the report

/// Rows of cec2006.csv: name, best value, bounds, number of equalities, formulas. The first formula is the
/// objective; inequalities g <= 0 and then equalities h = 0 follow.
const std::map<std::string, std::vector<std::string>>& cec_functions() {
    static const auto all = [] {
        std::map<std::string, std::vector<std::string>> all;
        const auto rows = csv_rows(builtin_files().at("cec2006.csv"));
        for (auto row = rows.begin() + 1; row != rows.end(); ++row) all[row->at(0)] = *row;
        return all;
    }();
    return all;
}

} // namespace

std::vector<std::string> constrained_problems() { return rough::names_of(cec_functions()); }

RealInstance constrained_instance(const std::string& name) {
    const std::vector<std::string>& row = cec_functions().at(name);
    RealInstance instance;
    instance.best = std::stod(row.at(1));
    std::istringstream bounds(row.at(2));
    char colon = 0;
    for (double lower = 0, upper = 0; bounds >> lower >> colon >> upper; ++instance.genes)
        instance.box.push_back({instance.genes, lower, upper});
    const auto parser = std::make_shared<mu::Parser>();
    const auto point = std::make_shared<std::vector<double>>(instance.genes);
    for (std::size_t i = 0; i < instance.genes; ++i) parser->DefineVar("x" + std::to_string(i + 1), &point->at(i));
    parser->SetExpr(row.at(4));
    const int equalities = std::stoi(row.at(3));
    instance.evaluate = [=](const std::vector<double>& x) {
        std::ranges::copy(x, point->begin());
        int count = 0;
        const double* const values = parser->Eval(count);
        Evaluation evaluation{{values[0]}, {values + 1, values + count}};
        for (auto h = evaluation.violation.end() - equalities; h != evaluation.violation.end(); ++h)
            *h = std::abs(*h) - max_equality;
        return evaluation;
    };
    instance.constrained = true;
    return instance;
}

} // namespace app
