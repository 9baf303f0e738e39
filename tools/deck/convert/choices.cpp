#include "deck/convert/choices.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/error.hpp"
#include "deck/digits.hpp"
#include "deck/soften.hpp"

namespace granulaw::deck {

namespace {

std::string describe_type(const Scene& scene, int type)
{
  std::string text = fmt::format("type {}", type);
  for (const Source& s : scene.sources)
    if (s.type == type && s.radius_max > 0) {
      text += fmt::format(" (R {:.3g} m, {:.4g} kg/m^3)", s.radius_max, s.density);
      break;
    }
  return text;
}

/// m, of the deck's box along gravity; its longest side where there is none.
double box_height(const Scene& scene)
{
  if (scene.domain.empty()) return 0;
  const Vec3 size = scene.domain.size();
  const double g = norm(scene.gravity);
  if (!(g > 0)) return std::max({size[0], size[1], size[2]});
  double height = 0;
  for (std::size_t k = 0; k < 3; ++k) height += std::abs(scene.gravity[k]) / g * size[k];
  return height;
}

/// `allowed`: of the real contacts.
void set_step_factor(Conversion& conversion, double deck_step, double allowed)
{
  const double step = conversion.stretch * allowed;
  if (step < deck_step) conversion.step_factor = rounded_up(deck_step / step);
}

}  // namespace

std::set<int> types_of_particles(const Scene& scene)
{
  std::set<int> types;
  for (const Source& s : scene.sources) types.insert(s.type);
  if (types.empty()) types.insert(1);
  return types;
}

std::vector<std::string> names_of_types(const Scene& scene, const std::vector<std::string>& given, const std::string& source, const std::vector<std::string>& known)
{
  const auto types = static_cast<std::size_t>(std::max(1, scene.types));
  if (!given.empty()) {
    if (given.size() != types) fail("--materials", fmt::format("{} has {} atom types, each needs one name", scene.deck, types), fmt::format("{}", fmt::join(given, ",")));
    return given;
  }
  if (scene.material_names.size() == types) return scene.material_names;
  const std::set<int> of_particles = types_of_particles(scene);
  if (known.size() != 1) {
    std::vector<std::string> asked;
    for (const int type : of_particles) asked.push_back(describe_type(scene, type));
    throw Unanswered(printable(fmt::format("{}: which material of {} ({}) is {}? Give one name for each of the {} atom types by --materials NAME,NAME,...", scene.deck,
        source, fmt::join(known, ", "), fmt::join(asked, ", "), types)));
  }
  std::vector<std::string> names;
  for (std::size_t t = 1; t <= types; ++t) names.push_back(of_particles.contains(static_cast<int>(t)) ? known[0] : fmt::format("wall{}", t));
  return names;
}

DefaultAnswer default_answer(const Scene& scene, const Plan& plan, const std::string& option)
{
  const double height = box_height(scene), g = norm(scene.gravity);
  if (option.starts_with("--drop-height")) {
    if (plan.fall > height) return {plan.fall, "the largest fall that the deck shows"};
    return {height, "the height of the deck's box"};
  }
  if (option.starts_with("--speed")) {
    double walls = 0, start = 0, planned = 0;
    for (const Wall& w : scene.walls) walls = std::max({walls, w.speed, w.drag_speed});
    for (const Source& s : scene.sources) start = std::max(start, s.speed);
    for (const PairPlan& p : plan.pairs) planned = std::max(planned, p.speed);
    const double speed = start + 2 * walls + std::sqrt(2 * g * height);
    if (planned >= speed && planned > 0) return {planned, "the fastest approach that the deck shows"};
    return {speed > 0 ? speed : 1.0, g > 0 ? "a fall through the deck's box, with its fastest wall" : "its fastest wall or particle"};
  }
  return {};
}

std::vector<Question> open_questions(const Plan& plan)
{
  std::vector<Question> open;
  std::copy_if(plan.questions.begin(), plan.questions.end(), std::back_inserter(open), [](const Question& q) { return q.option != "--particles N"; });
  return open;
}

std::string question_sentence(const Scene& scene, const Plan& plan, const std::vector<Question>& questions)
{
  std::string text;
  for (const Question& q : questions) {
    const std::string name = q.option.substr(0, q.option.find(' '));
    const DefaultAnswer by_deck = default_answer(scene, plan, q.option);
    text += fmt::format("{}not in the deck: {}: give it by {}{}", text.empty() ? "" : "; ", q.what, q.option,
        by_deck.value > 0 ? fmt::format(" ({} {:.3g}: {})", name, by_deck.value, by_deck.reason) : "");
  }
  return printable(fmt::format("{}: {}", scene.deck, text));
}

StepChoice choose_time_step(Conversion& conversion, const PlannedDeck& d, bool may_stretch)
{
  StepChoice c;
  c.deck_step = largest_time_step(d.scene);
  const double allowed = d.plan.time_step / d.scene.stretch;
  if (!(c.deck_step > 0) || !(allowed > 0) || allowed >= c.deck_step) return c;
  if (!may_stretch || !may_be_stretched(d.scene)) {
    c.bound = may_stretch ? "liquid bridges and heat, which have no form for a stretched law" : "--no-stretch";
  } else {
    const Softening s = soften(d.scene, d.plan, d.options, {});
    conversion.stretch = std::clamp(rounded_up(c.deck_step / allowed), 1.0, s.stretch);
    c.bound = s.bound;
  }
  set_step_factor(conversion, c.deck_step, allowed);
  return c;
}

StepChoice continue_stretch(Conversion& conversion, const PlannedDeck& d, double stretch)
{
  const StepChoice c{largest_time_step(d.scene), "restart file, whose contacts are stretched so"};
  const double allowed = d.plan.time_step / d.scene.stretch;
  conversion.stretch = stretch;
  conversion.step_factor = 1;
  if (c.deck_step > 0 && allowed > 0) set_step_factor(conversion, c.deck_step, allowed);
  return c;
}

void choose_moduli(Conversion& conversion, const PlannedDeck& d, const std::vector<std::string>& known)
{
  const std::set<int> of_particles = types_of_particles(d.scene);
  double rise = 1;
  for (int type = 1; type <= d.scene.types; ++type) {
    const auto m = d.options.materials.find(type);
    if (m == d.options.materials.end() || !(m->second.youngs_modulus > 0)) continue;
    const std::string& name = d.scene.material_names[static_cast<std::size_t>(type) - 1];
    if (std::find(known.begin(), known.end(), name) == known.end()) continue;
    conversion.youngs_modulus[type] = m->second.youngs_modulus;
    conversion.poisson_ratio[type] = m->second.poisson_ratio;
    const auto of_deck = d.scene.materials.find(type);
    if (of_particles.contains(type) && of_deck != d.scene.materials.end() && of_deck->second.youngs_modulus)
      rise = std::max(rise, m->second.youngs_modulus / *of_deck->second.youngs_modulus);
  }
  for (int type = 1; type <= d.scene.types; ++type) {
    if (conversion.youngs_modulus.contains(type)) continue;
    const auto of_deck = d.scene.materials.find(type);
    if (of_deck != d.scene.materials.end() && of_deck->second.youngs_modulus) conversion.youngs_modulus[type] = std::min(*of_deck->second.youngs_modulus * rise, 1e12);
  }
}

}  // namespace granulaw::deck
