#pragma once

#include "domain/response/model.hpp"
#include "domain/target/target.hpp"

namespace rough {

/// What a target file records of its model: what its curve depends on besides the surface, by name with unit.
std::map<std::string, std::string> recorded_model(const Model& model);

/// One thing that a target was recorded with and a model has not.
struct RecordedDifference {
    std::string key;      ///< "kernel", "datum_mm", ...
    std::string recorded; ///< as the target says
    std::string own;      ///< of the model; "" where it has no such thing
};

/// All that matter, in the order kernel, length, width, modulus, datum, strip width; numbers may differ by
/// 1e-9, relative. Throws InputError where a recorded number is none.
std::vector<RecordedDifference> recorded_differences(const Target& target, const Model& model);

/// Those over which a target carries. The half-plane, whose stiffness depends on datum and length, is taken
/// out of an interface's: that does not depend on the datum, and weakly, at light loads, on the length. No
/// other quantity carries over anything.
std::vector<RecordedDifference> carried_over(const Target& target, const Model& model);

/// In words: "kernel strip (here free), length_mm 0.004 (here 0.84942)".
std::string in_words(const std::vector<RecordedDifference>& differences);

/// Throws InputError that names all differences, as the target depends on them.
void expect_recorded(const Target& target, const Model& model);

} // namespace rough
