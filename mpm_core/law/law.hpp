#pragma once

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/scales.hpp"
#include "contact/contact.hpp"
#include "law/error_bound.hpp"
#include "law/law_material.hpp"
#include "law/orientation_check.hpp"

namespace granulaw {

/// Where a law's error bound comes from: errors of its parts, relative (0.01 is 1 %), and the range it holds for.
struct Certificate
{
  double solver_error_force = 0;        ///< of F, by two resolutions
  double solver_error_restitution = 0;  ///< of e, by two resolutions
  double interpolation_error = 0;       ///< table against the fitted curve it was made from
  double held_out_error = 0;            ///< largest error of e at a press depth left out of the fit
  double residual_scatter = 0;  ///< rms of the runs about the fit: what the grid noise treatment removed
  double reload_loop_area = 0;  ///< largest area of an unload/reload loop over the loading work there
  double verification_error_force = 0;  ///< largest error of F_max, replay of this law against fresh impacts
  double verification_error_restitution = 0;  ///< the same of e
  double verification_impacts = 0;            ///< how many impacts were compared
  double damage_number_max = 0;  ///< I = rho V^2/Y up to which the law, with its axis, holds within its error
  double axis_cost_force =
      0;  ///< F_max without the velocity axis over F_max with it, less 1, at its end; 0: none
  double axis_cost_restitution = 0;    ///< the same of e (both signed)
  double atlas_error_force = 0;        ///< of the atlas's values, relative; 0: computed by runs
  double atlas_error_restitution = 0;  ///< the same, absolute in e
  std::string origin = "runs";         ///< "runs": of the solver; "atlas": interpolated in the atlas; or ...
};

/// ... Certificate::origin of a pair's law that was composed of its two bodies' laws.
inline constexpr const char* composed_origin = "composed";

/// Bound of a law used for what it was made for: the law's error, and that of the solver's cells (solver_error_*).
/// The law's error is
/// - from the atlas, that of its checks near this E*/Y (docs/evidence/atlas.md). These are fresh impacts, so it
///   includes the atlas's own runs, fit, interpolation and table;
/// - composed of the two bodies' laws, that of two-body impacts that took no part in the rule
///   (docs/evidence/pairs.md). The solver's error is the larger one of the two bodies' laws;
/// - by runs, or corrected by impacts, the largest error of its verification, impacts that took no part in the
///   fit. Without impacts, the errors of fit and table.
ErrorBound bound_of(const Certificate& certificate);

/// `BodyLaw::body` of a homogeneous sphere.
inline constexpr const char* sphere_name = "sphere";

/// The law of one yielding body: its material, its dimensionless curve, its certificate.
struct BodyLaw
{
  LawMaterial material;
  Curve curve;
  Certificate certificate;
  ErrorBound bound{};              ///< of a sphere, where it has a shape
  std::string body = sphere_name;  ///< else the name of a layered or shaped particle: wall and like pair only
  double pole_radius = 0;          ///< m, radius of curvature at the pole, as computed; 0: any (spheres)
  double mass_ratio = 1;           ///< mass over rho 4/3 pi R^3, R the radius of curvature at the pole
  /// Certificate of a particle of any shape: errors, by direction, of its material's law of a sphere, used
  /// with the radius of curvature at the contact.
  std::optional<ShapeCertificate> shape{};

  /// States the bound by the certificate; the cost of an omitted axis stays.
  void state();
  bool is_sphere() const { return body == sphere_name; }
  /// kg, of a body whose radius (of curvature at the pole) is `radius`, m.
  double mass(double radius) const { return mass_ratio * material.density * 4.0 / 3.0 * M_PI * radius * radius * radius; }
};

/// The bound of a body's law. Of a particle with a shape: that of its orientations, each compared with a fresh impact.
ErrorBound bound_of(const BodyLaw& body);

/// Name of the rigid partner in pair names: "steel:wall".
inline constexpr const char* wall_name = "wall";
/// Name of types that follow plain Hertz with the deck's moduli and need no law.
inline constexpr const char* elastic_name = "elastic";

/// A pair that a law may be used for.
struct LawPair
{
  std::string a, b;  ///< material names; b may be "wall"

  bool operator==(const LawPair&) const = default;
};

/// The law of two spheres at one ratio of radii, used in place of the yielding body's own by the pair rule:
/// composed of the two bodies' laws (certificate.origin "composed"), or from runs of the two bodies ("runs").
/// Its curve goes with the rule's mapping.
struct TwoBodyLaw
{
  BodyLaw law;              ///< `material` is the yielding one's
  double radius_ratio = 1;  ///< partner's radius over the yielding body's; infinity: the partner is a thick
                            ///< wall; 0: the yielding body is

  /// R_s/(R_s + R_h) of the yielding body and its partner: in which laws change evenly.
  double size_share() const { return 1 / (1 + radius_ratio); }
};

/// A contact law file in memory: bodies, and the pairs that it may be used for ("a:b", "a:wall").
struct Law
{
  std::map<std::string, BodyLaw> bodies;  ///< by material name
  std::vector<LawPair> pairs;
  /// By "a:b" as in `pairs`: each ascending in radius_ratio, which is at least 1 where a is b. Other pairs
  /// follow the pair rule.
  std::map<std::string, std::vector<TwoBodyLaw>> pair_laws;
  std::map<std::string, std::string> provenance;  ///< version, git_hash, created, command, material_hash, ...

