#pragma once

#include "characterise/run/sampling_plan.hpp"

namespace granulaw {

/// Press for the elastic correction of a finite body.
SamplingPlan::Press elastic_press_of(const CharacterisedBody& body, int cells);

/// The press that gives the finite body's elastic correction and, of a body of several materials or with
/// pores, where it begins to yield: to `depth`, or, 0, as deep as the correction is wanted for.
RunJob elastic_press_job(const CharacterisedBody& body, int cells, const RunSource& source, double depth = 0);

/// Overlap/length at which a body begins to yield, by its elastic press: the smallest of Hertz's overlap for
/// the material at the pole and the overlaps at which the press's von Mises stress reaches a material's yield
/// stress. Of the pole's own material these count where the grid resolves the contact; below, Hertz's formula
/// holds. Points at the contact edge, which no buried material has, reach it early at small Poisson ratios:
/// by 3 % of the overlap at 0.3 and more, by 14 % at 0.2, 34 % at 0 (docs/develop/notes.md).
/// Infinity: the press was not deep enough.
double onset_of_yield(const CharacterisedBody& body, const RunResult& press);

}  // namespace granulaw
