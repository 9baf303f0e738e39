#pragma once

#include "characterise/run/request.hpp"
#include "law/law.hpp"
#include "solver/shape/particle.hpp"

namespace granulaw {

struct CharacterisedBody;  // body/characterised_body.hpp
struct RunSource;          // run/sampling_plan.hpp

/// A law, and what it took.
struct BuiltLaw
{
  BodyLaw law;
  std::vector<std::string>
      holes;              ///< runs that failed twice, each with its sentence: the law has no sample there
  std::string guide;      ///< the law without runs, from which the runs show the departure; empty: there is none
  std::string rate_free;  ///< where a rate-dependent body's rate-independent law comes from; empty: from runs
  double change_of_restitution = 0;  ///< largest relative change of the fitted e that admissibility took
  double sampling_error = 0;         ///< largest where nothing was sampled, as it counts for the tolerance
  std::size_t runs = 0;              ///< that the adaptive sampling asked for
};

/// Throws Error, before anything is run, where the law of a body of one material cannot be made: it yields too
/// late for the law's depth, or so early that no law reaches from the onset to the shallowest run.
void require_reachable(const LawMaterial& material, const CharacterisedBody& body, const BuildOptions& options);

/// The first runs of the sampling, and how far it may be refined.
struct ExpectedRuns
{
  std::size_t first = 0;
  double first_cpu_s = 0;  ///< CPU seconds, about, of the first ones
};
ExpectedRuns expected_runs(const LawMaterial& material, const CharacterisedBody& body,
                           const BuildOptions& options);

/// The law of one body on a rigid wall, by the material point method.
///
/// Slow presses with partial unloadings, and slow impacts where these cost less, give the rate-independent
/// law; fast impacts give what inertia or a rate changes. Sampling starts coarse and is refined where the law
/// fitted without a run misses it by more than the tolerance (refinement.hpp). Impacts that took no part
/// verify the law in the end. Throws Error if it is not admissible, or if the tolerance is not reached.
BuiltLaw build_law(const std::string& name, const Particle& particle, const BuildOptions& options);
/// The same of a body in its own units; runs are the solver's, or those of `source`.
BuiltLaw build_law(const LawMaterial& material, const CharacterisedBody& body, const BuildOptions& options);
BuiltLaw build_law(const LawMaterial& material, const CharacterisedBody& body, const BuildOptions& options,
                   const RunSource& source);

/// The rate-independent law of a sphere of this material on a rigid flat to overlap/R = `depth`, by runs.
Curve slow_law_by_runs(const std::string& name, const Material& material, double depth, const Atlas& atlas, Farm& farm,
                       const Progress& progress);

}  // namespace granulaw
