#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "collision_report.hpp"
#include "json_output.hpp"
#include "law/stated_collision.hpp"

// Answer of `mpm law` about one collision. The interactive page (tools/explorer) gives the same.
namespace granulaw {

/// Sentences about what the law does not cover in this collision; `velocity`: m/s.
inline std::vector<std::string> warnings_of(const ChosenPair& c, double velocity, const StatedCollision& found)
{
  std::vector<std::string> warnings;
  if (found.needs_axis)
    warnings.push_back(fmt::format("Johnson's damage number I = rho V^2/Y = {:.3g} is above {:.3g}: the law has no velocity axis, so e and force are too high",
        found.damage_number, found.statement.damage_number_max));
  else if (found.beyond_bound)
    warnings.push_back(fmt::format("Johnson's damage number I = rho V^2/Y = {:.3g} is above {:.3g}, up to which the error bound of this {} law holds",
        found.damage_number, found.statement.damage_number_max, name_of(found.statement.kind)));
  if (!found.statement.covers_size())
    warnings.push_back(fmt::format(
        "R_s/(R_s + R_h) of these radii is {:.3g} off the nearest law of the pair. The error bound is larger by that (mpm table --radius-ratio makes more laws)",
        found.statement.size_off));
  if (found.replay.left_speeds)
    warnings.push_back(fmt::format(
        "{:.4g} m/s is beyond {:.4g} m/s, where the law's velocity axis ends: the corrections of that speed are used", velocity, c.law.max_speed(c.r_eff, c.m_eff)));
  if (found.replay.held_speed)
    warnings.push_back(fmt::format(
        "{:.4g} m/s is below {:.4g} m/s, the lowest speed of this rate-dependent law: the law of that speed is used", velocity, c.law.min_speed(c.r_eff, c.m_eff)));
  return warnings;
}

/// The object of `mpm law --json`. cpu_s: what the collision cost.
inline nlohmann::ordered_json law_json(const StatedCollision& found, double cpu_s)
{
  const Replay& result = found.replay;
  const ErrorBound bound = found.bound();
  const double restitution = bound.restitution_at(result.restitution);
  nlohmann::ordered_json out = collision_json(result);
  put_effort(out, 0, static_cast<long>(result.samples.size()), cpu_s, 0,  // no solver: no points
      std::max(bound.force, restitution / result.restitution));
  const auto where_bounded = [&](double error) { return found.is_bounded() ? nlohmann::ordered_json(error) : nlohmann::ordered_json(); };
  out["error_force"] = where_bounded(bound.force);
  out["error_restitution"] = where_bounded(restitution);
  out["damage_number"] = out["inertia"] = found.damage_number;
  out["damage_number_max"] = json_number(found.statement.damage_number_max);
  out["needs_velocity_axis"] = found.needs_axis;
  out["beyond_velocity_axis"] = result.left_speeds;
  out["below_velocity_axis"] = result.held_speed;
  out["law_kind"] = name_of(found.statement.kind);
  out["size_distance"] = found.statement.size_off;
  return out;
}

}  // namespace granulaw
