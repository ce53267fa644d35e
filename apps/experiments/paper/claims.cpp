#include "apps/experiments/paper/paper.hpp"
#include "apps/report/render.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace app {

namespace {

using nlohmann::json;

/// Whether a number meets a condition, comparison after comparison.
bool meets(const std::string& condition, double number) {
    if (condition == "never")
        return false;
    std::istringstream words(condition);
    std::string comparison, conjunction;
    for (double bound = 0; words >> comparison >> bound; words >> conjunction)
        if (!(comparison == "<"    ? number < bound
              : comparison == "<=" ? number <= bound
              : comparison == ">"  ? number > bound
              : comparison == ">=" ? number >= bound
                                   : number == bound))
            return false;
    return true;
}

} // namespace

const std::vector<Claim>& paper_claims() {
    static const std::vector<Claim> claims = [] {
        std::vector<Claim> all;
        auto rows = csv_rows(builtin_files().at("claims.csv"));
        for (auto row = rows.begin() + 1; row != rows.end(); ++row)
            all.push_back({row->at(0), row->at(1), row->at(2), row->at(3), row->at(4), row->at(5), row->at(6),
                           row->at(7)});
        return all;
    }();
    return claims;
}

std::string Claim::rule() const {
    return reproduced == "never" && contradicted == "never"
               ? "cannot be decided"
               : "reproduced if " + reproduced + ", contradicted " +
                     (contradicted == "otherwise" || contradicted == "never" ? "" : "if ") + contradicted;
}

std::string verdict_of(const Claim& claim, const std::vector<double>& numbers) {
    const auto all = [&](const auto& holds) {
        return !numbers.empty() && std::ranges::all_of(numbers, [&](double number) {
            return !std::isnan(number) && holds(number);
        });
    };
    if (all([&](double number) { return meets(claim.reproduced, number); }))
        return "reproduced";
    return all([&](double number) {
        return claim.contradicted == "otherwise" ? !meets(claim.reproduced, number)
                                                 : meets(claim.contradicted, number);
    })
               ? "contradicted"
               : "undecidable";
}

void add_claims(Findings& found, const PaperRun& run, const Studies& studies) {
    Csv& table = found.table("claims.csv", "id,figure,sentence,measure,rule,verdict,number,number_heldout");
    json &claims = found.result["claims"] = json::array(),
         &counts = found.result["verdicts"] = {{"reproduced", 0}, {"contradicted", 0}, {"undecidable", 0}};
    for (const Claim& claim : paper_claims()) {
        const std::vector<Finding> findings = findings_of(claim, run, studies);
        std::vector<double> known = rough::column(findings, &Finding::number);
        const std::string verdict = verdict_of(claim, known);
        counts[verdict] = counts[verdict].get<int>() + 1;
        json numbers = json::array();
        for (const Finding& finding : findings) {
            numbers.push_back({{"on", finding.on},
                               {"number", finding.number},
                               {"known", !std::isnan(finding.number)},
                               {"verdict", verdict_of(claim, {finding.number})},
                               {"parts", json::array()}});
            for (const auto& [name, value] : finding.parts)
                numbers.back()["parts"].push_back({{"name", name}, {"value", value}});
        }
        known.resize(2, unknown);
        table.row(claim.id, claim.place, claim.sentence, claim.measure, claim.rule(), verdict, known[0],
                  known[1]);
        const auto other = run.other_readings.find(claim.id);
        const std::string figure = claim.place.starts_with("Figure ")
                                       ? claim.place.substr(7, claim.place.find_last_of("0123456789") - 6)
                                       : "";
        claims.push_back({{"id", claim.id},
                          {"place", claim.place},
                          {"figure_number", figure},
                          {"sentence", claim.sentence},
                          {"measure", claim.measure},
                          {"rule", claim.rule()},
                          {"remark", claim.remark},
                          {"verdict", verdict},
                          {"numbers", std::move(numbers)},
                          {"other_readings", other == run.other_readings.end() ? "" : other->second}});
    }
}

} // namespace app
