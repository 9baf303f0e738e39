#include "law/radiation.hpp"

#include <algorithm>
#include <cmath>

#include "base/gauss.hpp"
#include "contact/pair.hpp"
#include "law/contact_time.hpp"

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
  const auto elastic = [&](double velocity) { return customary_contact_time(e_star, radius, mass, velocity); };
  if (!std::isfinite(yield)) return elastic(0.01 * slowest);
  return std::max(std::sqrt(mass / (radius * yield)), elastic(0.05 * slowest));
}

/// Im of alpha s/D on 0 < s < 1, with D = (2 s^2 - 1)^2 - 4 s^2 alpha beta, alpha^2 = s^2 - g^2, beta^2 = s^2 - 1: what
/// the bulk waves take. s: wave number along the surface over that of shear waves; g: their speed over that of pressure
/// waves.
double bulk_waves(double s, double g)
{
  const double first = 2 * s * s - 1, alpha = std::sqrt(std::abs(s * s - g * g)), beta = std::sqrt(1 - s * s);
  const double square = first * first, both = 4 * s * s * alpha * beta;
  if (s < g) return alpha * s / (square + both);
  return alpha * s * both / (square * square + both * both);
}

/// Integral of bulk_waves; s runs as a cosine, since it begins and ends with roots.
double bulk_waves_between(double begin, double end, double g)
{
  constexpr int panels = 12;  // N to 1e-9
  double sum = 0;
  for (int k = 0; k < panels; ++k)
    sum += gauss<7>(M_PI * k / panels, M_PI * (k + 1) / panels, [&](double angle) {
      const double half = 0.5 * (end - begin);
      return half * std::sin(angle) * bulk_waves(begin + half * (1 - std::cos(angle)), g);
    });
  return sum;
}

/// Residue at the wave number of Rayleigh's surface wave, the root of D beyond 1, times pi.
double surface_wave(double g)
{
  const auto d = [g](double s) {
    const double first = 2 * s * s - 1;
    return first * first - 4 * s * s * std::sqrt((s * s - g * g) * (s * s - 1));
  };
  double below = 1, beyond = 2;  // D is 1 at 1, negative at 2
  while (beyond - below > 1e-14) (d(0.5 * (below + beyond)) > 0 ? below : beyond) = 0.5 * (below + beyond);
  const double s = below, alpha = std::sqrt(s * s - g * g), beta = std::sqrt(s * s - 1);
  const double slope = 8 * s * (2 * s * s - 1) - 8 * s * alpha * beta - 4 * s * s * s * (beta / alpha + alpha / beta);
  return M_PI * alpha * s / std::abs(slope);
}

}  // namespace

double radiation_number(double poisson_ratio)
{
  const double g = std::sqrt((1 - 2 * poisson_ratio) / (2 * (1 - poisson_ratio)));
  const double waves = bulk_waves_between(0, g, g) + bulk_waves_between(g, 1, g) + surface_wave(g);
  return std::pow(2 / (1 - poisson_ratio), 1.5) * waves / (2 * M_PI);  // (c over the speed of shear waves)^3
}

double radiation(const LawMaterial& a, double radius_a, const LawMaterial& b, double radius_b)
{
  const double duration = contact_duration(a, radius_a, b, radius_b);
  const auto of_body = [&](const LawMaterial& m, double radius) {
    const double c = wave_speed(m), remains = 1 / (1 + std::pow(duration * c / (return_times * radius), 4));
    if (remains < negligible_radiation) return 0.0;
    return radiation_number(m.poisson_ratio) * remains / (m.density * c * c * c);
  };
  return of_body(a, radius_a) + of_body(b, radius_b);
}

}  // namespace granulaw
