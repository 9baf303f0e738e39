#pragma once

#include "characterise/run/request.hpp"
#include "characterise/build/build_law.hpp"
#include "atlas/unlike_pair.hpp"

namespace granulaw {

/// The law of a pair's own, from presses and impacts of the two bodies, for where the pair rule is not good
/// enough. It is built as the law of one body is (`build_law`): a run of the two bodies is reported as that
/// of the one sphere the rule says they are (radius lambda R*, force lambda F; at the velocity of equal
/// energy, so that I means the same). So it goes with the rule's mapping, and has the same records, velocity
/// axis, checks and certificate, here against two-body runs. Exact for this pair at this radius ratio and
/// these densities; no error is stated at other radii.
///
/// Homogeneous spheres, elastic or with linear hardening; `pair.yielding` must yield and be the one that
/// `yields_first`. options.depth is cut where the overlap would pass 0.4 of the smaller radius. Throws as
/// build_law does.
BuiltLaw build_two_body_law(const UnlikePair& pair, const BuildOptions& options);

}  // namespace granulaw
