#pragma once

#include "domain/accuracy/resolution.hpp"

namespace rugosa::python {

/// A response as Python holds it, with what was asked for beside it.
struct Curve {
    rough::Response response;
    Eigen::MatrixXd pressure_gradient;     ///< steps x heights or genes; empty unless asked for
    Eigen::VectorXd displacement_gradient; ///< of the last step's displacement
    Eigen::VectorXd smooth_fraction;       ///< contact fraction that has a gradient, and that; empty likewise
    Eigen::MatrixXd fraction_gradient;
    std::string account;        ///< within an accuracy, in words
    rough::ResolutionBand band; ///< empty unless it was asked for and computed
};

} // namespace rugosa::python
