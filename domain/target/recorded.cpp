#include "domain/target/recorded.hpp"

#include "domain/errors.hpp"
#include "domain/response/model.hpp"
#include "domain/text/words.hpp"

#include <cmath>
#include <cstdio>

namespace rough {

namespace {

constexpr const char* recorded_keys[] = {"kernel",   "length_mm",      "width_mm", "effective_modulus_MPa",
                                         "datum_mm", "strip_width_mm", "layers"};

bool is_text(const std::string& key) { return key == "kernel" || key == "layers"; }

bool same(const std::string& key, const std::string& left, const std::string& right,
          const std::string& file) {
    if (is_text(key))
        return left == right;
    const double a = number_from(left, file + ": " + key), b = number_from(right, key);
    return std::abs(a - b) <= 1e-9 * std::abs(b);
}

/// A number with 15 digits, which readers see as they wrote it.
std::string as_read(const std::string& key, const std::string& value) {
    if (is_text(key) || value.empty())
        return value;
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.15g", number_from(value, key));
    return digits;
}

std::vector<RecordedDifference> differences(const Target& target, const Model& model, bool carried) {
    const auto own = recorded_model(model);
    std::vector<RecordedDifference> found;
    for (const char* key : recorded_keys) {
        const bool carries = target.quantity == Quantity::interface_stiffness &&
                             (key == std::string("datum_mm") || key == std::string("length_mm"));
        const auto there = target.recorded.find(key), here = own.find(key);
        if (carries != carried || there == target.recorded.end() || there->second.empty())
            continue;
        const std::string value = here == own.end() ? "" : here->second;
        if (here == own.end() || !same(key, there->second, value, target.name))
            found.push_back({key, there->second, as_read(key, value)});
    }
    return found;
}

} // namespace

std::map<std::string, std::string> recorded_model(const Model& model) {
    const Fields all = fields(model);
    std::map<std::string, std::string> recorded(all.begin(), all.end());
    for (const char* of_the_solution : {"nodes", "rows", "steps", "reach"})
        recorded.erase(of_the_solution);
    return recorded;
}

std::vector<RecordedDifference> recorded_differences(const Target& target, const Model& model) {
    return differences(target, model, false);
}

std::vector<RecordedDifference> carried_over(const Target& target, const Model& model) {
    return differences(target, model, true);
}

std::string in_words(const std::vector<RecordedDifference>& differences) {
    std::string words;
    for (const auto& [key, recorded, here] : differences)
        words +=
            (words.empty() ? "" : ", ") + key + " " + recorded + (here.empty() ? "" : " (here " + here + ")");
    return words;
}

void expect_recorded(const Target& target, const Model& model) {
    if (const auto differences = recorded_differences(target, model); !differences.empty())
        throw InputError(target.name + ": recorded with " + in_words(differences) +
                         ", on which the target depends; use the same");
}

} // namespace rough
