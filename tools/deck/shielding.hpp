#pragma once

#include <vector>

#include "deck/geometry.hpp"

namespace granulaw::deck {

/// Equal spheres that fall from rest, all at once, on a floor across gravity.
struct Cloud
{
  std::vector<Vec3> centres;  ///< m, at the start
  double radius = 0;          ///< m
  double g = 0;               ///< m/s^2
  std::size_t axis = 2;       ///< along gravity
  double up = 1;              ///< +1 or -1: the way up along `axis`
  double floor = 0;           ///< m, coordinate of the floor on `axis`
  Box domain;                 ///< m; its sides are used where `periodic`
  std::array<bool, 3> periodic{};
};

/// True if the spheres of each column lie aside of each other as chance would have it (at most 0.1 between
/// the cumulative shares of squared distances and even ones; 100 pairs at least): not so in a lattice, where
/// hits are head-on or miss.
bool at_random(const Cloud& cloud);

/// Speed, m/s, that `expected` impacts on the floor exceed in one run, in the mean: the cloud shields its
/// floor.
///
/// A sphere with m others in its column (centres below its own, less than a diameter aside) reaches the floor
/// through m collisions. In one of equal spheres, with the line of centres at random over the cross-section,
/// one leaves with the fraction x of the vertical speed and the other with 1 - x, x uniform in 0..1 (elastic:
/// sin^2 of the angle of impact; inelastic ones spread less). So each sphere becomes 2^m carriers of its
/// speed v, each the product of m uniform numbers: 2^m P(m, ln(v/u)) of them exceed u, P the regularised
/// incomplete gamma function. A sphere with none below lands at v itself. Left out: falling on from where
/// they met, spheres that drift out of a column or into it.
double landing_speed(const Cloud& cloud, double expected = 0.01);

}  // namespace granulaw::deck
