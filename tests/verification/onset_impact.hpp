#pragma once

/// Free impacts about the onset of yield. Units R = rho = E* = 1.
namespace granulaw::verification {

struct OnsetImpact
{
  double largest_strain;  ///< equivalent plastic strain, anywhere in the body, after the impact
  double radius, depth;   ///< where that is, over the Hertz radius under the largest force: from the axis,
                          ///< from the plane
};

/// A sphere of E*/Y = `e_over_y` thrown, on one grid, at `v_over_onset` times the velocity at which Hertz's
/// theory lets it yield: V_y (base/scales.hpp) with the exact p0/Y of hertz::onset in place of 1.6.
OnsetImpact impact_about_onset(double e_over_y, double nu, double v_over_onset, int cells_across);

}  // namespace granulaw::verification
