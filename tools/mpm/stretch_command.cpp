// mpm stretch: the largest stretch of the law that a deck bears.
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "base/error.hpp"
#include "command.hpp"
#include "deck/soften.hpp"
#include "deck_options.hpp"
#include "json_output.hpp"
#include "option_checks.hpp"

namespace granulaw {

namespace of_stretch {

struct SoftenRequest
{
  std::string deck;
  DeckOptions options;
  deck::SoftenLimits limits;
  bool json = false;
};

using nlohmann::ordered_json;

std::string largest(double s) { return std::isfinite(s) ? fmt::format("{:.3g}", s) : std::string("any"); }

/// The lines to paste into the deck.
struct Paste
{
  std::string stretch, time_step;
};

Paste paste_of(const deck::Softening& s) { return {fmt::format("stretch {:.3g}", s.stretch), fmt::format("timestep {}", step_text(s.time_step))}; }

ordered_json pairs_json(const deck::Softening& s)
{
  ordered_json pairs = ordered_json::array();
  for (const deck::PairStretch& q : s.pairs)
    pairs.push_back({{"types", {q.pair->meeting.a, q.pair->meeting.b}}, {"wall", q.pair->meeting.wall}, {"largest_by_overlap", json_number(q.by_overlap)},
        {"largest_by_contact_time", json_number(q.by_time)}, {"largest_by_static_load", json_number(q.by_static)}, {"contact_time_s", json_number(q.contact_time)},
        {"static_load_N", json_number(q.static_load)}, {"yield_load_N", json_number(q.yield_load)}});
  return pairs;
}

/// Effect on e of a lowered modulus instead.
ordered_json lowered_modulus_json(const deck::Softening& s)
{
  ordered_json restitution = ordered_json::array();
  for (const auto& n : s.naive)
    restitution.push_back({{"pair", printable(n.pair)}, {"speed_m_per_s", n.speed}, {"e_stretched", n.e}, {"e_modulus_lowered", n.e_naive}, {"by", n.basis}});
  return {{"factor", s.modulus_factor}, {"restitution", restitution}};
}

ordered_json to_json(const std::string& deck, const deck::Softening& s)
{
  ordered_json root{{"deck", printable(deck)}, {"stretch", s.stretch}, {"bound_by", printable(s.bound)}, {"time_step_s", json_number(s.time_step)},
      {"overlap_over_radius", json_number(s.overlap)}, {"flow_time_s", json_number(s.flow_time)}, {"fill_height_m", json_number(s.fill_height)},
      {"static_load_over_yield_load", json_number(s.static_ratio)}, {"extra_plastic_set_over_radius", json_number(s.extra_set)}};
  root["pairs"] = pairs_json(s);
  root["modulus_lowered"] = lowered_modulus_json(s);
  root["paste"] = {paste_of(s).stretch, paste_of(s).time_step};
  return root;
}

void print_pairs(const deck::Softening& s)
{
  fmt::print("  {:<10} {:>10} {:>10} {:>10}   largest s by each\n", "types", "overlap", "duration", "static");
  for (const deck::PairStretch& q : s.pairs)
    fmt::print("  {:<10} {:>10} {:>10} {:>10}\n", types_text(q.pair->meeting), largest(q.by_overlap), largest(q.by_time), largest(q.by_static));
}

void print_lowered_modulus(const deck::Softening& s)
{
  for (const auto& n : s.naive)
    fmt::print("instead E times {:.3g}: e of {} at {:.3g} m/s would be {:.3f}, not {:.3f} (by {})\n", s.modulus_factor, printable(n.pair), n.speed, n.e_naive, n.e,
        n.basis == "law" ? "the law" : "Thornton's closed form");
}

void print(const deck::SoftenLimits& limits, const deck::Softening& s)
{
  fmt::print("limits: s delta_max/R* <= {:g}; s t_contact <= {:g} of {:.3g} s; s P_static <= {:g} F_y (bed {:.3g} m high)\n", limits.overlap, limits.time_fraction,
      s.flow_time, limits.static_load, s.fill_height);
  print_pairs(s);
  fmt::print("largest stretch: {:.3g}, bound by the {}; then overlap {:.3g} R*, static load {:.3g} F_y", s.stretch, printable(s.bound), s.overlap, s.static_ratio);
  if (s.overlap > limits.overlap) fmt::print(", which is over the limit without any stretch");
  fmt::print("{}\n", s.extra_set > 0 ? fmt::format(", extra plastic set {:.3g} R*", s.extra_set) : "");
  fmt::print("the deck keeps its moduli; after the model's words in pair_style and fix wall/gran, and for the time step:\n");
  fmt::print("  {}\n  {}\n", paste_of(s).stretch, paste_of(s).time_step);
  if (s.stretch > 1) print_lowered_modulus(s);
}

void soften(const SoftenRequest& r)
{
  const PlannedDeck d = plan_deck(r.deck, r.options);
  if (!d.scene.confinement.empty()) fail(r.deck, fmt::format("it says 'confinement {}', which excludes 'stretch': take the time step that mpm plan prints", d.scene.confinement));
  require_answers(d.plan, r.deck);
  const deck::Softening s = deck::soften(d.scene, d.plan, d.options, r.limits);
  if (s.pairs.empty()) fail(r.deck, "no two bodies of it meet at any speed: there is nothing to stretch");
  for (const std::string& sentence : deck::beyond_laws(d.plan)) fmt::print(stderr, "mpm: {}\n", printable(sentence));
  if (r.json)
    print_json(to_json(r.deck, s));
  else
    print(r.limits, s);
}

void define(Options& command)
{
  const auto r = std::make_shared<SoftenRequest>();
  command.add_option("DECK", r->deck, "LIGGGHTS input script").required();
  r->options.add_to(command, true);
  command.add_option("--max-overlap", r->limits.overlap, "largest s delta_max/R*").check(from_to(0.001, 0.5)).capture_default_str();
  command.add_option("--time-fraction", r->limits.time_fraction, "longest contact over the flow's own time: a fall through one radius, a wall's way of one diameter")
      .check(from_to(0.001, 10))
      .capture_default_str();
  command.add_option("--static-limit", r->limits.static_load, "largest s P_static/F_y; above 1 the extra plastic set of the bed is stated")
      .check(from_to(0.001, 1e6))
      .capture_default_str();
  command.add_option("--fill-height", r->limits.fill_height, "m, of the bed (default: from particles and walls)").check(above_zero());
  command.add_flag("--json", r->json, "as JSON");
  command.callback([r] { soften(*r); });
}

}  // namespace of_stretch

extern const Command stretch_command{"stretch",
    "Largest stretch s of a deck's contact law F(delta/s)/s within limits: the time step grows by s, every\n"
    "binary impact keeps its e (docs/guide/plan.md). Prints the lines to paste.\n"
    "Example: mpm stretch in.hopper --var model mpm --var scene out/scene --materials-file materials.toml",
    of_stretch::define, false, "soften"};

}  // namespace granulaw
