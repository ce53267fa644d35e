#pragma once

#include "apps/experiments/experiment.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/page.hpp"

namespace ga {
struct RunOptions;
}

/// What the experiments on the questions that the paper leaves open have in common.
namespace app {

/// What one part of a run finds: as an interrupted run has kept it in `checkpoints`, where this one goes on
/// from there, else as `find` gives it, kept at once. Null where the run is to stop. Throws rough::InputError
/// on a part that is damaged or was kept under other settings.
nlohmann::json part_of(const Conditions& conditions, const std::string& name,
                       const std::function<nlohmann::json()>& find);

/// Of the engine's runs: seed, threads and stop.
ga::RunOptions run_options(const Conditions& conditions);

/// A table, written as a file, its rows under a key of result.json where it has one.
struct StudyTable {
    std::string file, key, text;
    nlohmann::json rows;
    StudyTable(std::string name, std::string in_result, const Csv& csv)
        : file(std::move(name)), key(std::move(in_result)), text(csv.text()), rows(csv.rows()) {}
};

/// What a run found.
struct Study {
    std::vector<std::string> words; ///< sentences without their last stop; the page begins with them
    bool marked_up = false;         ///< the words are HTML
    std::vector<StudyTable> tables = {};
    nlohmann::json result = nlohmann::json::object();            ///< what else result.json says
    std::vector<std::pair<std::string, std::string>> files = {}; ///< others: path in the folder, content
};

/// What is to be written of a study; `fill` adds to its page what follows the words.
Findings findings_of(const Conditions& conditions, const std::string& title, Study study,
                     const std::function<void(Page&)>& fill);

/// A column of a page's table: where its values stand in each row, its heading, the digits of its numbers.
struct Column {
    std::string name, heading;
    int digits = 4;
};
/// Rows of a result as a page shows them; a value that is not known is a dash.
Table shown(const nlohmann::json& rows, const std::vector<Column>& columns, const std::string& title = "");

/// A series through points.
Series series_of(const std::vector<std::pair<double, double>>& points, Series look);

} // namespace app
