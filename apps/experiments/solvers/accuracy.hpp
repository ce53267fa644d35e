#pragma once

#include "apps/experiments/experiment.hpp"
#include "domain/design/error_budget.hpp"

#include <string>
#include <vector>

/// Results of the accuracy experiment. Seconds are those of one core.
namespace app {

/// One scene under one accuracy.
struct SavingRow {
    std::string surface; ///< smooth or rough
    std::string kernel;
    std::string load; ///< light or full
    int sample = 0;   ///< number of the random surface
    double accuracy = 0;
    double seconds = 0, resolved_seconds = 0;
    double estimated_error = 0, true_error = 0; ///< relative, worst row
    rough::Index nodes = 0, resolved_nodes = 0;
    std::size_t dropped = 0; ///< chromosomes left out

    bool covered() const { return true_error <= estimated_error; }
    double saving() const { return resolved_seconds / seconds; }
};

struct AccuracyRun {
    std::vector<SavingRow> savings;
    rough::DesignSetup setup; ///< for the designed surface
    VariantRun design;
    std::vector<rough::ErrorSource> budget;
    Origin origin;
    double seconds = 0;
};

/// result.json, savings.csv, medians.csv, coverage.csv and budget.csv.
Findings findings_of(const AccuracyRun& run);

} // namespace app
