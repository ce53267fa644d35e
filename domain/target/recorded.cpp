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

bool same(const std::string& key, const std::string& left, const std::string& right,
          const std::string& file) {
    if (key == "kernel" || key == "layers")
        return left == right;
    const double a = number_from(left, file + ": " + key), b = number_from(right, key);
    return std::abs(a - b) <= 1e-9 * std::abs(b);
}

/// A number without the digits that only its last bit needs.
std::string as_read(const std::string& key, const std::string& value) {
    if (key == "kernel" || key == "layers" || value.empty())
        return value;
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.15g", number_from(value, key));
    return digits;
}

} // namespace

std::map<std::string, std::string> recorded_model(const Model& model) {
    const Fields all = fields(model);
    std::map<std::string, std::string> recorded(all.begin(), all.end());
    for (const char* of_the_solution : {"nodes", "rows", "steps", "reach"})
        recorded.erase(of_the_solution);
    return recorded;
}

namespace {

bool carries_over(const std::string& key, Quantity quantity) {
    return quantity == Quantity::interface_stiffness && (key == "datum_mm" || key == "length_mm");
}

std::vector<RecordedDifference> differences(const Target& target, const Model& model, bool carried) {
    const auto own = recorded_model(model);
    std::vector<RecordedDifference> found;
    for (const char* key : recorded_keys) {
        if (carries_over(key, target.quantity) != carried)
            continue;
        const auto there = target.recorded.find(key), here = own.find(key);
        if (there == target.recorded.end() || there->second.empty())
            continue;
        const std::string value = here == own.end() ? "" : here->second;
        if (here == own.end() || !same(key, there->second, value, target.name))
            found.push_back({key, there->second, as_read(key, value)});
    }
    return found;
}

} // namespace

std::vector<RecordedDifference> recorded_differences(const Target& target, const Model& model) {
    return differences(target, model, false);
}

std::vector<RecordedDifference> carried_over(const Target& target, const Model& model) {
    return differences(target, model, true);
}

std::string in_words(const std::vector<RecordedDifference>& differences) {
    std::string words;
    for (const auto& [key, recorded, own] : differences)
        words +=
            (words.empty() ? "" : ", ") + key + " " + recorded + (own.empty() ? "" : " (here " + own + ")");
    return words;
}

void expect_recorded(const Target& target, const Model& model) {
    if (const auto differences = recorded_differences(target, model); !differences.empty())
        throw InputError(target.name + ": recorded with " + in_words(differences) +
                         ", expected the same, as the target depends on it");
}

} // namespace rough
