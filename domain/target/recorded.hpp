#pragma once

#include "domain/response/model.hpp"
#include "domain/target/target.hpp"

namespace rough {

/// The model as a target file records it: everything besides the surface that the curve depends on, by name
/// with unit.
std::map<std::string, std::string> recorded_model(const Model& model);

/// A recorded value that the model does not have.
struct RecordedDifference {
    std::string key;      ///< "kernel", "datum_mm", ...
    std::string recorded; ///< the target's value
    std::string here;     ///< the model's value; "" if it has none
};

/// The differences that the target's curve depends on, in the order kernel, length, width, modulus, datum,
/// strip width, layers. Numbers may differ by 1e-9, relative. Throws InputError if a recorded number cannot
/// be read.
std::vector<RecordedDifference> recorded_differences(const Target& target, const Model& model);

/// The differences to which the target's curve is insensitive: datum and length of an interface stiffness.
/// The half-plane, whose stiffness depends on both, is removed from it. It does not depend on the datum, and
/// on the length only weakly, at light loads. Other quantities have no such differences.
std::vector<RecordedDifference> carried_over(const Target& target, const Model& model);

/// The differences in words: "kernel strip (here free), length_mm 0.004 (here 0.84942)".
std::string in_words(const std::vector<RecordedDifference>& differences);

/// Throws InputError that names all recorded_differences, if there are any.
void expect_recorded(const Target& target, const Model& model);

} // namespace rough
