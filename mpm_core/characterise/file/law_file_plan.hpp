#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "atlas/atlas.hpp"
#include "characterise/run/request.hpp"
#include "characterise/body/materials.hpp"
#include "atlas/law_without_runs.hpp"

namespace granulaw {

struct LawBody;

/// Requested content of a law file. The defaults are those of `mpm table`.
struct LawFileRequest : SceneSizes
{
  Materials materials;
  /// Names of materials or particles, each pair once; one of the two may be wall_name, the rigid wall. Empty:
  /// every material with every other, itself and the wall.
  std::vector<std::pair<std::string, std::string>> pairs;

  double depth = 0.2;             ///< largest overlap/R that the laws must reach: over 0, up to 0.5
  double damage_number = 0.0625;  ///< largest rho V^2/Y that they must reach: 0 (rate-independent) to 0.09
  double slowest = 0;  ///< m/s on a wall, of the slowest impact that the law of a rate-dependent particle
                       ///< must know; 0: a fiftieth of the fastest, or the onset of yield
  double tolerance = 0.01;  ///< relative, of F and e (BuildOptions::tolerance): 1e-4 to 0.5
  bool own_laws =
      false;  ///< correct by runs each composed law whose error is above `tolerance`; without the atlas, make two-body laws
  ShapeQuestion shapes{};        ///< of bodies of any shape; no velocities: usual_velocity()
  const Atlas* atlas = nullptr;  ///< answers for plain spheres; none: the solver does. Must outlive the plan

  /// The caller's names of these options, for messages.
  struct Words
  {
    std::string pair = "pair", slowest = "slowest", damage_number = "damage_number";
    std::string no_atlas = "no atlas was given";  ///< why `atlas` is null
  } words;
};

/// Plan of a law file, decided before anything is computed.
struct LawFilePlan
{
  struct Body
  {
    std::shared_ptr<const LawBody> body;  ///< body/law_body.hpp
    std::string why_runs;  ///< why its law needs runs of the solver; empty: it comes from the atlas
    bool from_atlas() const { return why_runs.empty(); }
  };
  struct Pair : PlannedPair
  {
    bool worth_own_law = false;  ///< two plain spheres whose composed law may miss the tolerance, or that have none
    bool own_law = false;  ///< runs of the two bodies will correct what is composed, or make its own law
  };

  LawFileRequest request;
  std::map<std::string, Body> bodies;  ///< by name
  std::vector<Pair> pairs;

  /// Options of the laws that need runs.
  BuildOptions build_options() const;
  bool needs_runs() const;  ///< of the solver, which takes from seconds to minutes of CPU for each law
};

/// Partner's radius over the yielding body's in the runs of a pair's own law.
inline constexpr double own_law_radius_ratio = 1;

/// Checks the request and says what it takes. Throws Error, one sentence for the user: an unknown name (with
/// the nearest), a pair named twice, two different bodies of which one is no homogeneous sphere, a material
/// whose law needs a particle, numbers out of range.
LawFilePlan plan_law_file(LawFileRequest request);

}  // namespace granulaw
