// bench_loop_law FILE ONSET: writes the synthetic law with onset of yield at x = ONSET (overlap/R on a rigid
// wall) and prints the largest error of the contact loop's force against the functions the law was sampled
// from, over 200,000 random states (loading and unloading), relative to the force at the turning point.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "law/fast_curve.hpp"
#include "law/law_file.hpp"
#include "synthetic_law.hpp"

int main(int argc, char** argv)
{
  if (argc != 3) return 2;
  granulaw::testing::SyntheticLaw shape;
  shape.onset = std::strtod(argv[2], nullptr);
  granulaw::Law law = shape.law();
  law.bodies.at("powder").material.youngs_modulus = 9.1e7;  // as loop.py
  granulaw::write_law(law, argv[1]);

  const auto q_of = [&](double s) { return granulaw::testing::SyntheticLaw::past(s, shape.onset); };
  const auto loading = [&](double x) {
    const double s = std::pow(x, 0.25), q = q_of(s);
    return std::pow(x, 1.5) * (1 + shape.finite_sphere * s * s) *
           std::exp(-shape.softening * q * q / (1 + q));
  };
  const auto force = [&](double x, double x_max) {
    if (x >= x_max || x_max <= shape.onset) return loading(x);
    const double s = std::pow(x_max, 0.25), q = q_of(s);
    const double residual = x_max * (1 - std::exp(-shape.depth * q * q));
    const double n = shape.elastic_exponent(s) + shape.bend * q * q / (1 + q * q);
    const double u = (x - residual) / (x_max - residual);
    return u <= 0 ? 0.0 : loading(x_max) * std::pow(u, n);
  };

  const granulaw::ContactCurve& curve = law.bodies.at("powder").curve;
  const granulaw::FastCurve table(curve);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> log_x(std::log(1e-7), std::log(shape.x_end)), part(0.0, 1.2);
  double worst = 0;
  for (int k = 0; k < 200000; ++k) {
    const double x_max = std::exp(log_x(random)), x = std::min(x_max * part(random), shape.x_end);
    const double found = table.force(x, x_max, x / x_max);
    worst = std::max(worst, std::abs(found - force(x, x_max)) / loading(std::max(x, x_max)));
  }
  std::printf("%.3g\n", worst);
}
