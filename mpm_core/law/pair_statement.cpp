#include "law/pair_statement.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace granulaw {

namespace {

constexpr double even_share = 0.5;

/// The pair's law among those of its own; null: a body's.
const TwoBodyLaw* pair_law(const Law& law, const PairLaw& pair, const std::string& a, const std::string& b)
{
  if (const std::vector<TwoBodyLaw>* laws = law.find_pair_laws(a, b))
    for (const TwoBodyLaw& one : *laws)
      if (&one.law == pair.yielding) return &one;
  return nullptr;
}

LawKind kind_of(const TwoBodyLaw* of_pair, const std::string& a, const std::string& b)
{
  if (!of_pair) return a == b || a == wall_name || b == wall_name ? LawKind::single : LawKind::reduced;
  const Certificate& c = of_pair->law.certificate;
  if (c.origin != composed_origin) return LawKind::two_body;
  return c.verification_impacts > 0 ? LawKind::corrected : LawKind::composed;
}

}  // namespace

const char* name_of(LawKind kind)
{
  switch (kind) {
    case LawKind::single:
      return "single";
    case LawKind::two_body:
      return "two-body";
    case LawKind::composed:
      return "composed";
    case LawKind::corrected:
      return "corrected";
    case LawKind::reduced:
      return "reduced";
  }
  return "";
}

PairStatement PairStatement::at_distance(double off) const
{
  PairStatement at = *this;
  at.size_off = off;
  if (at.covers_size()) return at;
  at.bound = bound.at_size(off);
  if (kind == LawKind::single) at.kind = LawKind::reduced;
  return at;
}

PairStatement statement_of(const Law& law, const PairLaw& pair, const std::string& a, const std::string& b)
{
  PairStatement s;
  const BodyLaw& body = *pair.yielding;
  s.kind = kind_of(pair_law(law, pair, a, b), a, b);
  if (s.kind != LawKind::reduced) s.bound = bound_of(body);
  s.damage_number_max = body.certificate.damage_number_max;
  if (body.shape) s.covered = body.shape->covered();
  return s;
}

double distance_in_size(const Law& law, const PairLaw& pair, const std::string& a, const std::string& b,
                        double radius_a, double radius_b)
{
  if (a == wall_name || b == wall_name) return 0;
  if (a == b && radius_a > radius_b) std::swap(radius_a, radius_b);
  const bool a_yields = a == b || yields_first(law.bodies.at(a).material, law.bodies.at(b).material);
  const double ratio = a_yields ? radius_b / radius_a : radius_a / radius_b;
  const TwoBodyLaw* own = pair_law(law, pair, a, b);
  return std::abs(1 / (1 + ratio) - (own ? own->size_share() : even_share));
}

}  // namespace granulaw
