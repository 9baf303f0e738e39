#include "characterise/body/law_body.hpp"

#include "characterise/body/law_material.hpp"
#include "scratch_folder.hpp"
#include "solver/shape/shapes.hpp"
#include "some_materials.hpp"

namespace granulaw::law_body_test {

TEST(LawMaterial, KeepsTheFiveNumbersBothWays)
{
  Material m = soft_powder();
  m.hardening_modulus = 1e7;
  const LawMaterial law = law_material("powder", m);
  EXPECT_EQ(law.name, "powder");
  EXPECT_EQ(law.e_star(), m.e_star());
  const Material back = material_of(law);
  EXPECT_EQ(back.density, m.density);
  EXPECT_EQ(back.youngs_modulus, m.youngs_modulus);
  EXPECT_EQ(back.poisson_ratio, m.poisson_ratio);
  EXPECT_EQ(back.yield_stress, m.yield_stress);
  EXPECT_EQ(back.hardening_modulus, m.hardening_modulus);
  EXPECT_NEAR(speed_unit(law), 258.2, 0.1);  // sqrt(1e8/1500) m/s
}

/// Nodes lie so close that straight lines between them are the flow curve.
TEST(LawMaterial, KeepsTheFlowStressOfHardeningThatIsNotLinear)
{
  Material m = soft_powder();
  EXPECT_TRUE(law_material("powder", m).flow.strain.empty());
  for (const FlowLaw& hardening : {FlowLaw{"voce", {{"saturation_stress", {2e8}}, {"strain", {0.1}}}},
                                   FlowLaw{"johnson-cook", {{"strength", {1.5e8}}, {"exponent", {0.3}}}}}) {
    m.hardening = hardening;
    const FlowNodes flow = law_material("powder", m).flow;
    EXPECT_EQ(flow.at(0), m.yield_stress);
    for (double strain = 1e-3; strain < flow.strain.back(); strain *= 1.1)
      EXPECT_NEAR(flow.at(strain) / flow_stress(m, strain), 1, 2e-3) << hardening.name << " " << strain;
    EXPECT_EQ(flow.at(100), flow.stress.back());
  }
}

TEST(LawBody, AMaterialIsItsSphere)
{
  const LawBody body = law_body("powder", some_materials());
  EXPECT_EQ(body.material.name, "powder");
  EXPECT_EQ(body.body, sphere_name);
  EXPECT_TRUE(body.is_plain_sphere());
  EXPECT_EQ(body.hash.size(), 16u);
}

TEST(LawBody, AHomogeneousParticleHasItsMaterialsLaw)
{
  const Materials m = some_materials();
  const LawBody grain = law_body("grain", m);
  EXPECT_EQ(grain.material.name, "grain");
  EXPECT_TRUE(grain.is_plain_sphere());
  EXPECT_EQ(grain.hash, law_body("powder", m).hash);
}

TEST(LawBody, ALayeredParticleHasItsOwnLawAndItsWeakestYieldStress)
{
  const LawBody body = law_body("coated", some_materials());
  EXPECT_EQ(body.body, "coated");
  EXPECT_FALSE(body.is_plain_sphere());
  EXPECT_EQ(body.material.youngs_modulus, glass().youngs_modulus);  // of the pole
  EXPECT_NEAR(body.material.yield_stress, 100e6, 1e-6 * 100e6);     // of the core
}

/// The law is that of its material's sphere; layers and rates are no sphere's at every radius.
TEST(LawBody, AShapeIsASphereOfItsMaterial)
{
  Materials m = some_materials();
  Particle pebble;
  pebble.materials = {soft_powder()};
  pebble.shape = ellipsoid_shape(Vector3(1e-3, 1.2e-3, 1.5e-3));
  pebble.radius = 1.2e-3;
  m.particles["pebble"] = pebble;
  const LawBody body = law_body("pebble", m);
  EXPECT_TRUE(body.is_plain_sphere());
  EXPECT_TRUE(body.shape.has_value());
  EXPECT_EQ(body.hash, law_body("powder", m).hash);
  m.particles["pebble"].layers = {{1e-4, 0}};
  expect_error("[particle.pebble]: has a shape in three dimensions and layers",
               [&] { law_body("pebble", m); });
  m.particles["pebble"] = pebble;
  m.particles["pebble"].materials = {rate_dependent_powder()};
  expect_error("depends on the rate", [&] { law_body("pebble", m); });
}

TEST(LawBody, ARateNeedsAParticle)
{
  Materials m = some_materials();
  m.materials["slow"] = rate_dependent_powder();
  expect_error("test: [material.slow]: its yield stress depends on the rate ('cowper-symonds')",
               [&] { law_body("slow", m); });
  expect_error("particle's size: say PARTICLE", [&] { law_body("slow", m, "say PARTICLE"); });
  EXPECT_TRUE(law_body("rated", m).characterised.rate_dependent());
}

TEST(LawBody, AnotherYieldSurfaceIsRefused)
{
  Materials m = some_materials();
  m.materials.at("powder").yield_surface = {"drucker-prager",
                                            {{"friction_angle", {30}}, {"dilatancy_angle", {0}}}};
  m.particles.at("grain").materials.front() = m.materials.at("powder");
  expect_error("[material.powder]: 'yield_surface'", [&] { law_body("powder", m); });
  expect_error("[particle.grain]: 'yield_surface'", [&] { law_body("grain", m); });
}

TEST(LawBody, TheHashTellsEveryNumber)
{
  const auto hash = [](const Material& m) { return material_hash(characterised_body_of(m), m); };
  const std::string reference = hash(soft_powder());
  // the law does not depend on E alone, the file does: provenance is of the file
  for (double Material::*number : {&Material::density, &Material::youngs_modulus, &Material::poisson_ratio,
                                   &Material::yield_stress, &Material::hardening_modulus}) {
    Material other = soft_powder();
    other.*number = other.*number * (1 + 1e-15) + 1e-12;
    EXPECT_NE(hash(other), reference);
  }
  Material voce = soft_powder();
  voce.hardening = {"voce", {{"saturation_stress", {200e6}}, {"strain", {0.1}}}};
  EXPECT_NE(hash(voce), reference);
}

}  // namespace granulaw::law_body_test
