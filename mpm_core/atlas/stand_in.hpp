#pragma once

#include <functional>

#include "atlas/atlas.hpp"

namespace granulaw {

/// Static flow stress over the yield stress, of the equivalent plastic strain; 1 at 0.
using FlowCurve = std::function<double(double strain)>;

/// The law of a sphere whose hardening is not linear, from the atlas's linear ones, no run.
///
/// A contact shows the flow stress at one strain (Tabor 1951): representative_strain times what the contact's
/// radius has grown by since first yield, over R. So at each overlap the law is the linearly hardening one whose
/// flow stress at that strain is the same: the secant. It is within 4 % of F (docs/develop/notes.md); differences
/// between near materials are far better. `stiffness`: E*/Y. Needs why_not() of H/E = 0 empty.
LawShape stand_in(const Atlas& atlas, double stiffness, double poisson_ratio, const FlowCurve& flow);
/// Tabor has 0.2; this one serves Voce's, Swift's and Johnson and Cook's laws best (docs/develop/notes.md).
inline constexpr double representative_strain = 0.23;

/// The linearly hardening material that stands for it where a curve between platens departs from a free
/// sphere's: the two plastic zones meet, and spread as the tangent of the flow stress says, when the contact is
/// as wide as at an overlap of a fifth of the radius. So F of two presses to 0.1 R is within 0.4 %
/// (docs/develop/notes.md). Its H/E is one of the atlas.
MaterialRatios stand_in_at_equator(const Atlas& atlas, double stiffness, double poisson_ratio,
                                   const FlowCurve& flow);

/// The flow curve of an equivalent sphere of stiffness q E*, which strains 1/q as much at the same stress.
FlowCurve of_twin(FlowCurve flow, double q);

}  // namespace granulaw
