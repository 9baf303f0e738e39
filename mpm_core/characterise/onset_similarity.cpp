#include "characterise/onset_similarity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "characterise/fit/fit_curve.hpp"
#include "solver/material/law_table.hpp"

namespace granulaw {

namespace {

/// E*/Y of the spheres that are run.
constexpr double less_stiff = 170, least_stiff = 85;

/// Their slow impact costs the most and shows the least: at 1.25 onsets e is 0.9994. At 2.5, with 17 cells,
/// it takes a sixth of the time; laws differ by 0.0008 in e, 0.45 % in F (E*/Y = 500, yield stress as
/// ep^0.3, from 9e-5 to 1.5e-3 R) and are no further off fresh impacts: 0.0015, 0.57 %.
constexpr double from_onset = 2.5;
constexpr int slow_cells = 17;

/// A tenth of finite_body for the atlas's materials that harden as much on the mean: with them F of laws of a
/// steeply hardening material is within 0.24 % at overlaps of 0.02 R of the less stiff sphere.
constexpr double hardens_nearly_alike = 0.1 * finite_body;

const Material& pole_material(const CharacterisedBody& s)
{
  return s.particle.materials[static_cast<std::size_t>(s.pole_material)];
}

/// A sphere `share` times as stiff, of the same yield stress without rate. Strains go as 1/E*, plastic ones
/// too: hardening is the same at strains over Y/E*.
CharacterisedBody softer_sphere(Material m, double share)
{
  m = with_strains_scaled(m, 1 / share);
  m.youngs_modulus *= share;
  m.rate = {};
  return characterised_body_of(m);
}

/// Linear hardening d(sigma_y)/d(ep) of least squares through the yield stress, over plastic strains up to
/// `strain`; what it misses, largest, over the yield stress.
struct NearlyLinear
{
  double modulus, missed;
};

NearlyLinear linear_hardening(const Material& m, double strain)
{
  constexpr int steps = 50;
  double moment = 0, squares = 0;
  for (int k = 1; k <= steps; ++k) {
    const double ep = strain * k / steps;
    moment += ep * (flow_stress(m, ep) - m.yield_stress), squares += ep * ep;
  }
  NearlyLinear line{moment / squares, 0};
  for (int k = 1; k <= steps; ++k) {
    const double ep = strain * k / steps;
    line.missed = std::max(line.missed, std::abs(flow_stress(m, ep) - m.yield_stress - line.modulus * ep));
  }
  line.missed /= m.yield_stress;
  return line;
}

void require_thick_skin(const CharacterisedBody& body, double first)
{
  // Contact radii to the skin: what lies below changes the elastic part, which the body's own press gives.
  constexpr double least_skin = 3;
  const double skin = least_skin * std::sqrt(2 * first);
  if (body.skin < skin || pole_onset(body) > body.onset)
    fail("contact law",
         "yields at overlaps too small to be run: there the body's law is that of its skin, which must yield "
         "first and be thick",
         fmt::format("onset at delta/R = {:.2g}, at the pole {:.2g}, skin {:.2g} R", body.onset,
                     pole_onset(body), body.skin),
         fmt::format("an onset of about 1e-4 or more, or a skin of {:.2g} R", skin));
}

}  // namespace

OnsetSimilarity::OnsetSimilarity(const CharacterisedBody& body, const Needs& needs, const Atlas* atlas)
    : body_(body), needs_(needs), atlas_(atlas), is_sphere_(body.particle.is_homogeneous_sphere())
{
  require_thick_skin(body, needs.first);
  const Material& m = pole_material(body);
  const double stiffness = body.scale.stress / m.yield_stress;
  // Tabor's representative strain is a fifth of a/R; near the edge of the contact it is more than twice that
  const NearlyLinear line = linear_hardening(m, 0.5 * std::sqrt(2 * needs.first));
  ratios_ = {stiffness, m.poisson_ratio, line.modulus / m.youngs_modulus};
  const auto known = [&](double k) {
    if (!atlas) return false;
    MaterialRatios ratios = ratios_;
    ratios.stiffness = std::min(k, atlas->grid().stiffnesses.back());
    return atlas->why_not(ratios).empty();
  };
  const auto require_reach = [&](double k) {
    // where the stiffest law at hand ends: delta/delta_onset, at which laws are alike, goes as (E*/Y)^2
    const double stiffest = k * std::sqrt(Atlas::depth / needs.first);
    if (stiffness > stiffest)
      fail("contact law",
           fmt::format("yields at overlaps too small to be run, and no law of a sphere of E*/Y = {:g} reaches from "
                       "there to the shallowest run, {:.2g} R",
                       k, needs.first),
           fmt::format("E*/Y = {:.4g}", stiffness), fmt::format("up to {:.3g}", stiffest));
  };
  how_ = fmt::format("below delta/R = {:.2g}: ", needs.first);

  constexpr double nearly = 0.003;  // of the yield stress: a third of the tolerance of most laws
  if (known(stiffness) && line.missed < nearly) {
    require_reach(atlas->grid().stiffnesses.back());
    how_ += fmt::format("atlas, at linear hardening H/E = {:.3g}", ratios_.hardening);
    return;
  }
  knows_term_ = known(stiffness) && known(less_stiff);
  require_reach(less_stiff);
  how_ += fmt::format("at the same delta/delta_onset of a sphere of E*/Y = {:g}, ", less_stiff);
  how_ += knows_term_ ? "its difference from the atlas"
                      : fmt::format("its difference by one of {:g}", least_stiff);
  const auto add = [&](double k) {
    Sphere sphere;
    sphere.body = softer_sphere(m, k / stiffness);
    // delta/delta_onset that it must reach: the rest of a body that is no sphere changes the overlap
    const double reach = (is_sphere_ ? 1.2 : 2.0) * needs.first / body.onset;
    sphere.depth = std::clamp(reach * sphere.body.onset, 0.0075, 0.5);
    SamplingRange range;
    range.depth = sphere.depth, range.fastest = 0, range.stops = 2, range.tolerance = needs.tolerance;
    range.from_onset = from_onset;
    sphere.plan = plan_sampling(sphere.body, range);
    sphere.plan.resolution = slow_cells;
    spheres_.push_back(std::move(sphere));
  };
  add(less_stiff);
  if (!knows_term_) add(least_stiff);
  if (is_sphere_) return;
  // an elastic sphere's correction is the same at any stiffness; a sphere's own is the body's
  Sphere elastic;
  const CharacterisedBody skin = softer_sphere(m, 1);
  elastic.body = skin.elastic();
  elastic.plan.presses.push_back(elastic_press_of(skin, needs.press_cells));
  spheres_.push_back(std::move(elastic));
  runs_elastic_ = true;
}

/// Beyond the stiffest material of the atlas it goes on, linear in Y/E*.
ShapePrior OnsetSimilarity::of_atlas(double stiffness) const
{
  const auto onset_of = [&](double k) { return characterised_body_of(k, ratios_.poisson_ratio, 0).onset; };
  const auto known = [&](double k) {
    MaterialRatios ratios = ratios_;
    ratios.stiffness = k;
    return ShapePrior::of(atlas_->shape(ratios), onset_of(k), Atlas::depth, Atlas::depth);
  };
  const double stiffest = atlas_->grid().stiffnesses.back();
  if (stiffness <= stiffest) return known(stiffness);
  return similar_by_two(onset_of(stiffness), Atlas::depth, known(stiffest), known(0.5 * stiffest));
}

ShapePrior OnsetSimilarity::of_runs(const Sphere& sphere, const ElasticCorrection* elastic) const
{
  const double onset = sphere.body.onset;
  const LawShape shape =
      elastic ? fit_shape(sphere.found, *elastic, onset, sphere.depth).shape : LawShape::zero();
  return ShapePrior::of(shape, onset, sphere.depth, sphere.depth);
}

/// The prior of a sphere of the pole's material.
ShapePrior OnsetSimilarity::of_sphere(const ElasticCorrection* elastic) const
{
  const double onset = body_.onset, depth = needs_.depth;
  if (spheres_.empty()) return at_range(onset, depth, of_atlas(ratios_.stiffness));
  const ShapePrior softer = of_runs(spheres_[0], elastic);
  if (knows_term_)
    return similar_by_change(onset, depth, softer, of_atlas(less_stiff), of_atlas(ratios_.stiffness),
                             hardens_nearly_alike);
  return similar_by_two(onset, depth, softer, of_runs(spheres_[1], elastic));
}

bool OnsetSimilarity::spares_first() const
{
  const double error = std::isinf(body_.skin) ? of_sphere(nullptr).error_at(needs_.first)
                                              : std::numeric_limits<double>::infinity();
  return ShapePrior::run_error * error <= needs_.tolerance;
}

ShapePrior OnsetSimilarity::prior(const ElasticCorrection& elastic) const
{
  ElasticCorrection of_sphere_alone = elastic;
  if (runs_elastic_) {
    const std::vector<ContactRecord>& press = spheres_.back().found.slow;
    if (press.empty()) fail("contact law", "the elastic press of a sphere of its skin failed");
    of_sphere_alone = fit_elastic(press.front());
  }
  ShapePrior prior = of_sphere(&of_sphere_alone);
  if (!is_sphere_) prior.shape = prior.shape.as_skin_of(elastic, 2 * needs_.first);
  prior.end_at(needs_.first);
  return prior;
}

}  // namespace granulaw
