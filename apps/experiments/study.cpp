#include "apps/experiments/study.hpp"

#include "apps/report/output.hpp"
#include "apps/report/result.hpp"
#include "apps/report/units.hpp"
#include "domain/errors.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/json.hpp"
#include "ga/pipeline/run.hpp"

namespace app {

using nlohmann::json;

json part_of(const Conditions& conditions, const std::string& name, const std::function<json()>& find) {
    const auto file = conditions.folder / "checkpoints" / (name + ".json");
    if (conditions.resume && std::filesystem::exists(file)) {
        json kept = rough::parsed_json(rough::read_whole(file), "--resume: " + file.string());
        if (!kept.is_object() || !kept.contains("found") ||
            kept.value("settings", json()) != conditions.settings)
            throw rough::InputError("--resume: " + file.string() +
                                    " is damaged or was kept under other settings, expected those of the "
                                    "interrupted run");
        return std::move(kept.at("found"));
    }
    if (conditions.stop)
        return {};
    const json found = find();
    if (conditions.stop)
        return {};
    std::filesystem::create_directories(file.parent_path());
    const std::string text = json{{"settings", conditions.settings}, {"found", found}}.dump();
    rough::write_atomically(file, text);
    return json::parse(text).at("found"); // as another run will read it
}

ga::RunOptions run_options(const Conditions& conditions) {
    ga::RunOptions options;
    options.seed = conditions.origin.seed;
    options.threads = conditions.origin.threads;
    options.budget.stop = &conditions.stop;
    return options;
}

Findings findings_of(const Conditions& conditions, const std::string& title, Study found,
                     const std::function<void(Page&)>& fill) {
    const auto study = std::make_shared<const Study>(std::move(found));
    const auto write = [study, folder = conditions.folder, origin = conditions.origin,
                        seconds = conditions.clock.seconds()] {
        json result = origin_json(origin);
        result.update(study->result);
        result["words"] = study->words;
        result["seconds"] = seconds;
        for (const StudyTable& table : study->tables) {
            rough::write_atomically(folder / table.file, table.text);
            if (!table.key.empty())
                result[table.key] = table.rows;
        }
        for (const auto& [path, content] : study->files) {
            if (const auto parent = std::filesystem::path(path).parent_path(); !parent.empty())
                subfolder(folder, parent.string());
            rough::write_atomically(folder / path, content);
        }
        write_json(folder / "result.json", result);
    };
    const auto page = [study, title, fill, origin = conditions.origin, seconds = conditions.clock.seconds()] {
        const auto sentence = [&](const std::string& words) {
            return study->marked_up ? Html::raw(words + ".") : Html(words + ".");
        };
        Page page(title, sentence(study->words.front()));
        for (std::size_t i = 1; i < study->words.size(); ++i)
            page.prose(sentence(study->words[i]));
        fill(page);
        page.prose(readable(seconds) + " s.");
        page.code(origin.command);
        std::vector<std::string> files;
        for (const StudyTable& table : study->tables)
            files.push_back(table.file);
        for (const auto& [path, content] : study->files)
            files.push_back(path);
        files.emplace_back("result.json");
        page.links(files);
        return page.html();
    };
    return {write, page, study->words.front()};
}

Table shown(const json& rows, const std::vector<Column>& columns, const std::string& title) {
    Table table{title, {}, {}, std::vector<bool>(columns.size(), true)};
    for (const Column& column : columns)
        table.header.push_back(column.heading);
    for (const json& row : rows) {
        std::vector<Html>& cells = table.rows.emplace_back();
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const json value = row.value(columns[c].name, json());
            if (value.is_string())
                table.numeric[c] = false;
            cells.emplace_back(value.is_string()           ? value.get<std::string>()
                               : value.is_number_integer() ? std::to_string(value.get<long>())
                               : value.is_number()         ? readable(value.get<double>(), columns[c].digits)
                                                           : "–");
        }
    }
    return table;
}

Series series_of(const std::vector<std::pair<double, double>>& points, Series look) {
    look.x.resize(static_cast<Eigen::Index>(points.size()));
    look.y.resize(look.x.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        look.x[static_cast<Eigen::Index>(i)] = points[i].first,
        look.y[static_cast<Eigen::Index>(i)] = points[i].second;
    return look;
}

} // namespace app
