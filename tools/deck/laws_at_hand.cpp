#include "deck/laws_at_hand.hpp"

#include <fmt/format.h>

#include <map>
#include <memory>

#include "atlas/law_from_atlas.hpp"
#include "contact/thornton.hpp"
#include "deck/hertz.hpp"
#include "law/contact_step.hpp"
#include "law/replay.hpp"

namespace granulaw::deck {

namespace {

/// True if a law that was made for `a` is the law of `b`.
bool is_same_material(const LawMaterial& a, const LawMaterial& b)
{
  return a.youngs_modulus == b.youngs_modulus && a.poisson_ratio == b.poisson_ratio && a.yield_stress == b.yield_stress && a.hardening_modulus == b.hardening_modulus;
}

/// The laws at hand for a plan: the deck's own, if it is of the body that yields, else the atlas's.
class LawsAtHand
{
 public:
  LawsAtHand(std::optional<Law> deck_law, std::optional<Atlas> atlas) : deck_law_(std::move(deck_law)), atlas_(std::move(atlas)) {}

  std::optional<Collision> collide(const Meeting& m, double r_eff, double m_eff, double speed)
  {
    if (follows_hertz(m)) return {};
    for (const bool own : {true, false})
      if (const auto pair = own ? by_deck(m, 1, m.wall ? Box::infinity : 1) : by_atlas(m)) {
        const Replay replay = replay_collision(*pair, r_eff, m_eff, speed, 2000);
        if (own && replay.left_range) continue;
        // past the table the force is extrapolated: still an answer about depth, capped by whoever builds
        return Collision{replay.delta_max / m.mapping.length(r_eff), replay.restitution};
      }
    return {};
  }

  std::optional<double> stiffness(const Meeting& m, double radius_a, double radius_b, double r_eff, double overlap)
  {
    if (follows_hertz(m)) return {};
    for (const bool own : {true, false})
      if (const auto pair = own ? by_deck(m, radius_a, radius_b) : by_atlas(m)) {
        if (own && overlap > pair->max_overlap(r_eff)) continue;
        return planned_stiffness(*pair, r_eff, overlap);
      }
    return {};
  }

 private:
  /// As the plug-in does for types that the deck calls `elastic`.
  static bool follows_hertz(const Meeting& m) { return m.yields.name == elastic_name && !m.yields.yields(); }

  /// The law of these radii (m; of a wall infinite), or of their ratio.
  std::optional<PairLaw> by_deck(const Meeting& m, double radius_a, double radius_b) const
  {
    if (!deck_law_) return {};
    const auto yielding = deck_law_->bodies.find(m.yields.name);
    if (yielding == deck_law_->bodies.end() || !is_same_material(yielding->second.material, m.yields)) return {};
    const bool rigid = m.wall && !m.deformable;
    if (deck_law_->find_pair(m.name_a, rigid ? wall_name : m.name_b))
      return resolve_pair(*deck_law_, m.name_a, rigid ? wall_name : m.name_b, "the deck's law", radius_a, radius_b);
    return PairLaw{{&yielding->second.curve, m.mapping}, &yielding->second};
  }

  /// Each law is made once.
  std::optional<PairLaw> by_atlas(const Meeting& m)
  {
    if (!atlas_) return {};
    const LawMaterial& material = m.yields;
    const std::string key =
        fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}", material.youngs_modulus, material.poisson_ratio, material.yield_stress, material.hardening_modulus);
    const auto [found, is_new] = made_.try_emplace(key);
    if (is_new && (!material.yields() || atlas_->why_not(MaterialRatios::of(material)).empty())) {
      LawRange options;
      options.depth = 0.5, options.fastest = 0.3;
      found->second = law_from(*atlas_, material, options);
    }
    if (!found->second) return {};
    return PairLaw{{&found->second->curve, m.mapping}, &*found->second};
  }

  std::optional<Law> deck_law_;
  std::optional<Atlas> atlas_;
  std::map<std::string, std::optional<BodyLaw>> made_;  // by numbers of the material
};

/// Thornton's closed form, as model thornton has it.
Thornton thornton_of(const Meeting& m, double yield_pressure) { return {m.mapping.e_star_pair(), yield_pressure * m.yields.yield_stress}; }

std::optional<Collision> collide_by_thornton(const Thornton& law, const Meeting& m, double r_eff, double m_eff, double speed)
{
  const double duration = hertz_time(law.e_star, r_eff, m_eff, speed);
  const Replay replay = replay_collision([&](double delta, double delta_max) { return law.evaluate(r_eff, delta, delta_max); }, m_eff, speed, duration, 2000);
  return Collision{replay.delta_max / m.mapping.length(r_eff), replay.restitution, "Thornton"};
}

}  // namespace

void set_contact_law(PlanOptions& into, const Scene& scene, std::optional<Law> deck_law, std::optional<Atlas> atlas)
{
  if (scene.model == "thornton") {
    const double factor = scene.yield_pressure;
    into.collide = [factor](const Meeting& m, double r_eff, double m_eff, double speed) { return collide_by_thornton(thornton_of(m, factor), m, r_eff, m_eff, speed); };
    into.stiffness = [factor](const Meeting& m, double, double, double r_eff, double overlap) {
      return std::optional(thornton_of(m, factor).stiffness(r_eff, overlap, 0.0));
    };
    return;
  }
  const auto laws = std::make_shared<LawsAtHand>(std::move(deck_law), std::move(atlas));
  into.collide = [laws](const auto&... what) { return laws->collide(what...); };
  into.stiffness = [laws](const auto&... what) { return laws->stiffness(what...); };
}

}  // namespace granulaw::deck
