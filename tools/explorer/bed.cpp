#include <optional>

#include "base/error.hpp"
#include "deck/laws_at_hand.hpp"
#include "deck/soften.hpp"
#include "json_output.hpp"
#include "request.hpp"

namespace granulaw {

namespace {

/// Two particles of each body on a floor: rigid, or of the partner's material where that is a deformable wall.
deck::Scene scene_of(const Request& r)
{
  deck::Scene scene;
  scene.deck = "the bed";
  scene.gravity = {0, 0, -9.81};
  const auto add = [&](int type, double radius, double density) {
    deck::Source source;
    source.type = type, source.radius_min = source.radius_max = radius, source.density = density, source.count = 2;
    scene.sources.push_back(source);
  };
  add(1, r.radius, r.first.density);
  if (r.partner == Request::Partner::sphere) add(2, r.radius2, r.second.density);
  deck::Wall floor;
  floor.box = {{0, 0, 0}, {0, 0, 0}};
  floor.deformable = r.partner == Request::Partner::thick_wall;
  floor.type = floor.deformable ? 2 : 1;
  scene.walls = {floor};
  return scene;
}

/// The laws of the last materials: a bed with another speed or radius makes none.
const deck::PlanOptions& laws_for(const Atlas& atlas, const Request& r)
{
  static std::string last;
  static deck::PlanOptions options;
  const std::string key = r.key();
  if (key != last) {
    options = {};
    set_contact_law(options, {}, std::nullopt, atlas);
    options.materials = {{1, r.first}, {2, r.second}};
    last = key;
  }
  return options;
}

Json pair_json(const deck::PairPlan& p)
{
  return {{"materials", {p.meeting.name_a, p.meeting.name_b}}, {"wall", p.meeting.wall}, {"onset_speed_m_per_s", json_number(p.onset)},
      {"damage_number_max", json_number(p.damage_number)}, {"overlap_over_radius_max", json_number(p.overlap)},
      {"depth", json_number(p.depth)},  // of each sphere of two that are alike, and at a rigid wall: over its radius
      {"time_step_s", json_number(p.time_step)}, {"needs_table", p.needs_table}};
}

}  // namespace

Json bed_json(const Atlas& atlas, const Request& r, double height)
{
  if (!(height > 0)) fail("bed", "its height cannot be used", fmt::format("{:g} m", height), "over 0");
  deck::PlanOptions options = laws_for(atlas, r);
  options.speed = r.speed;
  const deck::Scene scene = scene_of(r);
  const deck::Plan plan = deck::make_plan(scene, options);
  deck::SoftenLimits limits;
  limits.fill_height = height;
  const deck::Softening soft = deck::soften(scene, plan, options, limits);
  Json pairs = Json::array();
  for (const deck::PairPlan& p : plan.pairs) pairs.push_back(pair_json(p));
  return {{"pairs", pairs}, {"velocity_axis_matters", plan.axis_matters}, {"time_step_s", json_number(plan.time_step)}, {"beyond_laws", deck::beyond_laws(plan)},
      {"soften", {{"stretch", soft.stretch}, {"bound_by", soft.bound}, {"time_step_s", json_number(soft.time_step)}, {"overlap_over_radius", json_number(soft.overlap)},
                     {"largest_overlap_over_radius", limits.overlap}, {"static_load_over_yield_load", json_number(soft.static_ratio)}}}};
}

}  // namespace granulaw
