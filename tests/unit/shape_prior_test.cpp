#include "base/larger.hpp"
#include "characterise/body/characterised_body.hpp"
#include "characterise/shape_prior.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "characterise/atlas_file.hpp"

namespace granulaw::shape_prior_test {

constexpr double end = 0.5;

double onset_at(double stiffness)
{
  return 6.3 / (stiffness * stiffness);
}

/// A law that is `of` r = delta/delta_onset, with a term in Y/E*.
ShapePrior law_at(double stiffness, double term, double known = end)
{
  const double onset = onset_at(stiffness);
  LawShape shape = LawShape::zero();
  for (int k = 0; k < LawShape::nodes; ++k) {
    const double log_r = std::log(end / onset) * k / (LawShape::nodes - 1);
    shape.dissipation[static_cast<std::size_t>(k)] = log_r * log_r * (0.02 + term / stiffness);
  }
  shape.elastic.c1 = 1;
  return ShapePrior::of(shape, onset, end, known);
}

/// Largest difference of the dissipation where something is known.
double largest_difference(const ShapePrior& a, const ShapePrior& b)
{
  double largest = 0;
  for (std::size_t k = 0; k < LawShape::nodes; ++k)
    if (std::isfinite(a.error[k]))
      largest = larger(largest, std::abs(a.shape.dissipation[k] - b.shape.dissipation[k]));
  return largest;
}

/// Quantities linear in Y/E* are met by both ways. By two laws of other ranges the dissipation, 2.6 at its
/// end,
/// goes through cubics between nodes: 1e-3. What cancels or stays leaves rounding: 1e-9.
TEST(ShapePrior, MeetsWhatIsLinearInYOverEStar)
{
  const double onset = onset_at(500);
  const ShapePrior sought = law_at(500, 3);
  const ShapePrior two = similar_by_two(onset, end, law_at(170, 3), law_at(85, 3));
  EXPECT_LT(largest_difference(two, sought), 1e-3);
  EXPECT_NEAR(two.shape.elastic.c1, 1, 1e-12);
  const ShapePrior change = similar_by_change(onset, end, law_at(170, 3), law_at(170, 3), law_at(500, 3));
  EXPECT_LT(largest_difference(change, sought), 1e-9);
  EXPECT_LT(largest_difference(at_range(onset, end, sought), sought), 1e-9);
}

/// Beyond a law's own end nothing is known of the sought one; before, its error grows with the overlap.
TEST(ShapePrior, KnowsAsFarAsTheLessStiffLawReaches)
{
  const double onset = onset_at(500), known = 0.01;
  const ShapePrior two = similar_by_two(onset, end, law_at(170, 3), law_at(85, 3, known));
  const double last = known / onset_at(85) * onset;      // at the same delta/delta_onset
  EXPECT_TRUE(std::isfinite(two.error_at(0.8 * last)));  // a node is a fifth of an e-fold
  EXPECT_TRUE(std::isinf(two.error_at(1.25 * last)));
  EXPECT_TRUE(std::isinf(two.error_at(2 * end)));
  for (std::size_t k = 1; k < LawShape::nodes && std::isfinite(two.error[k]); ++k)
    EXPECT_GT(two.error[k], two.error[k - 1]);
  // at the onset that of two laws by their weights
  const double slope = (1. / 500 - 1. / 170) / (1. / 170 - 1. / 85);
  EXPECT_NEAR(two.error[0], ShapePrior::law_error * std::hypot(1 + slope, slope),
              0.03);  // 0.03: the square, 0.2 at the onset, in quadrature
}

/// The atlas's own materials: what similarity states as its standard error is within a factor of two of what
/// it misses, where that is more than the atlas's own errors.
TEST(ShapePrior, StatesWhatItMissesOfTheAtlas)
{
  const Atlas atlas = read_atlas(GRANULAW_ATLAS_FILE);
  const auto law = [&](double stiffness) {
    const MaterialRatios ratios{stiffness, 0.3, 0};
    return ShapePrior::of(atlas.shape(ratios), characterised_body_of(stiffness, 0.3, 0).onset, Atlas::depth,
                          Atlas::depth);
  };
  for (const double stiffness : {500., 1500., 4500.}) {
    const ShapePrior sought = law(stiffness);
    const ShapePrior told = similar_by_two(sought.onset, Atlas::depth, law(170), law(85));
    int compared = 0;
    for (std::size_t k = 0; k < LawShape::nodes; ++k) {
      const double stated = ShapePrior::run_error * told.error[k];
      if (!(stated > 0.015 && stated < 0.1)) continue;  // beyond 0.1 the cube counts, too
      const double missed = std::abs(told.shape.force_reduction[k] - sought.shape.force_reduction[k]);
      EXPECT_GT(missed, 0.5 * stated) << stiffness << " " << k;
      EXPECT_LT(missed, 2 * stated) << stiffness << " " << k;
      ++compared;
    }
    EXPECT_GT(compared, 4);
  }
}

}  // namespace granulaw::shape_prior_test