  /// The file's entry for this pair, in either order; null: it was not built for it.
  const LawPair* find_pair(const std::string& a, const std::string& b) const;
  /// The pair's own laws, in either order; null: it follows the pair rule, or is not in the file.
  const std::vector<TwoBodyLaw>* find_pair_laws(const std::string& a, const std::string& b) const;
  /// Shares of sizes (TwoBodyLaw::size_share) that the pair's laws are for, ascending. Like sizes count where
  /// the pair rule is all there is, and between bodies of one material, whose own law is exact there.
  std::vector<double> size_shares(const std::string& a, const std::string& b) const;
  /// "a:b, a:wall, ..." for messages.
  std::string pair_list() const;
  /// True if every curve has contact radii of unloading: files before version 6 have none.
  bool states_unloading_radius() const;
};

/// Throws Error naming `where` if one of two different bodies is no homogeneous sphere: pairs are mapped by
/// the radius of curvature alone, which is exact for the rigid wall and like pairs only.
void check_partners(const BodyLaw& a, const BodyLaw& b, const std::string& where);

/// True if `a` is the one that yields against `b`: the lower yield stress; of two equally strong or elastic
/// ones the softer, then the first by name.
bool yields_first(const LawMaterial& a, const LawMaterial& b);

/// A pair's law, resolved: which curve, which mapping. What a particle code keeps for each pair of types.
struct PairLaw : PairContact  // its curve is the Law's
{
  const BodyLaw* yielding = nullptr;  ///< whose curve it is: the yielding body, or TwoBodyLaw::law

  /// X of impact_overlap(), latched at first touch.
  Answer evaluate(double r_eff, double delta, double delta_max, double impact_overlap = 0) const
  {
    return answer(*curve, mapping, r_eff, delta, delta_max, impact_overlap);
  }
  /// Largest overlap of the table, m.
  double max_overlap(double r_eff) const { return curve->end() * mapping.length(r_eff); }

  /// v = sqrt(I) of a collision at this relative normal speed, m/s: see AxisTable. The yielding body
  /// yields.
  double axis_speed(double r_eff, double m_eff, double speed) const
  {
    return measure().axis_speed(mapping, r_eff, m_eff, speed);
  }
  /// Measure of an impact, for the yielding body.
  ImpactMeasure measure() const
  {
    const LawMaterial& m = yielding->material;
    const FlowStress flow = m.flow_stress();
    return {m.density, flow.yield, yielding->mass_ratio, flow.hardening, flow.nodes};
  }
  /// X (dimensionless) that a contact latches which first touches at the relative normal speed `speed` (m/s,
  /// approach positive): 0 without a velocity axis or approach, clamped beyond max_speed().
  double impact_overlap(double r_eff, double m_eff, double speed) const
  {
    return curve->axis() ? curve->reach(speed_coordinate(r_eff, m_eff) * speed) : 0.0;
  }
  /// Least approach speed that the law covers, m/s: slower impacts are answered as this one. 0 without a
  /// rate axis.
  double min_speed(double r_eff, double m_eff) const
  {
    return curve->axis() ? curve->axis()->speed_begin / speed_coordinate(r_eff, m_eff) : 0.0;
  }
  /// Radius, m, that the yielding body must have (check_size); 0: any.
  double only_radius() const { return curve->axis() ? curve->axis()->reference_radius : 0.0; }
  /// Largest approach speed the velocity axis answers for, m/s; infinity: there is no axis.
  double max_speed(double r_eff, double m_eff) const
  {
    return curve->axis() ? curve->axis()->speed_end / speed_coordinate(r_eff, m_eff)
                         : std::numeric_limits<double>::infinity();
  }

  /// Effective mass, kg, of a usual pair with this R*: the yielding body and its like, each of radius 2 R*;
  /// with a rigid partner the body alone. For tables and examples; a particle code has better ones.
  double usual_mass(double r_eff) const;

 private:
  /// v of the velocity axis over the relative normal speed, s/m (AxisTable).
  double speed_coordinate(double r_eff, double m_eff) const
  {
    return measure().per_speed(*curve->axis(), mapping, r_eff, m_eff);
  }
};

/// Reason why the flow stress of the body that yields is not known, which `tangential plastic` needs: layers, a
/// rate, or a file older than flow curves. Empty: it is known, or the bodies are elastic.
std::string unknown_flow_stress(const Law& law, const PairLaw& pair);

/// A body against the rigid wall.
PairLaw wall_pair(const BodyLaw& body);

/// Resolves materials `a` and `b` (b may be "wall": rigid), in either order: the pair's own law if the file
/// has one, of several that at the nearest size_share(), else the law of the body that yields
/// (`yields_first`). The radii (m; or both in another unit) choose; infinity: a deformable wall. Throws
/// Error naming `where` where the law has no such material or was not built for the pair, or where a body
/// that is no homogeneous sphere would meet another body than its like or the rigid wall.
PairLaw resolve_pair(const Law& law, const std::string& a, const std::string& b, const std::string& where,
                     double radius_a = 1, double radius_b = 1);

/// By how much, relative, a radius may differ from that of a rate-dependent law. The strain rate goes as V/R:
/// 5 % of it change the flow stress of any metal by far less than a per cent (Johnson-Cook, C = 0.1: 0.5 %).
inline constexpr double size_tolerance = 0.05;

/// Throws Error naming `where` where the pair's law holds for one size of its yielding body and that body's
/// radius (of curvature at the pole, m) is another: its strain rates would be others, and an impact at the
/// same rate would not reach the same fraction of it.
void check_size(const PairLaw& pair, double radius, const std::string& where);

}  // namespace granulaw
