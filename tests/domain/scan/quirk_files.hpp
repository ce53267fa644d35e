#pragma once

#include <string>
#include <vector>

/// A small file with a quirk of real scans. All contain the same measured profile.
struct QuirkFile {
    std::string quirk;
    std::string bytes;
    std::string unit = {};
    double spacing = 0;
};

/// The profile in every quirk file: heights in mm at every 0.5 µm.
inline const std::vector<double> quirk_heights{0.001, -0.0025, 0.003, 0.0045, -0.001, 0.0005, 0.002, -0.0015};
inline constexpr double quirk_spacing = 0.0005;

std::vector<QuirkFile> quirk_files();
