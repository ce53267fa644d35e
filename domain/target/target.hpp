#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <string>

namespace rough {

/// A stiffness curve that is asked for.
struct Target {
    std::string name;          ///< where it came from
    Eigen::VectorXd pressure;  ///< xi_k, MPa, > 0, increasing
    Eigen::VectorXd stiffness; ///< y_k, MPa/mm, > 0

    Eigen::Index points() const { return pressure.size(); }            ///< how many
    double highest_pressure() const { return pressure[points() - 1]; } ///< MPa
};

/// Throws InputError that names the row (1-based) and value: no points, or zero, negative, non-finite,
/// unsorted or duplicate pressures, or stiffness not greater than zero.
void validate(const Target& target);

/// Reads a CSV with the columns pressure_MPa,stiffness_MPa_per_mm, header first. Throws InputError with file
/// and line.
Target read_target(const std::filesystem::path& file);

} // namespace rough
