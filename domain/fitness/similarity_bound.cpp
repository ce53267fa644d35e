#include "domain/fitness/similarity_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rough {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// What rounding and an iterative solver's tolerance could add to a similarity.
constexpr double rounding = 1e-9;
/// The last pressure is bounded within a range that is looked at in so many parts, the last of which takes
/// all beyond `farthest` times the least.
constexpr int parts = 4;
constexpr double farthest = 4;

/// The secant curve of the solved steps (x: mean pressures, y: secants) and the bounds of those to come, with
/// the last pressure between two values.
class Halfway {
  public:
    Halfway(const std::vector<LoadStep>& first, std::size_t count, double stiffest)
        : step_(first[0].displacement), left_(count - first.size()), stiffest_(stiffest),
          pressure_(first.back().pressure), tangent_(first.back().tangent_stiffness), x_(first.size()),
          y_(first.size()), least_at_(left_), most_at_(left_), least_(left_), most_(left_) {
        double pressure = 0, displacement = 0;
        for (std::size_t i = 0; i < first.size(); ++i) {
            x_[i] = 0.5 * (first[i].pressure + pressure);
            y_[i] = (first[i].pressure - pressure) / (first[i].displacement - displacement);
            pressure = first[i].pressure;
            displacement = first[i].displacement;
        }
    }

    double least_last() const { return pressure_ + way() * tangent_; }
    double most_last() const { return pressure_ + way() * stiffest_; }

    /// Bounds the secants to come, i = 1..left, by what they must sum up to.
    void suppose(double least_last, double most_last) {
        const double least_sum = (least_last - pressure_) / step_, most_sum = (most_last - pressure_) / step_;
        double least_before = pressure_, most_before = pressure_, floor = tangent_;
        for (std::size_t k = 0; k < left_; ++k) {
            const auto before = static_cast<double>(k), after = static_cast<double>(left_ - 1 - k);
            const double rest = after == 0 ? 0 : after * stiffest_;
            floor = std::max(floor, (least_sum - rest) / (before + 1));
            least_[k] = floor;
            most_[k] = std::min(stiffest_, (most_sum - before * tangent_) / (after + 1));
            const double least_pressure =
                std::max(pressure_ + (before + 1) * step_ * tangent_, least_last - rest * step_);
            const double most_pressure =
                pressure_ + (before + 1) / static_cast<double>(left_) * (most_last - pressure_);
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
    double way() const { return static_cast<double>(left_) * step_; }
    double known(double x) const {
        const auto above = std::upper_bound(x_.begin(), x_.end(), x) - x_.begin();
        const auto i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above, 1, std::ssize(x_) - 1));
        return y_[i - 1] + (x - x_[i - 1]) / (x_[i] - x_[i - 1]) * (y_[i] - y_[i - 1]);
    }

    double step_;
    std::size_t left_;
    double stiffest_, pressure_, tangent_;
    std::vector<double> x_, y_;
    std::vector<double> least_at_, most_at_, least_, most_; ///< of each secant to come
};

} // namespace

SimilarityBound::SimilarityBound(const Target& target, const std::vector<Index>& points, double max_pressure,
                                 double stiffest)
    : stiffest_(stiffest) {
    for (const Index k : points) {
        at_.push_back(target.pressure[k] / max_pressure);
        wanted_.push_back(target.stiffness[k]);
    }
}

double SimilarityBound::operator()(const std::vector<LoadStep>& first, std::size_t count) const {
    Halfway curve(first, count, stiffest_);
    const double least = curve.least_last(), most = std::max(least, curve.most_last());
    const double ratio = std::pow(std::min(most / least, farthest), 1.0 / parts);
    double best = -infinite;
    for (int part = 0; part < parts; ++part) {
        const double from = least * std::pow(ratio, part);
        const double to = part + 1 < parts ? from * ratio : most;
        curve.suppose(from, to);
        double worst = 0;
        for (std::size_t k = 0; k < at_.size() && 1 - worst > best; ++k)
            worst = std::max({worst, curve.least(at_[k] * from) / wanted_[k] - 1,
                              1 - curve.most(at_[k] * to) / wanted_[k]});
        best = std::max(best, 1 - worst);
    }
    return best + rounding;
}

} // namespace rough
