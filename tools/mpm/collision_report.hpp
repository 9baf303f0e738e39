#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "base/attraction.hpp"

namespace granulaw {

/// A relative error in per cent.
inline std::string percent(double error) { return fmt::format("{:.2g} %", 100 * error); }

/// Two relative errors, for a sentence.
inline std::string errors_text(double force, double restitution) { return fmt::format("force within {}, e within {}", percent(force), percent(restitution)); }

/// The first keys of --json, SI, which mpm impact and press (Collision = RunSummary) and mpm law (Replay)
/// share.
template <class Collision>
nlohmann::ordered_json collision_json(const Collision& c)
{
  nlohmann::ordered_json out;
  out["e"] = c.restitution;
  out["force_max_N"] = c.force_max;
  out["delta_max_m"] = c.delta_max;
  out["delta_residual_m"] = c.delta_residual;
  out["contact_time_s"] = c.contact_time;
  out["work_load_J"] = c.work_load;
  out["work_unload_J"] = c.work_unload;
  return out;
}

/// The keys that follow them: what it cost, and the relative error of F_max and e (0: none is known, null).
inline void put_effort(nlohmann::ordered_json& out, long points, long steps, double cpu_s, double point_updates_per_s, double error_estimate)
{
  out["points"] = points;
  out["steps"] = steps;
  out["cpu_s"] = cpu_s;
  out["point_updates_per_s"] = point_updates_per_s;
  if (error_estimate > 0)
    out["error_estimate"] = error_estimate;
  else
    out["error_estimate"] = nullptr;
}

/// The same for people. `depth`: the largest overlap in other words.
template <class Collision>
void print_collision(const Collision& c, const std::string& depth)
{
  fmt::print("coefficient of restitution e   {:.4f}\n", c.restitution);
  fmt::print("largest force                  {:.5g} N\n", c.force_max);
  fmt::print("largest overlap                {:.5g} m  ({})\n", c.delta_max, depth);
  fmt::print("residual overlap               {:.5g} m\n", c.delta_residual);
  fmt::print("contact time                   {:.5g} s\n", c.contact_time);
  fmt::print("work put in, given back        {:.5g} J, {:.5g} J\n", c.work_load, c.work_unload);
}

/// Beside them where the surfaces attract each other.
template <class Collision>
nlohmann::ordered_json with_adhesion(nlohmann::ordered_json out, const Collision& c, const Attraction& attraction)
{
  if (!(attraction.work > 0)) return out;
  out["pull_off_N"] = c.pull_off;
  out["sticks"] = c.sticks;
  out["work_of_adhesion_J_per_m2"] = attraction.work;
  out["adhesion_range_m"] = attraction.range;
  return out;
}
template <class Collision>
void print_adhesion(const Collision& c, const Attraction& attraction)
{
  if (!(attraction.work > 0)) return;
  fmt::print("pull-off force                 {:.5g} N{}\n", c.pull_off, c.sticks ? ", and it sticks" : "");
  fmt::print("work of adhesion, range        {:.4g} J/m2, {:.3g} m (--adhesion-range)\n", attraction.work, attraction.range);
}

}  // namespace granulaw
