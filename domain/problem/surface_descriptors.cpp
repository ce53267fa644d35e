#include "domain/problem/problem.hpp"

#include <numbers>

namespace rough {

namespace {

/// A number of a profile and its derivatives with respect to the heights.
struct Feature {
    double value;
    Eigen::RowVectorXd by_height;
};

/// log10 of the root mean square height, lengths in `length`.
Feature height(const Profile& profile, double length) {
    const Eigen::RowVectorXd z = profile.heights.transpose().array() - profile.heights.mean();
    return {std::log10(std::sqrt(z.squaredNorm() / static_cast<double>(z.size())) / length),
            z / (z.squaredNorm() * std::numbers::ln10)};
}

/// log10 of the root mean square slope, on a map of the gradient.
Feature slope(const Profile& surface, double) {
    const auto [columns, rows] = surface.shape();
    const auto z = surface.heights.reshaped(columns, rows);
    double square = 0;
    Eigen::MatrixXd by = Eigen::MatrixXd::Zero(columns, rows);
    const auto add = [&](const auto& after, const auto& before, auto by_after, auto by_before,
                         double spacing) {
        const Eigen::MatrixXd slopes = (after - before) / spacing;
        const double share = 1 / static_cast<double>(slopes.size());
        square += share * slopes.squaredNorm();
        by_after += share / spacing * slopes;
        by_before -= share / spacing * slopes;
    };
    add(z.bottomRows(columns - 1), z.topRows(columns - 1), by.bottomRows(columns - 1),
        by.topRows(columns - 1), surface.spacing);
    if (surface.is_2d())
        add(z.rightCols(rows - 1), z.leftCols(rows - 1), by.rightCols(rows - 1), by.leftCols(rows - 1),
            surface.row_spacing);
    return {0.5 * std::log10(square), by.reshaped().transpose() / (square * std::numbers::ln10)};
}

Feature wavelength(const Profile& profile, double length) {
    const Feature of_height = height(profile, length), of_slope = slope(profile, length);
    return {std::log10(2 * std::numbers::pi) + of_height.value - of_slope.value,
            of_height.by_height - of_slope.by_height};
}

Feature skewness(const Profile& profile, double) {
    const Eigen::RowVectorXd z = profile.heights.transpose().array() - profile.heights.mean();
    const auto n = static_cast<double>(z.size());
    const double variance = z.squaredNorm() / n, third = z.array().cube().sum() / n;
    const double scale = std::pow(variance, 1.5);
    return {third / scale,
            3 / (n * scale) * ((z.array().square() - variance).matrix() - third / variance * z)};
}

ga::Descriptor<Genome> descriptor(const std::string& name, Feature (*feature)(const Profile&, double),
                                  double lower, double upper, const Grid& grid) {
    return {name, [=](const Genome& genome) { return feature(sample(genome, grid), grid.length).value; },
            lower, upper,
            [=](const Genome& genome) {
                const Eigen::RowVectorXd by_gene =
                    pulled_back(feature(sample(genome, grid), grid.length).by_height, genome, grid);
                return std::vector<double>(by_gene.begin(), by_gene.end());
            }};
}

} // namespace

std::vector<ga::Descriptor<Genome>> surface_descriptors(const Grid& grid) {
    return {descriptor("height", height, -5, -1, grid), descriptor("slope", slope, -4, 0, grid),
            descriptor("wavelength", wavelength, -2, 0.5, grid),
            descriptor("skewness", skewness, -2, 2, grid)};
}

} // namespace rough
