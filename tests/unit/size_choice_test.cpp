#include "law/size_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace granulaw::plugin::size_choice_test {

const std::vector<double> shares{0.0, 0.1, 0.25, 0.5};  // a deformable wall, ratios 9, 3 and 1

std::size_t nearest_by_search(double share)
{
  std::size_t best = 0;
  for (std::size_t k = 1; k < shares.size(); ++k)
    if (std::abs(shares[k] - share) < std::abs(shares[best] - share)) best = k;
  return best;
}

TEST(SizeChoice, IsTheNearestShare)
{
  const SizeChoice of_i(ShareOf::i, shares), of_smaller(ShareOf::smaller, shares);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> log_ratio(-4.0, 6.0);
  for (int n = 0; n < 10000; ++n) {
    const double ratio = std::exp(log_ratio(random)), share = 1 / (1 + ratio);
    EXPECT_EQ(of_i.finder(1).nearest(1e-3, 1e-3 * ratio), nearest_by_search(share)) << ratio;
    EXPECT_EQ(of_smaller.finder(1).nearest(1e-3, 1e-3 * ratio), nearest_by_search(std::min(share, 1 - share)))
        << ratio;
  }
}

TEST(SizeChoice, ParticlesMayChangePlaces)
{
  const SizeChoice of_i(ShareOf::i, shares), of_j(ShareOf::j, shares), of_smaller(ShareOf::smaller, shares);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> radius(1e-4, 1e-2);
  for (int n = 0; n < 10000; ++n) {
    // half of them within rounding of a bound: radii 7:1 have the fraction half-way between 0 and 0.25
    const double a = radius(random), b = n % 2 ? radius(random) : a * (0.825 / 0.175);
    EXPECT_EQ(of_i.finder(1).nearest(a, b), of_j.finder(1).nearest(b, a));
    EXPECT_EQ(of_smaller.finder(1).nearest(a, b), of_smaller.finder(1).nearest(b, a));
  }
  for (const Radii& other : {Radii{1e-3, 1e-3}, Radii{2e-3, 7e-3}})
    for (std::size_t k = 0; k < shares.size(); ++k) {
      const Radii own{0.5e-3, 3e-3};
      EXPECT_EQ(of_i.serves(k, own, other), of_j.serves(k, other, own));
      EXPECT_EQ(of_smaller.serves(k, own, other), of_smaller.serves(k, other, own));
      const auto [i, j] = of_i.radii_of(k, own, other);
      EXPECT_EQ(of_j.radii_of(k, other, own), std::pair(j, i));
      EXPECT_EQ(of_smaller.radii_of(k, own, other), of_smaller.radii_of(k, other, own));
    }
}

/// A law that serves no known particles, as those may grow into it: no radius of 0, which no body has.
TEST(SizeChoice, LawThatServesNobodyIsResolvedAtItsOwnShare)
{
  constexpr double wall = std::numeric_limits<double>::infinity();
  const std::vector<double> with_walls{0.0, 0.25,
                                       1.0};  // deformable walls of the partner's material and of its own
  const Radii alike{1e-3, 1e-3};
  const SizeChoice of_i(ShareOf::i, with_walls), of_j(ShareOf::j, with_walls);
  EXPECT_EQ(of_i.radii_of(0, alike, alike), std::pair(1.0, wall));
  EXPECT_EQ(of_i.radii_of(2, alike, alike), std::pair(wall, 1.0));
  EXPECT_EQ(of_j.radii_of(0, alike, alike), std::pair(wall, 1.0));
  EXPECT_EQ(of_j.radii_of(2, alike, alike), std::pair(1.0, wall));
}

TEST(SizeChoice, OneSizeOfEachTypeIsResolvedAtItsOwnRadii)
{
  const SizeChoice choice(ShareOf::j, shares);
  const Radii i{4e-3, 4e-3}, j{1e-3, 1e-3};
  const std::size_t k = choice.finder(1).nearest(4e-3, 1e-3);
  EXPECT_EQ(k, 2u);  // share 0.2
  for (std::size_t other = 0; other < choice.count(); ++other)
    EXPECT_EQ(choice.serves(other, i, j), other == k);
  const auto [radius_i, radius_j] = choice.radii_of(k, i, j);
  EXPECT_NEAR(radius_i / radius_j, 4.0, 1e-14);
}

TEST(SizeChoice, ALawIsResolvedInTheMiddleOfWhatItServes)
{
  const SizeChoice choice(ShareOf::i, shares);
  const Radii i{1e-3, 1e-3}, j{1e-3, 4e-3};  // shares 0.2 to 0.5: on both sides of 0.375
  const auto share = [&](std::size_t k) { return choice.radii_of(k, i, j).first; };
  EXPECT_NEAR(share(2), 0.5 * (0.2 + 0.375), 1e-14);
  EXPECT_NEAR(share(3), 0.5 * (0.375 + 0.5), 1e-14);
  EXPECT_FALSE(choice.serves(1, i, j));
  EXPECT_EQ(share(1), 0.1);  // none: at its own
  EXPECT_EQ(choice.radii_of(0, i, j), std::pair(1.0, std::numeric_limits<double>::infinity()));
}

TEST(SizeChoice, UnknownSizesAreServedByNone)
{
  const SizeChoice choice(ShareOf::smaller, shares);
  for (std::size_t k = 0; k < choice.count(); ++k) {
    EXPECT_FALSE(choice.serves(k, Radii{}, {1e-3, 1e-3}));
    const auto [own, other] = choice.radii_of(k, Radii{}, {1e-3, 1e-3});
    EXPECT_EQ(1.0 / (1.0 + other / own), shares[k]);
  }
}

}  // namespace granulaw::plugin::size_choice_test
