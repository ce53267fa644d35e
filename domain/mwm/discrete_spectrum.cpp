#include "domain/mwm/discrete_spectrum.hpp"

#include "domain/mwm/waves.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace rough {

std::vector<SpectralLine> discrete_spectrum(const Genome& genome) {
    std::vector<Wave> all = waves(genome);
    std::sort(all.begin(), all.end(),
              [](const Wave& a, const Wave& b) { return a.wave_number < b.wave_number; });
    std::vector<SpectralLine> lines;
    for (auto wave = all.begin(); wave != all.end();) {
        const double k = wave->wave_number;
        std::complex<double> sum = 0;
        for (; wave != all.end() && wave->wave_number <= k * (1 + 1e-12); ++wave)
            sum += std::polar(1.0, wave->phase) * wave->amplitude;
        lines.push_back({k, std::norm(sum) / 2});
    }
    return lines;
}

} // namespace rough
