#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "law/contact_curve.hpp"

namespace granulaw {

/// A material as the law file keeps it, SI. `yield_stress` infinite: elastic.
struct LawMaterial
{
  std::string name;
  double density = 0;         ///< kg/m^3
  double youngs_modulus = 0;  ///< Pa
  double poisson_ratio = 0;
  double yield_stress = std::numeric_limits<double>::infinity();  ///< Pa
  double hardening_modulus = 0;  ///< Pa, d(yield stress)/d(equivalent plastic strain); 0: perfectly plastic

  double e_star() const { return youngs_modulus / (1.0 - poisson_ratio * poisson_ratio); }
  bool yields() const { return yield_stress < std::numeric_limits<double>::infinity(); }
};

/// Errors a law states about itself, relative (0.01 is 1 %), and the range it holds for.
struct Certificate
{
  double solver_error_force = 0;        ///< two resolutions, treated force
  double solver_error_restitution = 0;  ///< two resolutions, e
  double interpolation_error = 0;       ///< table against the fitted curve it was made from
  double held_out_error = 0;            ///< largest error of e at a press depth left out of the fit
  double residual_scatter = 0;          ///< rms of the runs about the fit: what the ripple treatment removed
  double reload_loop_area = 0;          ///< largest area of an unload/reload loop over the loading work there
  double slow_press_force =
      0;  ///< F of a slow press over the impact's at the deepest impact's overlap, less 1
  double slow_press_restitution = 0;    ///< the same of e: what inertia does at max_inertia (signed)
  double verification_error_force = 0;  ///< largest error of F_max, replay of this law against fresh impacts
  double verification_error_restitution = 0;  ///< the same of e
  double verification_impacts = 0;            ///< how many impacts were compared
  double max_inertia = 0;        ///< I = rho V^2/Y up to which the rate-free law holds within its error
  std::string support = "free";  ///< how the characterising press held the body
};

/// The law of one yielding body: its material, its dimensionless curve, its certificate.
struct BodyLaw
{
  LawMaterial material;
  ContactCurve curve;
  Certificate certificate;
};

/// Name of the rigid partner in pair names: "steel:wall".
inline constexpr const char* wall_name = "wall";

/// A contact law file in memory: bodies, and the pairs that it may be used for ("a:b", "a:wall").
struct Law
{
  std::map<std::string, BodyLaw> bodies;  ///< by material name
  std::vector<std::pair<std::string, std::string>> pairs;
  std::map<std::string, std::string> provenance;  ///< version, git_hash, created, command, material_hash, ...

  /// True if the file was built for this pair, in either order.
  bool has_pair(const std::string& a, const std::string& b) const;
  /// "a:b, a:wall, ..." for messages.
  std::string pair_list() const;
};

/// A pair's law, resolved: which curve, which mapping. What a particle code keeps for each pair of types.
struct PairLaw
{
  const ContactCurve* curve = nullptr;  ///< of the yielding body; owned by the Law
  PairMapping mapping;
  const BodyLaw* yielding = nullptr;

  ContactForce evaluate(double r_eff, double delta, double delta_max) const
  {
    return curve->evaluate(mapping, r_eff, delta, delta_max);
  }
  /// Largest overlap the table answers for, m.
  double max_overlap(double r_eff) const { return curve->x_end() * mapping.length(r_eff); }
};

/// Resolves materials `a` and `b` (b may be "wall": rigid). The body with the lower yield stress yields;
/// of two equally strong or elastic ones the softer, then the first by name. Throws Error naming `where`
/// where the law has no such material or was not built for the pair.
PairLaw resolve_pair(const Law& law, const std::string& a, const std::string& b, const std::string& where);

}  // namespace granulaw
