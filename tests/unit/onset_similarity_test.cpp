#include "characterise/atlas_file.hpp"
#include "characterise/onset_similarity.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"

namespace granulaw::onset_similarity_test {

/// Less stiff spheres are run only where the atlas does not suffice.
TEST(OnsetSimilarity, RunsWhatTheAtlasDoesNotTell)
{
  const Atlas atlas = read_atlas(GRANULAW_ATLAS_FILE);
  const auto sphere = [](const FlowLaw& hardening, double modulus) {
    Material m;
    m.density = 1200, m.youngs_modulus = 9.1e9, m.poisson_ratio = 0.3, m.yield_stress = 2e7;
    m.hardening = hardening, m.hardening_modulus = modulus;
    return characterised_body_of(m);
  };
  const CharacterisedBody linear = sphere({}, 9.1e7),
                          voce = sphere({"voce", {{"saturation_stress", {3e7}}, {"strain", {0.1}}}}, 0),
                          steep = sphere({"johnson-cook", {{"strength", {2.6e7}}, {"exponent", {0.3}}}}, 0);
  const auto spheres = [](const CharacterisedBody& body, const Atlas* from) {
    OnsetSimilarity::Needs needs;
    needs.first = 2e-4, needs.depth = 0.2;
    return OnsetSimilarity(body, needs, from).spheres();
  };
  EXPECT_EQ(spheres(linear, &atlas).size(), 0u);
  EXPECT_EQ(spheres(voce, &atlas).size(), 0u);  // straight as far as these overlaps strain it
  EXPECT_EQ(spheres(steep, &atlas).size(), 1u);
  EXPECT_EQ(spheres(linear, nullptr).size(), 2u);
  for (const OnsetSimilarity::Sphere& s : spheres(steep, nullptr)) {
    EXPECT_GE(s.depth, 2e-4 * s.body.onset / steep.onset);  // as deep over the onset
    for (const double v : s.plan.slow_impacts) EXPECT_GT(expected_depth(v, s.body), 2 * s.body.onset);
  }
}

/// Two spheres of E*/Y = 170 and 85 leave 0.5 % of F of one of 500 at 2e-4 R, and 6 % of one of 1500, as the
/// atlas's laws of the four show.
TEST(OnsetSimilarity, SparesNoRunThatItsSpheresCannotTell)
{
  OnsetSimilarity::Needs needs;
  needs.first = 2e-4, needs.depth = 0.2, needs.tolerance = 0.01;
  EXPECT_TRUE(OnsetSimilarity(characterised_body_of(500, 0.3, 0.01), needs, nullptr).spares_first());
  EXPECT_FALSE(OnsetSimilarity(characterised_body_of(1500, 0.3, 0.01), needs, nullptr).spares_first());
  EXPECT_FALSE(OnsetSimilarity(characterised_body_of(5000, 0.3, 0.01), needs, nullptr).spares_first());
  // the law of E*/Y = 170 ends at 0.5 R, which is 2e-4 R at sqrt(0.5/2e-4) = 50 times the stiffness
  EXPECT_THROW(OnsetSimilarity(characterised_body_of(8600, 0.3, 0.01), needs, nullptr), Error);
  EXPECT_NO_THROW(OnsetSimilarity(characterised_body_of(8400, 0.3, 0.01), needs, nullptr));
  needs.tolerance = 0.005;
  EXPECT_FALSE(OnsetSimilarity(characterised_body_of(500, 0.3, 0.01), needs, nullptr).spares_first());
}

}  // namespace granulaw::onset_similarity_test
