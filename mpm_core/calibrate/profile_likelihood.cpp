#include "calibrate/profile_likelihood.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "calibrate/fit.hpp"

namespace granulaw {

namespace {

constexpr double tolerance = 0.03;  // of sqrt(rise), at an interval's end
constexpr int most_places = 14;

/// One side of a profile.
class Side
{
 public:
  /// `along`: how all unknowns go with this one where the sum of squares stays least, near the minimum.
  Side(const CalibrationProblem& problem, const Minimum& minimum, std::size_t unknown, Coordinates along,
       double end, double first_step)
      : problem_(problem),
        along_(std::move(along)),
        best_(minimum.cost),
        least_(minimum.cost),
        unknown_(unknown),
        start_(minimum.q[static_cast<Eigen::Index>(unknown)]),
        end_(end),
        step_(first_step)
  {
    places_[0] = {0, minimum.q};
  }

  struct End
  {
    double q;
    bool told;
    Coordinates all;  ///< the other unknowns as they fit there
  };
  const std::optional<Coordinates>& better() const { return better_; }
  /// Place at which the square root of the rise reaches `wanted`.
  End reach(double wanted)
  {
    const double length = std::abs(end_ - start_);
    double low = 0, high = -1;  // distances below and above
    for (const auto& [distance, place] : places_) {
      if (place.root_rise <= wanted) low = distance;
      if (place.root_rise > wanted && high < 0) high = distance;
    }
    for (int k = 0; k < most_places; ++k) {
      double next = 0;
      if (high < 0) {
        if (low >= length) return {end_, false, places_[low].q};
        const double here = places_[low].root_rise;
        // the root of the rise goes in proportion to the distance near a minimum
        const double straight =
            here > 0.2 ? low * std::min(3.0, 1.02 * wanted / here) : 3 * std::max(low, step_ / 3);
        next = std::min(length, std::max(straight, 1.05 * low));
      } else {
        const double a = places_[low].root_rise, b = places_[high].root_rise;
        next = low + (high - low) * std::clamp((wanted - a) / (b - a), 0.1, 0.9);
      }
      const double root = rise_at(next);
      (root <= wanted ? low : high) = next;
      if (std::abs(root - wanted) < tolerance * wanted) return {at(next), true, places_[next].q};
    }
    return {at(high < 0 ? low : 0.5 * (low + high)), high >= 0, places_[low].q};
  }

 private:
  struct Place
  {
    double root_rise;
    Coordinates q;
  };
  double at(double distance) const { return start_ + std::copysign(distance, end_ - start_); }
  double rise_at(double distance)
  {
    // from the nearest place known
    auto nearest = places_.begin();
    for (auto it = places_.begin(); it != places_.end(); ++it)
      if (std::abs(it->first - distance) < std::abs(nearest->first - distance)) nearest = it;
    Coordinates q = nearest->second.q;
    // others go on as they went between the minimum and there
    if (nearest->first > 0) {
      const double share = std::clamp(distance / nearest->first - 1, -1.0, 2.0);
      q += share * (nearest->second.q - places_[0].q);
    } else {
      q += (at(distance) - start_) * along_;
    }
    q[static_cast<Eigen::Index>(unknown_)] = at(distance);
    std::vector<bool> fixed(problem_.count(), false);
    fixed[unknown_] = true;
    const Minimum found = minimise(problem_, q, fixed, 12);
    const double root = std::sqrt(std::max(0.0, found.cost - best_));
    places_[distance] = {root, found.q};
    if (found.cost < least_ - 0.05) least_ = found.cost, better_ = found.q;
    return root;
  }

  const CalibrationProblem& problem_;
  Coordinates along_;
  double best_, least_;
  std::optional<Coordinates> better_;
  std::size_t unknown_;
  double start_, end_, step_;
  std::map<double, Place> places_;
};

}  // namespace

ParameterProfile profile_likelihood(const CalibrationProblem& problem, const Minimum& minimum,
                                    std::size_t unknown, const Widening& widening)
{
  const auto u = static_cast<Eigen::Index>(unknown);
  const Range allowed = problem.allowed(unknown, minimum.q);
  const double q = std::clamp(minimum.q[u], allowed.low, allowed.high);
  const Eigen::MatrixXd spread = covariance(minimum);
  const Coordinates along = spread.col(u) / spread(u, u);
  const double sd = std::clamp(std::sqrt(spread(u, u)), 1e-4, 2.0) * std::sqrt(widening.scale);
  ParameterProfile profile;
  profile.value = problem.value(unknown, q);
  Side below(problem, minimum, unknown, along, allowed.low, sd),
      above(problem, minimum, unknown, along, allowed.high, sd);
  const auto fill = [&](Interval& interval, double probability) {
    const double root_rise = widening.deviations(probability);
    const Side::End low = below.reach(root_rise), high = above.reach(root_rise);
    interval = {problem.value(unknown, low.q), problem.value(unknown, high.q), low.told, high.told};
    profile.low95 = low.all, profile.high95 = high.all;
  };
  fill(profile.within68, 0.68);
  fill(profile.within95, 0.95);
  profile.better = below.better() ? below.better() : above.better();
  return profile;
}

}  // namespace granulaw
