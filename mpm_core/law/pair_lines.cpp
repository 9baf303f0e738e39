#include "law/pair_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace granulaw {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Radii of a yielding body and its partner with this R_s/(R_s + R_h).
std::pair<double, double> radii_at(double share)
{
  if (share == 0) return {1, infinite};
  if (share == 1) return {infinite, 1};
  return {1, 1 / share - 1};
}

std::string radii_text(double share)
{
  if (share == 0) return "1 : a deformable wall";
  if (share == 1) return "a deformable wall : 1";
  return fmt::format("1 : {:.4g}", 1 / share - 1);
}

/// Those at these shares of sizes, the nearest to like sizes first.
std::vector<double> shares_of(const Law& law, const LawPair& pair)
{
  std::vector<double> shares = law.size_shares(pair.a, pair.b);
  std::sort(shares.rbegin(), shares.rend());
  return shares;
}

}  // namespace

std::string PairLine::text() const
{
  const PairStatement& s = statement;
  std::string line = fmt::format("{} law, {}: error bound {}", name_of(s.kind), radii, s.bound.text());
  if (s.covered < 1) line += fmt::format(" on {:.0f} % of the orientations", 100 * s.covered);
  if (s.bound.swing_force > 0) line += fmt::format(", and {:g} V/c* of F in an elastic impact", s.bound.swing_force);
  if (std::isinf(s.damage_number_max)) return line;
  return line + (least_damage_number_max < s.damage_number_max
                     ? fmt::format(", to I = {:.3g} to {:.3g}", least_damage_number_max, s.damage_number_max)
                     : fmt::format(", to I = {:.3g}", s.damage_number_max));
}

std::vector<PairLine> pair_lines(const Law& law, const LawPair& pair)
{
  const auto& [a, b] = std::pair(pair.a, pair.b);
  if (b == wall_name || a == wall_name) {
    const PairStatement s = statement_of(law, resolve_pair(law, a, b, a), a, b);
    return {{"a rigid wall", s, s.damage_number_max}};
  }
  const bool a_yields = yields_first(law.bodies.at(a).material, law.bodies.at(b).material);
  std::vector<PairLine> lines;
  for (const double share : shares_of(law, pair)) {
    const auto [own, other] = radii_at(share);
    const PairLaw one =
        a_yields ? resolve_pair(law, a, b, a, own, other) : resolve_pair(law, a, b, a, other, own);
    const PairStatement s = statement_of(law, one, a, b);
    const auto same = std::find_if(lines.begin(), lines.end(),
                                   [&](const PairLine& line) { return line.statement.kind == s.kind; });
    if (same == lines.end()) {
      lines.push_back({"radii " + radii_text(share), s, s.damage_number_max});
      continue;
    }
    same->radii += ", " + radii_text(share);
    same->statement.bound = same->statement.bound.worst(s.bound);
    same->statement.damage_number_max = std::max(same->statement.damage_number_max, s.damage_number_max);
    same->least_damage_number_max = std::min(same->least_damage_number_max, s.damage_number_max);
  }
  return lines;
}

}  // namespace granulaw
