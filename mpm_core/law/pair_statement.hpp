#pragma once

#include <limits>
#include <string>

#include "law/law.hpp"

namespace granulaw {

/// Origin of a pair's law.
enum class LawKind {
  single,     ///< of one body: a rigid wall, like bodies of like size
  two_body,   ///< from runs of the two bodies
  composed,   ///< of the two bodies' laws
  corrected,  ///< composed, then corrected by impacts of the two bodies
  reduced     ///< of the yielding body, by the pair rule (contact/pair.hpp)
};
/// "single", "two-body", "composed", "corrected", "reduced".
const char* name_of(LawKind kind);

/// The statement of a law file about one pair: one function for `mpm table`, `mpm law`, `mpm info` and the
/// plug-in.
struct PairStatement
{
  LawKind kind = LawKind::single;
  ErrorBound bound;     ///< none is stated of unlike bodies by the pair rule
  double covered = 1;   ///< of a particle with a shape: part of the orientations that the bound is of
  double size_off = 0;  ///< distance of the contact from its law in R_s/(R_s + R_h)
  /// Largest damage number (damage_number.hpp) for which the bound holds.
  double damage_number_max = std::numeric_limits<double>::infinity();

  bool covers_size() const { return size_off <= size_share_step * (1 + 1e-9); }
  /// The same law at a distance in R_s/(R_s + R_h).
  PairStatement at_distance(double off) const;
};

/// Statement of a law that resolve_pair() gave for `a` and `b`, at its ratio of radii.
PairStatement statement_of(const Law& law, const PairLaw& pair, const std::string& a, const std::string& b);
/// Distance in R_s/(R_s + R_h) of bodies of these radii (m, or both in another unit; infinity: a thick
/// deformable wall) from that law; 0 at a rigid wall.
double distance_in_size(const Law& law, const PairLaw& pair, const std::string& a, const std::string& b,
                        double radius_a, double radius_b);

}  // namespace granulaw
