#pragma once

#include "domain/numerics/grid.hpp"

#include <nlohmann/json.hpp>

#include <vector>

namespace rough {

///@{
/// Vectors as checkpoints hold them, without loss.
inline std::vector<double> numbers_of(const Eigen::VectorXd& vector) {
    return {vector.begin(), vector.end()};
}
inline Eigen::VectorXd vector_from(const nlohmann::json& j) {
    const auto numbers = j.get<std::vector<double>>();
    return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Index>(numbers.size()));
}
///@}

} // namespace rough
