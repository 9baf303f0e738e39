#include "law/radiation.hpp"

#include <algorithm>
#include <cmath>

#include "contact/pair.hpp"

namespace granulaw {

namespace {

double wave_speed(const LawMaterial& m)
{
  return std::sqrt(m.e_star() / m.density);
}

double inverse_mass(const LawMaterial& m, double radius)
{
  return std::isfinite(radius) ? 1 / (4.0 / 3.0 * M_PI * m.density * radius * radius * radius) : 0.0;
}

/// s
double contact_duration(const LawMaterial& a, double radius_a, const LawMaterial& b, double radius_b)
{
  const double mass = 1 / (inverse_mass(a, radius_a) + inverse_mass(b, radius_b));
  const double radius = 1 / (1 / radius_a + 1 / radius_b);
  const double yield = std::min(a.yield_stress, b.yield_stress);
  const double e_star = 1 / (1 / a.e_star() + 1 / b.e_star());
  const double slowest = std::min(wave_speed(a), wave_speed(b));
  const auto elastic = [&](double velocity) {
    return 2.87 * std::pow(mass * mass / (e_star * e_star * radius * velocity), 0.2);
  };
  if (!std::isfinite(yield)) return elastic(0.01 * slowest);
  return std::max(std::sqrt(mass / (radius * yield)), elastic(0.05 * slowest));
}

}  // namespace

double radiation(const LawMaterial& a, double radius_a, const LawMaterial& b, double radius_b)
{
  const double duration = contact_duration(a, radius_a, b, radius_b);
  const auto of_body = [&](const LawMaterial& m, double radius) {
    const double c = wave_speed(m), remains = 1 / (1 + std::pow(duration * c / (return_times * radius), 4));
    if (remains < negligible_radiation) return 0.0;
    return radiation_number * remains / (m.density * c * c * c);
  };
  return of_body(a, radius_a) + of_body(b, radius_b);
}

}  // namespace granulaw
