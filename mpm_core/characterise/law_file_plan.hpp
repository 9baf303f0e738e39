#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "characterise/atlas.hpp"
#include "characterise/build_options.hpp"
#include "characterise/law_body.hpp"
#include "characterise/reduction_error.hpp"
#include "characterise/shape_certificate.hpp"

namespace granulaw {

/// What a law file shall hold. The defaults are those of `mpm table`.
struct LawFileRequest
{
  Materials materials;
  /// Names of materials or particles, each pair once; one of the two may be wall_name, the rigid wall. Empty:
  /// every material with every other, itself and the wall.
  std::vector<std::pair<std::string, std::string>> pairs;

  double depth = 0.2;             ///< largest overlap/R that the laws must reach: over 0, up to 0.5
  double damage_number = 0.0625;  ///< largest rho V^2/Y that they must reach: 0 (rate-free) to 0.09
  double slowest = 0;  ///< m/s on a wall, of the slowest impact that the law of a rate-dependent particle
                       ///< must know; 0: a fiftieth of the fastest, or the onset of yield
  double tolerance = 0.01;  ///< relative, of F and e (BuildOptions::tolerance): 1e-4 to 0.5
  double radius_ratio =
      1;  ///< largest ratio of two spheres' radii in the scene, 1 or more: pairs are composed up to it
  double rule_radius_ratio = 0;  ///< that for which the pair rule's error is stated; 0: radius_ratio
  bool thick_walls = true;       ///< either of two bodies may also be a thick deformable wall
  bool own_laws =
      false;  ///< make the own law, by runs, of each pair that the pair rule serves worse than `tolerance`
  ShapeQuestion shapes{};        ///< of bodies of any shape; no velocities: usual_velocity()
  const Atlas* atlas = nullptr;  ///< answers for plain spheres; none: the solver does. Must outlive the plan

  /// What the caller calls these things, for messages.
  struct Words
  {
    std::string pair = "pair", slowest = "slowest", damage_number = "damage_number";
    std::string no_atlas = "no atlas was given";  ///< why `atlas` is null
  } words;
};

/// What will be made, decided before anything is computed.
struct LawFilePlan
{
  struct Body
  {
    LawBody body;
    std::string why_runs;  ///< why its law needs runs of the solver; empty: it comes from the atlas
    bool from_atlas() const { return why_runs.empty(); }
  };
  struct Pair
  {
    std::string a, b;  ///< names; b may be wall_name, a is not
    /// What the pair rule costs, whichever of the two bodies is the larger; 0 where the rule is exact.
    ReductionError by_rule;
    /// What the file states of the pair beside its laws' certificates: by_rule, or what other radii cost its
    /// own law; 0 of composed laws.
    ReductionError stated;
    /// Partner's radius over the yielding body's of each law that will be composed, ascending
    /// (composed_law.hpp); infinity: a thick wall; 0: the yielding body is one. None: the pair follows the
    /// rule, or has its own law by runs.
    std::vector<double> composed_at;
    bool worth_own_law = false;  ///< two plain spheres whose stated error is above the tolerance
    bool own_law = false;  ///< runs of the two bodies will correct what is composed, or make its own law

    std::string name() const { return a + ":" + b; }
    bool is_extrapolated() const { return !by_rule.within_measured || !stated.within_measured; }
  };

  LawFileRequest request;
  std::map<std::string, Body> bodies;  ///< by name
  std::vector<Pair> pairs;

  /// How the laws that need runs are made.
  BuildOptions build_options() const;
  bool needs_runs() const;  ///< of the solver, which takes from seconds to minutes of CPU for each law
};

/// Partner's radius over the yielding body's in the runs of a pair's own law.
inline constexpr double own_law_radius_ratio = 1;

/// Checks the request and says what it takes. Throws Error, one sentence for the user: an unknown name (with
/// the nearest), a pair named twice, two different bodies of which one is no homogeneous sphere, a material
/// whose law needs a particle, numbers out of range.
LawFilePlan plan_law_file(LawFileRequest request);

/// The two as the pair rule sees them, at this ratio of the partner's radius to the yielding body's.
UnlikePair unlike_pair(const LawMaterial& a, const LawMaterial& b, double radius_ratio = 1);

/// Error of the pair's law, whichever of the two bodies is `radius_ratio` times the larger, to the end of the
/// range that the pair rule was measured in: by the rule (docs/evidence/pairs.md).
ReductionError pair_rule_error(const LawMaterial& a, const LawMaterial& b, double radius_ratio);
/// The same of the pair's own law, made at the radius ratio `law_radius_ratio`.
ReductionError own_law_error(const LawMaterial& a, const LawMaterial& b, double radius_ratio,
                             double law_radius_ratio);

}  // namespace granulaw
