#include "domain/target/similarity_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rough {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// What rounding and an iterative solver's tolerance could add to a similarity.
constexpr double rounding = 1e-9;
/// The last pressure is bounded within a range that is looked at in so many parts, the last of which takes
/// all beyond `farthest` times the least.
constexpr int parts = 4;
constexpr double farthest = 4;

/// How far, relative, a foretold secant may be off at the last load, how much farther where there is hardly
/// any, and the sum of those to come: an estimate (domain/accuracy/README.md).
constexpr double margin_loaded = 0.03, margin_light = 0.3, margin_rest = 0.06;

/// The secant curve of the solved steps (x: mean pressures, y: secants) and the bounds of those to come, with
/// the last pressure between two values.
class Halfway {
  public:
    Halfway(const std::vector<LoadStep>& first, std::size_t count, double stiffest,
            const std::vector<double>& foretold)
        : step_(first[0].displacement), left_(count - first.size()), pressure_(first.back().pressure),
          x_(first.size()), y_(first.size()), lowest_(left_, first.back().tangent_stiffness),
          highest_(left_, stiffest), least_at_(left_), most_at_(left_), least_(left_), most_(left_) {
        double pressure = 0, displacement = 0;
        for (std::size_t i = 0; i < first.size(); ++i) {
            x_[i] = 0.5 * (first[i].pressure + pressure);
            y_[i] = (first[i].pressure - pressure) / (first[i].displacement - displacement);
            pressure = first[i].pressure;
            displacement = first[i].displacement;
        }
        if (!foretold.empty())
            trust(foretold);
        least_last_ = std::max(least_last_, pressure_ + step_ * sum(lowest_));
        most_last_ = std::min(most_last_, pressure_ + step_ * sum(highest_));
    }

    double least_last() const { return least_last_; }
    double most_last() const { return std::max(least_last_, most_last_); }

    /// Bounds the secants to come by what they must sum up to; none is less than the one before.
    void suppose(double least_last, double most_last) {
        const double least_sum = (least_last - pressure_) / step_, most_sum = (most_last - pressure_) / step_;
        double least_before = pressure_, most_before = pressure_, floor = lowest_.front();
        double lows = 0, highs = 0, low_rest = sum(lowest_), high_rest = sum(highest_);
        for (std::size_t k = 0; k < left_; ++k) {
            const auto before = static_cast<double>(k), after = static_cast<double>(left_ - 1 - k);
            const double lows_before = lows;
            lows += lowest_[k];
            highs += highest_[k];
            low_rest -= lowest_[k];
            high_rest = k + 1 == left_ ? 0 : std::isinf(high_rest) ? infinite : high_rest - highest_[k];
            floor = std::max({floor, lowest_[k], (least_sum - high_rest) / (before + 1)});
            least_[k] = floor;
            most_[k] = std::min(highest_[k], (most_sum - lows_before) / (after + 1));
            const double least_pressure = std::max(pressure_ + step_ * lows, least_last - step_ * high_rest);
            const double most_pressure =
                std::min({pressure_ + (before + 1) / static_cast<double>(left_) * (most_last - pressure_),
                          pressure_ + step_ * highs, most_last - step_ * low_rest});
            least_at_[k] = 0.5 * (least_before + least_pressure);
            most_at_[k] = 0.5 * (most_before + most_pressure);
            least_before = least_pressure;
            most_before = most_pressure;
        }
    }

    /// Bounds of y at x: it never decreases.
    double least(double x) const {
        if (x <= x_.back())
            return known(x);
        const auto beyond = std::upper_bound(most_at_.begin(), most_at_.end(), x);
        return beyond == most_at_.begin() ? y_.back()
                                          : least_[static_cast<std::size_t>(beyond - most_at_.begin()) - 1];
    }
    double most(double x) const {
        if (x <= x_.back())
            return known(x);
        const auto beyond = std::lower_bound(least_at_.begin(), least_at_.end(), x);
        return beyond == least_at_.end() ? infinite
                                         : most_[static_cast<std::size_t>(beyond - least_at_.begin())];
    }

  private:
    static double sum(const std::vector<double>& all) { return std::accumulate(all.begin(), all.end(), 0.0); }

    /// Narrows the bounds to the margins around what is foretold, where the two agree.
    void trust(const std::vector<double>& foretold) {
        const double whole = sum(foretold);
        double far = 0, rest = 0;
        for (std::size_t i = 0; i < foretold.size() - left_; ++i)
            far += foretold[i];
        for (std::size_t k = 0; k < left_; ++k) {
            const double secant = foretold[foretold.size() - left_ + k];
            far += secant;
            rest += secant;
            const double light = 1 - far / whole, margin = margin_loaded + margin_light * light * light;
            const double low = std::max(lowest_[k], secant * (1 - margin)),
                         high = std::min(highest_[k], secant * (1 + margin));
            if (low <= high) {
                lowest_[k] = low;
                highest_[k] = high;
            }
        }
        least_last_ = pressure_ + step_ * rest * (1 - margin_rest);
        most_last_ = pressure_ + step_ * rest * (1 + margin_rest);
    }
    double known(double x) const {
        const auto above = std::upper_bound(x_.begin(), x_.end(), x) - x_.begin();
        const auto i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above, 1, std::ssize(x_) - 1));
        return y_[i - 1] + (x - x_[i - 1]) / (x_[i] - x_[i - 1]) * (y_[i] - y_[i - 1]);
    }

    double step_;
    std::size_t left_;
    double pressure_, least_last_ = 0, most_last_ = infinite;
    std::vector<double> x_, y_;
    std::vector<double> lowest_, highest_;                  ///< of each secant to come, whatever the sum
    std::vector<double> least_at_, most_at_, least_, most_; ///< of each secant to come
};

} // namespace

void SimilarityBound::add(const Target& target, const std::vector<Index>& points) {
    for (const Index k : points)
        points_.push_back(
            {target.x[k] / max_pressure_, (target.has_band() ? target.lower : target.y)[k] / target.y[k],
             (target.has_band() ? target.upper : target.y)[k] / target.y[k], target.y[k], target.weight});
}

double SimilarityBound::operator()(const std::vector<LoadStep>& first, std::size_t count,
                                   const std::vector<double>& foretold) const {
    Halfway curve(first, count, stiffest_, foretold);
    const double least = curve.least_last(), most = curve.most_last();
    const double ratio = std::pow(std::min(most / least, farthest), 1.0 / parts);
    double best = -infinite;
    for (int part = 0; part < parts; ++part) {
        const double from = least * std::pow(ratio, part);
        const double to = part + 1 < parts ? from * ratio : most;
        curve.suppose(from, to);
        double worst = 0;
        for (auto point = points_.begin(); point != points_.end() && 1 - worst > best; ++point)
            worst = std::max({worst,
                              point->weight * (curve.least(point->at * from) / point->wanted - point->upper),
                              point->weight * (point->lower - curve.most(point->at * to) / point->wanted)});
        best = std::max(best, 1 - worst);
    }
    return best + rounding;
}

} // namespace rough
