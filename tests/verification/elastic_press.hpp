#pragma once

#include <array>
#include <vector>

#include "hertz.hpp"
#include "solver/output/fields.hpp"

/// Stresses in a pressed elastic sphere, taken from what `--fields` writes. Units R = E* = 1.
namespace granulaw::verification {

/// One grid's body at the deepest overlap of a press, where it is held and at rest.
struct PressedSphere
{
  double nu;
  hertz::Contact contact;  ///< Hertz's, under the force found: no fitted parameter is left
  std::vector<std::array<int, 4>> cells;
  FieldFrame frame;
};
PressedSphere press_elastic(double nu, double depth, int cells_across);

struct PressurePoint
{
  double r_over_a, pressure;  ///< pressure over p0
};
/// Minus the axial stress of the cells at the surface, out to r = 1.5 a. It differs from the pressure on the
/// surface by second order in the cell size: where no shear acts, d(sigma_zz)/dz = 0 on the surface.
std::vector<PressurePoint> contact_pressure(const PressedSphere& s);

/// Pressure over Hertz's, less one: mean over r < 0.3 a.
double centre_excess(const PressedSphere& s);

struct AxisPoint
{
  double z_over_a, von_mises, axial;  ///< stresses over p0
};
/// The cells along the axis, from the plane upwards to z = 3 a.
std::vector<AxisPoint> along_axis(const PressedSphere& s);

/// The largest von Mises stress on the axis: parabola through the largest cell and its neighbours.
hertz::Onset predicted_onset(const PressedSphere& s);

}  // namespace granulaw::verification
