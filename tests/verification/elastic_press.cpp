#include "elastic_press.hpp"

#include <algorithm>
#include <cmath>

#include "references.hpp"
#include "solver/runs.hpp"

namespace granulaw::verification {

PressedSphere press_elastic(double nu, double depth, int cells_across)
{
  PressedSphere s;
  s.nu = nu;
  PressPlan plan;
  plan.depth = depth;
  plan.support = Support::midplane;
  RunOptions options;
  options.resolution = cells_across;
  options.shifted_grids = 1;
  // The press holds its depth for 6 of about 60 R/c*: enough frames that some fall into the hold.
  options.fields.frames = 100;
  options.fields.begin = [&](int, const auto& cells) { s.cells = cells; };
  options.fields.frame = [&](const FieldFrame& f) {
    if (f.delta >= s.frame.delta) s.frame = f;  // of equal overlaps the last one: vibration has died out
  };
  press(reference::unit_sphere(0, nu), plan, {}, options);
  s.contact = hertz::under(s.frame.force);
  return s;
}

namespace {

/// Cells with two corners for which `on_line(r, z)` holds in the undeformed body.
template <class OnLine>
std::vector<int> cells_along(const PressedSphere& s, OnLine on_line)
{
  std::vector<int> found;
  const FieldFrame& f = s.frame;
  for (std::size_t p = 0; p < s.cells.size(); ++p) {
    int corners = 0;
    for (const int i : s.cells[p]) corners += on_line(f.r[i] - f.ur[i], f.z[i] - f.uz[i]);
    if (corners == 2) found.push_back(static_cast<int>(p));
  }
  return found;
}

/// Mean over a cell's corners of where they are now.
double centre(const std::vector<double>& coordinate, const std::array<int, 4>& corners)
{
  double sum = 0;
  for (const int i : corners) sum += 0.25 * coordinate[i];
  return sum;
}

}  // namespace

std::vector<PressurePoint> contact_pressure(const PressedSphere& s)
{
  std::vector<PressurePoint> profile;
  const auto on_sphere = [](double r, double z) { return std::abs(std::hypot(r, z - 1) - 1) < 1e-12; };
  for (const int p : cells_along(s, on_sphere)) {
    const double r = centre(s.frame.r, s.cells[p]) / s.contact.a;
    if (r < 1.5) profile.push_back({r, -s.frame.axial_stress[p] / s.contact.p0});
  }
  std::sort(profile.begin(), profile.end(), [](auto& a, auto& b) { return a.r_over_a < b.r_over_a; });
  return profile;
}

double centre_excess(const PressedSphere& s)
{
  double sum = 0;
  int count = 0;
  for (const PressurePoint& p : contact_pressure(s))
    if (p.r_over_a < 0.3) sum += p.pressure / hertz::pressure(p.r_over_a) - 1, ++count;
  return sum / count;
}

std::vector<AxisPoint> along_axis(const PressedSphere& s)
{
  std::vector<AxisPoint> profile;
  for (const int p : cells_along(s, [](double r, double) { return std::abs(r) < 1e-12; })) {
    const double z = centre(s.frame.z, s.cells[p]) / s.contact.a;
    if (z < 3)
      profile.push_back({z, s.frame.von_mises[p] / s.contact.p0, s.frame.axial_stress[p] / s.contact.p0});
  }
  std::sort(profile.begin(), profile.end(), [](auto& a, auto& b) { return a.z_over_a < b.z_over_a; });
  return profile;
}

hertz::Onset predicted_onset(const PressedSphere& s)
{
  const std::vector<AxisPoint> axis = along_axis(s);
  std::size_t top = 1;
  for (std::size_t k = 1; k + 1 < axis.size(); ++k)
    if (axis[k].von_mises > axis[top].von_mises) top = k;
  const AxisPoint &low = axis[top - 1], &mid = axis[top], &high = axis[top + 1];
  // Newton's form: q(z) = mid + s1 (z - z1) + c (z - z1)(z - z0)
  const double s1 = (mid.von_mises - low.von_mises) / (mid.z_over_a - low.z_over_a);
  const double s2 = (high.von_mises - mid.von_mises) / (high.z_over_a - mid.z_over_a);
  const double c = (s2 - s1) / (high.z_over_a - low.z_over_a);
  const double depth = 0.5 * (low.z_over_a + mid.z_over_a - s1 / c);
  const double largest =
      mid.von_mises + s1 * (depth - mid.z_over_a) + c * (depth - mid.z_over_a) * (depth - low.z_over_a);
  return {depth, 1 / largest};
}

}  // namespace granulaw::verification
