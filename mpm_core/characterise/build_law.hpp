#pragma once

#include "characterise/atlas.hpp"
#include "characterise/sampling_plan.hpp"
#include "farm/farm.hpp"
#include "law/law.hpp"

namespace granulaw {

struct BuildOptions
{
  double depth = 0.2;  ///< overlap/length that the law must reach, up to 0.5; beyond 0.1 no single pair law
                       ///< exists: the support matters (the certificate says how much)
  double fastest = 0.25;  ///< sqrt(I), I = rho V^2/Y, that the law must reach, up to 0.3; 0: rate-free
  double slowest = 0;  ///< of a rate-dependent body: sqrt(I) of the slowest impact that its law must know; 0:
                       ///< a fiftieth of `fastest`. Not below the onset of yield, where rates change nothing
  /// Relative, of force and of e, but of an e below 0.5 over 0.5: an e of 0.07 is then known to 0.005. Two
  /// resolutions must agree to this, and sampling is refined until it adds no more.
  double tolerance = 0.01;
  const Atlas* atlas = nullptr;  ///< spares runs where a stiff body begins to yield; none: nothing but runs
  Farm* farm = nullptr;          ///< makes the runs; none: this thread
  Progress progress;             ///< may throw to stop
};

/// A law, and what it took.
struct BuiltLaw
{
  BodyLaw law;
  std::vector<std::string>
      holes;              ///< runs that failed twice, each with its sentence: the law has no sample there
  std::string shallow;    ///< where the law comes from at overlaps too small to be run; empty: there are none
  std::string rate_free;  ///< where a rate-dependent body's law at no rate comes from; empty: from runs
  double change_of_restitution = 0;  ///< largest relative change of the fitted e that admissibility took
  double sampling_error = 0;         ///< largest where nothing was sampled, as it counts for the tolerance
  std::size_t runs = 0;              ///< that the adaptive sampling asked for
  std::size_t runs_full = 0;         ///< that the densest one would have
};

/// The law of one body on a rigid wall, by the material point method.
///
/// Slow presses with partial unloadings, and slow impacts where these cost less, give the rate-free law; fast
/// impacts give what inertia changes. Sampling starts coarse. Each new reversal point or impact shows by how
/// much the law fitted without it was wrong; where that was more than the tolerance its neighbourhood is
/// halved. Impacts that took no part check the law in the end. Throws Error if it is not admissible, or if
/// the tolerance is not reached.
BuiltLaw build_law(const LawMaterial& material, const CharacterisedBody& body, const BuildOptions& options,
                   const RunSource& source = {});

/// The law of a homogeneous, rate-independent, linearly hardening or elastic sphere out of the atlas;
/// options: depth and fastest. Needs atlas.why_not() empty for a material that yields.
BodyLaw law_from(const Atlas& atlas, const LawMaterial& material, const BuildOptions& options);

/// The curve and axis of `law` from its shape, which ends at `shape_end`, for a body of this onset; options: depth,
/// fastest, tolerance. Returns the largest relative error of the force that the table's cubics add to the shape; the
/// certificate says what leaving the axis out would cost.
double finish_curve(BodyLaw& law, const LawShape& shape, const CharacterisedBody& body, const BuildOptions& options,
                    double shape_end);

/// Force of a free sphere over that of one whose equator plane is driven, at this overlap/R, at E*/Y = 100:
/// why there is no single pair law at large overlaps (docs/method.md).
double support_ratio(double overlap);

}  // namespace granulaw
