#include "apps/report/history.hpp"

#include "apps/report/csv.hpp"
#include "domain/errors.hpp"
#include "domain/text/json.hpp"

namespace app {

namespace fs = std::filesystem;
using nlohmann::json;

void History::add(std::span<const std::size_t> generation, const std::string& level, const std::string& genes,
                  const ga::Evaluation<Evaluation>& answer) {
    if (std::holds_alternative<ga::Pending>(answer)) return;
    json row{{"level", level}};
    std::string numbers;
    for (const std::size_t each : generation) numbers += (numbers.empty() ? "" : "/") + std::to_string(each + 1);
    row["generation"] = numbers;
    const auto columns = [&](const char* name, const json& values) {
        for (std::size_t i = 0; i < values.size(); ++i) row[name + std::to_string(i + 1)] = values[i];
        return values.size();
    };
    const std::size_t count = columns("x", rough::parsed_json(genes, "genes"));
    if (const auto* known = std::get_if<Evaluation>(&answer)) {
        columns("f", known->objectives);
        row["violation"] = violated(*known);
    } else {
        row["failure"] = *std::get<ga::Reason>(answer);
    }
    if (header_.empty()) {
        header_ = "id,generation,level";
        for (std::size_t i = 1; i <= count; ++i) header_ += ",x" + std::to_string(i);
    }
    added_.push_back(std::move(row));
}

void History::begin(std::size_t objectives, std::size_t again) {
    objectives_ = objectives;
    added_.erase(added_.begin(), added_.begin() + static_cast<std::ptrdiff_t>(std::min(again, added_.size())));
    before_ = std::exchange(added_, {});
}

void History::open() {
    std::error_code none;
    const std::uint64_t bytes = written[1], found = fs::exists(file_, none) ? fs::file_size(file_) : 0;
    if (bytes == 0) added_.insert(added_.begin(), before_.begin(), before_.end());
    if (resumed_ && (found > 0 || bytes > 0)) {
        std::string first(header_.size(), ' ');
        std::ifstream(file_, std::ios::binary).read(first.data(), std::ssize(first));
        if (found < bytes || first != header_)
            rough::refuse("--history: ", file_.string(),
                          " is not the history of this search; restore it or omit --resume");
    }
    out_.open(file_, std::ios::binary | (bytes > 0 ? std::ios::app : std::ios::trunc));
    if (bytes > 0) fs::resize_file(file_, bytes);
}

void History::write() {
    if (objectives_ == 0 || added_.empty()) return;
    if (!out_.is_open()) {
        for (std::size_t k = 1; k <= objectives_; ++k) header_ += ",f" + std::to_string(k);
        header_ += ",violation,failure";
        open();
    }
    Csv rows(header_);
    for (json& row : added_) {
        row["id"] = ++written[0];
        rows.add(row);
    }
    added_.clear();
    std::string text = rows.text();
    if (written[1] > 0) text.erase(0, header_.size() + 1);
    if (!(out_ << text << std::flush))
        rough::refuse("--history: ", file_.string(), " cannot be written; free its disk");
    written[1] += text.size();
}

} // namespace app
