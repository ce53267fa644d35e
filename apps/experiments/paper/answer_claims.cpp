#include "apps/experiments/paper/claims.hpp"
#include "apps/experiments/paper/lookup.hpp"
#include "apps/report/units.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/profile/spectrum.hpp"

#include <cmath>
#include <functional>

namespace app {

namespace {

/// The three answers to one target, in the order SOG, GCO, CCO, with what the claims compare.
struct Trio {
    std::string title;
    std::array<const VariantRun*, 3> variants;
    std::array<Eigen::VectorXd, 3> heights;
    std::array<rough::Spectrum, 3> spectra;
};

std::vector<Trio> trios_of(const PaperRun& run) {
    std::vector<Trio> trios;
    for (const TargetRun& target : run.targets) {
        Trio trio{target.title, {}, {}, {}};
        bool complete = true;
        for (std::size_t i = 0; i < algorithms.size(); ++i) {
            trio.variants[i] = find_variant(target, algorithms[i].name);
            complete = complete && trio.variants[i];
            if (!complete)
                break;
            const rough::Profile profile = sample(trio.variants[i]->answer.genome, run.model.grid);
            trio.heights[i] = profile.heights;
            trio.spectra[i] = continuous_spectrum(profile);
        }
        if (complete)
            trios.push_back(std::move(trio));
    }
    return trios;
}

constexpr std::array<std::pair<std::size_t, std::size_t>, 3> couples{{{0, 1}, {0, 2}, {1, 2}}};

std::string named(const std::array<double, 3>& of_couples, int digits = 2) {
    std::string words;
    for (std::size_t c = 0; c < couples.size(); ++c)
        words += (c ? ", " : "") + std::string(algorithms[couples[c].first].title) + "–" +
                 algorithms[couples[c].second].title + " " + readable(of_couples[c], digits);
    return words;
}

template <class Compare>
std::array<double, 3> of_couples(const Trio& trio, Compare compare) {
    std::array<double, 3> values{};
    for (std::size_t c = 0; c < couples.size(); ++c)
        values[c] = compare(trio, couples[c].first, couples[c].second);
    return values;
}

double area_apart(const Trio& trio, std::size_t a, std::size_t b) {
    return gap(area_against_pressure(trio.variants[a]->answer.response),
               area_against_pressure(trio.variants[b]->answer.response));
}

double alike(const Trio& trio, std::size_t a, std::size_t b) {
    return rough::pearson(trio.heights[a], trio.heights[b]);
}

/// log10 of a spectrum's power octave by octave, from the longest wave on. In octaves, as the lines of two
/// series of different gamma never fall on each other.
Eigen::VectorXd octave_powers(const rough::Spectrum& spectrum) {
    std::vector<double> powers;
    for (Eigen::Index first = 1; 2 * first - 1 <= spectrum.density.size(); first *= 2)
        powers.push_back(
            std::log10(spectrum.density.segment(first - 1, first).sum() * spectrum.wave_number[0]));
    return Eigen::Map<Eigen::VectorXd>(powers.data(), static_cast<Eigen::Index>(powers.size()));
}

/// How far two answers' powers are apart in the mean of the upper or the lower half of the octaves, as a
/// factor; NaN on a grid too coarse for octaves there.
double power_apart(const Trio& trio, std::size_t a, std::size_t b, bool high) {
    const Eigen::VectorXd apart =
        (octave_powers(trio.spectra[a]) - octave_powers(trio.spectra[b])).cwiseAbs();
    const Eigen::Index half = apart.size() / 2;
    const Eigen::VectorXd part = high ? apart.tail(half) : apart.head(apart.size() - half);
    return part.size() == 0 ? std::numeric_limits<double>::quiet_NaN() : std::pow(10, part.mean());
}

/// Exponent of the power law of wave number that fits the upper half of the octaves' densities best.
double high_exponent(const rough::Spectrum& spectrum) {
    const Eigen::VectorXd powers = octave_powers(spectrum);
    const Eigen::Index half = powers.size() / 2;
    const Eigen::VectorXd octaves =
        Eigen::VectorXd::LinSpaced(half, 0, static_cast<double>(half - 1)) * std::log10(2);
    return rough::slope(octaves, powers.tail(half)) - 1; // an octave's power is its density times its width
}

std::size_t chromosomes(const VariantRun& variant) { return waves(variant.answer.genome).size(); }

/// Nobody knows whether an unknown number is as claimed.
std::optional<bool> if_known(double number, bool as_claimed) {
    return std::isnan(number) ? std::nullopt : std::optional(as_claimed);
}

Claim over_trios(const std::vector<Trio>& trios, Claim claim,
                 const std::function<std::pair<std::string, std::optional<bool>>(const Trio&)>& find) {
    std::vector<std::optional<bool>> holds;
    for (const Trio& trio : trios) {
        const auto [words, held] = find(trio);
        claim.measured += (claim.measured.empty() ? "" : "; ") + trio.title + ": " + words;
        holds.push_back(held);
    }
    claim.measured += claim.measured.empty() ? "Not in this run." : ".";
    claim.verdict = verdict_over(holds);
    return claim;
}

} // namespace

std::vector<Claim> answer_claims(const PaperRun& run) {
    const auto trios = trios_of(run);
    return {
        over_trios(trios,
                   {"Figure 9", "The answers' K(p) overlap the target.", "",
                    "The worst relative misfit of all three is at most 5 %" + both},
                   [](const Trio& trio) {
                       std::string words;
                       bool held = true;
                       for (const VariantRun* variant : trio.variants) {
                           words += (words.empty() ? "off by at most " : ", ") +
                                    percent(1 - variant->similarity, 2);
                           held = held && variant->similarity >= 0.95;
                       }
                       return std::pair(words, held);
                   }),
        over_trios(
            trios,
            {"Figure 9", "A(p) is alike for SOG and GCO only.", "",
             "The largest difference of SOG's and GCO's A is less than half of either's to CCO's" + both},
            [](const Trio& trio) {
                const auto apart = of_couples(trio, area_apart);
                return std::pair("A differs by at most " + named(apart),
                                 2 * apart[0] < apart[1] && 2 * apart[0] < apart[2]);
            }),
        over_trios(trios,
                   {"Section 4.5", "CCO (printed: GCO) makes do with a smaller set of chromosomes.", "",
                    "CCO's answer has fewer chromosomes than GCO's" + both},
                   [](const Trio& trio) {
                       const auto gco = chromosomes(*trio.variants[1]), cco = chromosomes(*trio.variants[2]);
                       return std::pair("GCO " + std::to_string(gco) + ", CCO " + std::to_string(cco),
                                        cco < gco);
                   }),
        over_trios(trios,
                   {"Figure 10", "Peaks and valleys are in similar places.", "",
                    "The heights' correlation is above 0.5 for every two answers" + both},
                   [](const Trio& trio) {
                       const auto r = of_couples(trio, alike);
                       return std::pair("correlation " + named(r), r[0] > 0.5 && r[1] > 0.5 && r[2] > 0.5);
                   }),
        over_trios(trios,
                   {"Figure 10", "CCO's profile approximates GCO's.", "",
                    "Their heights' correlation is above 0.9" + both},
                   [](const Trio& trio) {
                       const double r = alike(trio, 1, 2);
                       return std::pair("correlation " + readable(r), if_known(r, r > 0.9));
                   }),
        over_trios(
            trios,
            {"Figure 11", "SOG's and GCO's spectra match at high frequencies.", "",
             "In the upper half of the octaves their powers differ by a factor under 2 in the mean" + both},
            [](const Trio& trio) {
                const double factor = power_apart(trio, 0, 1, true);
                return std::pair("factor " + readable(factor), if_known(factor, factor < 2));
            }),
        over_trios(trios,
                   {"Figure 11", "They do not match at low frequencies.", "",
                    "In the lower half they differ by a factor of 2 or more" + both},
                   [](const Trio& trio) {
                       const double factor = power_apart(trio, 0, 1, false);
                       return std::pair("factor " + readable(factor), if_known(factor, factor >= 2));
                   }),
        over_trios(trios,
                   {"Figure 11", "CCO's spectrum is flat at high frequencies.", "",
                    "The power law of wave number that fits the upper half of its octaves has an exponent "
                    "between −1 and 1" +
                        both},
                   [](const Trio& trio) {
                       const double exponent = high_exponent(trio.spectra[2]);
                       return std::pair("exponent " + readable(exponent, 2) + " (SOG " +
                                            readable(high_exponent(trio.spectra[0]), 2) + ", GCO " +
                                            readable(high_exponent(trio.spectra[1]), 2) + ")",
                                        if_known(exponent, std::abs(exponent) < 1));
                   }),
    };
}

} // namespace app
