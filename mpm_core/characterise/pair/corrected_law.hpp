#pragma once

#include <span>
#include <string>
#include <vector>

#include "characterise/run/request.hpp"
#include "atlas/composed_law.hpp"
#include "atlas/unlike_pair.hpp"

namespace granulaw {

/// The laws of a pair at several radius ratios, composed and then corrected, and what it took.
struct CorrectedLaws
{
  std::vector<TwoBodyLaw> laws;    ///< in the order of the ratios asked for
  std::size_t runs = 0;            ///< impacts of the two bodies
  std::vector<std::string> holes;  ///< runs that failed twice, each with its sentence
  double sampling_error = 0;       ///< largest of an impact left out, as it counts for the tolerance
};

/// A pair's own laws: composed of its bodies' (composed_law.hpp), then corrected by a few impacts of the two
/// bodies.
///
/// A composed law is a guide as a body's is (atlas/departure.hpp): below the onset it is right. So three
/// impacts give how it departs: ln of the loading force, at the peak and along the impact, of the largest overlap, and
/// of the fraction of the work that is given back. The force near the peaks corrects the slow law; the rest of it along an
/// impact corrects the velocity axis, as a soft partner's inertia is larger than the yielding body's.
/// Each impact is left out in turn; where the others predict it worse than options.tolerance, an impact is
/// added beside it. The certificate states that error, what the composed law is off by at the onset, what the
/// corrected law is off by at the impacts themselves, and what the cells cost. Impacts are made at equal radii, at the
/// smallest and the largest of the ratios, and on a deformable wall where one is asked for; between them the
/// correction is linear in R_s/(R_s + R_h). A deformable wall that yields first takes that of the smallest ratio.
///
/// Homogeneous spheres, elastic or hardening linearly, of which pair.yielding yields. options: depth,
/// fastest, tolerance, atlas, farm, progress. Throws Error as compose_law and choose_resolutions do.
CorrectedLaws corrected_laws(const UnlikePair& pair, const PairBody& yielding, const PairBody& partner,
                             std::span<const double> ratios, const BuildOptions& options);

}  // namespace granulaw
