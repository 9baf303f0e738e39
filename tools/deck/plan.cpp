#include "deck/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "deck/shielding.hpp"

namespace granulaw::deck {

namespace {

constexpr double unit_ball = 4.0 / 3.0 * M_PI;

/// Particles of one type, over all its sources.
struct Kind
{
  int type = 1;
  double radius_min = 0, radius_max = 0, density = 0;
  LawMaterial material;
  bool known_yield = false;
};

/// The up direction; 0 without gravity.
Vec3 up(const Scene& scene)
{
  const double g = norm(scene.gravity);
  return g > 0 ? -1 / g * scene.gravity : Vec3{0, 0, 0};
}

/// How high the centres of a source can come without a wall's help, and how fast they are where.
struct Flight
{
  double top = 0, speed = 0, g = 0;
  bool known = true;
  double at(double height) const { return std::sqrt(speed * speed + 2 * g * std::max(0.0, top - height)); }
  double reach() const { return g > 0 ? top + speed * speed / (2 * g) : Box::infinity; }
};

LawMaterial material_of(const Scene& scene, int type, const PlanOptions& options, double density,
                        bool& known_yield)
{
  LawMaterial m;
  m.name = fmt::format("type{}", type);
  if (const auto named = options.materials.find(type); named != options.materials.end()) {
    m = named->second;
    known_yield = true;
    if (m.density == 0) m.density = density;
    return m;
  }
  m.density = density;
  if (const auto given = scene.materials.find(type); given != scene.materials.end()) {
    m.youngs_modulus = given->second.youngs_modulus.value_or(0);
    m.poisson_ratio = given->second.poisson_ratio.value_or(0);
    if (given->second.yield_stress) m.yield_stress = *given->second.yield_stress;
    known_yield = given->second.yield_stress.has_value();
  }
  return m;
}

void ask(Plan& plan, const std::string& what, const std::string& option)
{
  for (const Question& q : plan.questions)
    if (q.what == what && q.option == option) return;
  plan.questions.push_back({what, option});
}

/// "A (and 3 more)".
std::string first_of(const std::vector<std::string>& reasons)
{
  return reasons.size() == 1 ? reasons[0] : fmt::format("{} (and {} more)", reasons[0], reasons.size() - 1);
}

/// Size and material of every type that the deck brings in; asks for what is missing.
std::map<int, Kind> kinds_of(const Scene& scene, const PlanOptions& options, Plan& plan)
{
  std::map<int, Kind> kinds;
  std::vector<Source> sources = scene.sources;
  if (sources.empty()) {
    Source s;
    s.where = scene.deck;
    sources.push_back(s);
    if (!options.radius_max && scene.unknown_particles.empty())
      ask(plan, scene.deck + ": no particles were understood", "--radius R [R_MAX]");
  }
  for (Source s : sources) {
    if (s.radius_max <= 0)
      s.radius_min = options.radius_min.value_or(0), s.radius_max = options.radius_max.value_or(0);
    if (s.density <= 0) s.density = options.density.value_or(0);
    if (const auto m = options.materials.find(s.type); s.density <= 0 && m != options.materials.end())
      s.density = m->second.density;
    if (s.radius_max <= 0) {
      if (!scene.sources.empty()) ask(plan, s.where + ": the radius of its particles", "--radius R [R_MAX]");
      continue;
    }
    if (s.density <= 0) {
      ask(plan, s.where + ": the density of its particles", "--density RHO");
      continue;
    }
    auto [at, fresh] = kinds.try_emplace(s.type);
    Kind& k = at->second;
    k.type = s.type;
    k.radius_min = fresh ? s.radius_min : std::min(k.radius_min, s.radius_min);
    k.radius_max = std::max(k.radius_max, s.radius_max);
    k.density = std::max(k.density, s.density);
  }
  if (!scene.unknown_particles.empty() && !options.radius_max)
    ask(plan, first_of(scene.unknown_particles), "--radius R [R_MAX]");
  if (options.radius_max && !scene.unknown_particles.empty())
    for (auto& [type, k] : kinds) {  // what is given stands for particles that the deck hides
      k.radius_min = std::min(k.radius_min, *options.radius_min);
      k.radius_max = std::max(k.radius_max, *options.radius_max);
    }
  for (auto at = kinds.begin(); at != kinds.end();) {
    Kind& k = at->second;
    k.material = material_of(scene, k.type, options, k.density, k.known_yield);
    if (k.material.youngs_modulus > 0) {
      ++at;
      continue;
    }
    ask(plan, fmt::format("the moduli of type {}", k.type), "--materials-file FILE --materials NAME...");
    at = kinds.erase(at);
  }
  return kinds;
}

/// What the sizes of a pair change, at their extremes.
void over_sizes(PairPlan& p, const Kind& a, const Kind* b, const PlanOptions& options)
{
  const Meeting& m = p.meeting;
  p.onset = p.yield_velocity = p.contact_time = Box::infinity;
  const double e_star = m.mapping.e_star_pair();
  for (const double ra : {a.radius_min, a.radius_max})
    for (const double rb : {b ? b->radius_min : 0.0, b ? b->radius_max : 0.0}) {
      const double ma = unit_ball * a.material.density * ra * ra * ra;
      const double r_eff = b ? effective_radius(ra, rb) : ra;
      const double m_eff = b ? effective_mass(ma, unit_ball * b->material.density * rb * rb * rb) : ma;
      const double rho = m.one_body_density(r_eff, m_eff);
      const double length = m.mapping.length(r_eff);
      if (m.yields.yields()) {
        p.onset = std::min(
            p.onset, onset_velocity(m.mapping.e_star, m.yields.yield_stress, rho, m.yields.poisson_ratio));
        p.yield_velocity =
            std::min(p.yield_velocity, yield_velocity(m.mapping.e_star, m.yields.yield_stress, rho));
        p.damage_number = std::max(p.damage_number, rho * p.speed * p.speed / m.yields.yield_stress);
      }
      if (p.speed <= 0) continue;
      p.contact_time = std::min(p.contact_time, hertz_time(e_star, r_eff, m_eff, p.speed));
      std::optional<double> x;
      if (options.collide && m.known_yield)
        if (const auto collision = options.collide(m, r_eff, m_eff, p.speed)) x = collision->depth;
      p.overlap_basis = x ? "law" : "Hertz";
      if (!x) x = hertz_overlap(e_star, r_eff, m_eff, p.speed) / length;
      p.depth = std::max(p.depth, *x);
      p.overlap = std::max(p.overlap, *x * length / r_eff);
    }
  p.needs_table = m.known_yield && p.speed > p.onset;
}

/// What a run visited of this pair; empty: the file does not say.
std::optional<Visited::Range> range_of(const PairPlan& p, const Visited& visited)
{
  const Meeting& m = p.meeting;
  const auto& by_types = m.wall ? visited.walls : visited.pairs;
  std::optional<Visited::Range> range = m.wall ? visited.wall : visited.pair;
  if (!visited.pairs.empty() || !visited.walls.empty()) {  // the file tells pairs apart
    const auto at = by_types.find(m.wall || m.a <= m.b ? std::pair(m.a, m.b) : std::pair(m.b, m.a));
    range = at == by_types.end() ? Visited::Range{} : at->second;
  }
  return range;
}

/// The cloud of the deck, if all of its particles are equal, start together at random and at rest, and fall
/// on one floor that stands still; walls along gravity may stand around it.
std::optional<Cloud> cloud_of(const Scene& scene, const Vec3& upward)
{
  if (scene.sources.size() != 1 || scene.sources[0].together.empty() || scene.sources[0].radius_max <= 0 ||
      !scene.unknown_particles.empty() || !scene.unknown_heights.empty() || !scene.unknown_speeds.empty())
    return {};
  Cloud cloud;
  const Source& s = scene.sources[0];
  cloud.centres = s.together, cloud.radius = s.radius_max, cloud.g = norm(scene.gravity);
  cloud.domain = scene.domain, cloud.periodic = scene.periodic;
  const auto along = std::find_if(upward.begin(), upward.end(), [](double x) { return std::abs(x) == 1; });
  if (along == upward.end()) return {};
  cloud.axis = static_cast<std::size_t>(along - upward.begin()), cloud.up = *along;
  const auto flat = [](const Wall& w, std::size_t k) { return w.box.low[k] == w.box.high[k]; };
  std::optional<double> floor;
  for (const Wall& w : scene.walls) {
    if (w.speed > 0 || w.drag_speed > 0) return {};
    if (flat(w, cloud.axis)) {
      if (floor.value_or(w.box.low[cloud.axis]) != w.box.low[cloud.axis]) return {};
      floor = w.box.low[cloud.axis];
    } else if (!flat(w, (cloud.axis + 1) % 3) && !flat(w, (cloud.axis + 2) % 3)) {
      return {};  // a slope, or a floor that is not plane: what slides down hits others from the side
    }
  }
  if (!floor) return {};
  cloud.floor = *floor;
  if (!at_random(cloud)) return {};
  return cloud;
}

}  // namespace

double Meeting::one_body_density(double r_eff, double m_eff) const
{
  const double lambda = mapping.sqrt_lambda * mapping.sqrt_lambda;
  return lambda * m_eff / (unit_ball * std::pow(lambda * r_eff, 3));
}

double hertz_overlap(double e_star, double r_eff, double m_eff, double speed)
{
  // 1/2 m* V^2 = 8/15 E* sqrt(R*) delta^2.5
  return std::pow(15.0 / 16.0 * m_eff * speed * speed / (e_star * std::sqrt(r_eff)), 0.4);
}

double hertz_time(double e_star, double r_eff, double m_eff, double speed)
{
  return 2.9432 * hertz_overlap(e_star, r_eff, m_eff, speed) /
         speed;  // K. L. Johnson, Contact Mechanics, 11.24
}

Plan make_plan(const Scene& scene, const PlanOptions& options, const Visited* visited)
{
  Plan plan;
  std::map<int, Kind> kinds = kinds_of(scene, options, plan);
  const Vec3 upward = up(scene);
  const double g = norm(scene.gravity);
  double largest = 0;
  for (const auto& [type, k] : kinds) {
    largest = std::max(largest, k.radius_max);
    const double least = unit_ball * k.density * std::pow(k.radius_min, 3);
    plan.radius_min = plan.radius_min == 0 ? k.radius_min : std::min(plan.radius_min, k.radius_min);
    plan.radius_max = std::max(plan.radius_max, k.radius_max);
    plan.mass_min = plan.mass_min == 0 ? least : std::min(plan.mass_min, least);
    plan.mass_max = std::max(plan.mass_max, unit_ball * k.density * std::pow(k.radius_max, 3));
  }

  // how high particles can be, and how fast
  std::map<int, Flight> flights;
  double push = 0, drag = 0, lifted = -Box::infinity;
  for (const Wall& w : scene.walls) {
    push = std::max(push, w.speed), drag = std::max(drag, w.drag_speed);
    if (w.speed > 0 && g > 0) lifted = std::max(lifted, w.box.top(upward));
  }
  double highest = lifted;
  for (const Source& s : scene.sources) {
    auto [at, fresh] = flights.try_emplace(s.type);
    Flight& f = at->second;
    const double top = g > 0 ? s.centres.top(upward) : 0.0;
    f.g = g;
    f.known = f.known && (g == 0 || std::isfinite(top));
    f.top = fresh ? std::max(top, lifted) : std::max(f.top, top);
    f.speed = std::max(f.speed, s.speed);
    highest = std::max(highest, f.reach());
  }
  for (const auto& [type, k] : kinds)
    if (!flights.contains(type)) flights[type] = {0, 0, g, g == 0};

  // the walls within reach, and the lowest of them
  std::vector<const Wall*> walls;
  double floor = Box::infinity;
  for (const Wall& w : scene.walls) {
    if (g > 0 && w.box.bottom(upward) > highest + largest) continue;
    walls.push_back(&w);
    if (g > 0) floor = std::min(floor, w.box.bottom(upward));
  }
  if (g > 0 && walls.empty() && !scene.domain.empty()) floor = scene.domain.bottom(upward);

  if (!options.speed) {
    bool unknown = !scene.unknown_heights.empty();
    for (const auto& [type, f] : flights)
      if (g > 0 && (!f.known || !std::isfinite(floor) || !std::isfinite(f.at(floor)))) unknown = true;
    if (unknown && !options.drop_height && !visited)
      ask(plan,
          scene.unknown_heights.empty() ? "from how high the particles fall"
                                        : first_of(scene.unknown_heights),
          "--drop-height H");
    if (!scene.unknown_speeds.empty() && !visited) ask(plan, first_of(scene.unknown_speeds), "--speed V");
  }
  const auto speed_at = [&](const Flight& f, double height) {
    double v = std::sqrt(f.speed * f.speed + 2 * g * options.drop_height.value_or(0));
    if (!options.drop_height) v = f.known ? f.at(height) : 0.0;
    return std::isfinite(v) ? v : 0.0;
  };
  if (g > 0)
    for (const auto& [type, f] : flights)
      if (f.known && std::isfinite(floor)) plan.fall = std::max(plan.fall, f.top - floor);
  if (options.drop_height) plan.fall = *options.drop_height;

  std::optional<double> landing;  // m/s, on the floor that a cloud shields
  if (!options.speed && !options.drop_height && g > 0)
    if (const auto cloud = cloud_of(scene, upward)) landing = landing_speed(*cloud);

  // who meets whom
  std::set<int> unknown_yield;
  const auto add = [&](const Kind& a, const Kind& b, const Wall* wall, double speed) {
    PairPlan p;
    Meeting& m = p.meeting;
    m.a = a.type, m.b = b.type, m.wall = wall != nullptr, m.deformable = wall && wall->deformable;
    const bool rigid = wall && !wall->deformable;
    m.name_a = a.material.name, m.name_b = rigid ? wall_name : b.material.name;
    const LawMaterial &first = a.material, &second = b.material;
    const bool a_yields = rigid || first.yield_stress < second.yield_stress ||
                          (first.yield_stress == second.yield_stress && first.e_star() <= second.e_star());
    m.yields = a_yields ? first : second;
    m.known_yield = a.known_yield && (rigid || b.known_yield);
    m.mapping =
        rigid ? PairMapping::rigid_partner(m.yields.e_star())
              : PairMapping::deformable_partner(m.yields.e_star(), (a_yields ? second : first).e_star());
    p.speed = options.speed.value_or(speed);
    p.speed_basis = options.speed ? "given" : wall && landing == speed ? "shielded fall" : "fall";
    std::optional<Visited::Range> range;
    if (visited) range = range_of(p, *visited);
    if (range) p.visited = range->met, p.speed = visited_margin * range->speed, p.speed_basis = "visited";
    over_sizes(p, a, wall ? nullptr : &b, options);
    const double overlap = range ? visited_margin * range->overlap / scene.stretch : 0.0;
    if (overlap > p.overlap) {  // pressed deeper than any impact goes
      p.overlap = overlap;
      p.depth = p.overlap / (m.mapping.sqrt_lambda * m.mapping.sqrt_lambda);
      p.overlap_basis = "visited";
    }
    plan.pairs.push_back(p);
  };
  for (auto a = kinds.begin(); a != kinds.end(); ++a)
    for (auto b = a; b != kinds.end(); ++b) {
      if (a == b && scene.sources.size() == 1 && scene.sources[0].count == 1 &&
          scene.unknown_particles.empty())
        continue;  // a single particle
      add(a->second, b->second, nullptr,
          speed_at(flights.at(a->first), floor) + speed_at(flights.at(b->first), floor) +
              2 * (2 * push + drag));
    }
  for (const auto& [type, k] : kinds) {
    std::map<std::pair<int, bool>, std::pair<const Wall*, double>> by_type;
    for (const Wall* w : walls) {
      const double height = g > 0 ? w->box.bottom(upward) : 0.0;
      double v = speed_at(flights.at(type), height) + 2 * push + drag + w->speed + w->drag_speed;
      if (landing && w->box.bottom(upward) == w->box.top(upward)) v = std::min(v, *landing);
      const auto [at, fresh] = by_type.try_emplace({w->type, w->deformable}, w, v);
      if (!fresh) at->second.second = std::max(at->second.second, v);
    }
    for (const auto& [key, wall] : by_type) {
      Kind material;
      material.type = key.first;
      if (wall.first->deformable) {
        material.material = material_of(scene, key.first, options, 0, material.known_yield);
        if (material.material.youngs_modulus <= 0) {
          ask(plan, fmt::format("the moduli of type {}", key.first),
              "--materials-file FILE --materials NAME...");
          continue;
        }
        if (!material.known_yield) unknown_yield.insert(key.first);
      }
      add(k, material, wall.first, wall.second);
    }
  }

  double shortest = Box::infinity, deepest = 0, fastest = 0;
  for (const PairPlan& p : plan.pairs) {
    shortest = std::min(shortest, p.contact_time);
    if (!p.needs_table || !p.visited) continue;
    deepest = std::max(deepest, p.depth), fastest = std::max(fastest, p.damage_number);
  }
  for (const auto& [type, k] : kinds)
    if (!k.known_yield) unknown_yield.insert(type);
  for (const int type : unknown_yield)
    ask(plan, fmt::format("the yield stress of type {}", type), "--materials-file FILE --materials NAME...");
  if (std::isfinite(shortest)) plan.time_step = scene.stretch * shortest / steps_per_contact;
  plan.axis_matters = fastest > negligible_damage_number;
  // a fifth more than foreseen, in two digits
  const auto rounded_up = [](double x) {
    if (x <= 0) return 0.0;
    const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
    return std::ceil(x / unit) * unit;
  };
  plan.depth = std::min(0.5, rounded_up(1.2 * deepest));
  plan.damage_number = std::min(0.09, rounded_up(1.2 * fastest));

  double steps = 0;
  for (const Run& r : scene.runs) {
    plan.particle_steps += r.steps * options.particles.value_or(r.particles);
    steps += r.steps;
  }
  if (steps > 0 && plan.particle_steps == 0) ask(plan, "how many particles there are", "--particles N");
  plan.hours = plan.particle_steps / options.rate / 3600;
  return plan;
}

double radius_ratio(const Plan& plan, const Meeting& meeting)
{
  if (meeting.wall && !meeting.deformable) return 1;  // exact by the pair rule
  return meeting.wall ? largest_radius_ratio
                      : std::min(largest_radius_ratio, plan.radius_max / plan.radius_min);
}

std::string table_command(const Plan& plan, const std::string& materials_file)
{
  std::string pairs;
  std::set<std::string> done;
  double ratio = 1;
  for (const PairPlan& p : plan.pairs) {
    if (!p.needs_table || !p.visited) continue;
    const std::string name = p.meeting.name_a + ":" + p.meeting.name_b;
    if (done.insert(name).second) pairs += " --pair " + name;
    ratio = std::max(ratio, radius_ratio(plan, p.meeting));
  }
  if (pairs.empty() || plan.depth <= 0) return {};
  return fmt::format("mpm table {}{} --depth {:.3g} --damage-number {:.3g}{} -o law.h5",
                     materials_file.empty() ? "MATERIALS.toml" : materials_file, pairs, plan.depth,
                     plan.damage_number, ratio > 1 ? fmt::format(" --radius-ratio {:.4g}", ratio) : "");
}

}  // namespace granulaw::deck
