// bench_loop_law one FILE ONSET: writes the synthetic law with onset of yield at x = ONSET (overlap/R on a
// rigid wall) and prints the largest error of the contact loop's force against the functions the law was
// sampled from, over 200,000 random states (loading and unloading), relative to the force at the turning
// point. bench_loop_law axis FILE: with a velocity axis. bench_loop_law four FILE:
// four materials and a law of its own for each of their ten pairs; prints the largest of their ten errors.
// bench_loop_law four FILE RATIO...: those of unlike materials composed, so that they radiate, at these
// ratios. bench_loop_law rule FILE: the four materials without laws of their pairs.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "base/larger.hpp"
#include "contact/contact.hpp"
#include "law/law_file.hpp"
#include "synthetic_law.hpp"

namespace {

using granulaw::tests::SyntheticLaw;

/// Largest difference of the loading force from the functions that the table was sampled from, relative.
double worst_error(const SyntheticLaw& shape, const granulaw::Curve& curve)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> log_x(std::log(1e-7), std::log(curve.end()));
  double worst = 0;
  for (int k = 0; k < 200000; ++k) {
    const double x = std::exp(log_x(random));
    worst = granulaw::larger(worst, std::abs(curve.force(x) / shape.force(x) - 1));
  }
  return worst;
}

constexpr double youngs_modulus = 9.1e7;  // as loop.py
constexpr double modulus_over_yield =
    4;  // E*/Y that the law states: so strong a sphere ends its contact before waves return (radiation.hpp)

double one(const char* file, double onset)
{
  SyntheticLaw shape;
  shape.onset = onset;
  granulaw::Law law = shape.law();
  granulaw::BodyLaw& powder = law.bodies.at("powder");
  powder.material.youngs_modulus = youngs_modulus;
  powder.curve = shape.curve();
  granulaw::write_law(law, file);
  return worst_error(shape, powder.curve);
}

double with_axis(const char* file)
{
  granulaw::Law law = SyntheticLaw{}.law_with_axis();
  granulaw::BodyLaw& powder = law.bodies.at("powder");
  powder.material.youngs_modulus = youngs_modulus;
  powder.material.yield_stress *= 1e-2;  // as Young's modulus: the speeds of the flow are within the axis
  granulaw::write_law(law, file);
  return worst_error(SyntheticLaw{}, powder.curve);
}

/// `ratios`: none: one law for each pair, as from runs. `pair_laws` false: every pair follows the pair rule.
double four(const char* file, const std::vector<double>& ratios, bool pair_laws = true)
{
  const std::vector<std::string> names{"a", "b", "c", "d"};
  granulaw::Law law;
  double worst = 0, onset = 3e-4;
  const auto body = [&](const std::string& name) {
    SyntheticLaw shape;
    shape.onset = onset *= 1.2;  // ten curves, no two alike
    granulaw::BodyLaw result = shape.law().bodies.at("powder");
    result.curve = shape.curve();
    result.material.name = name;
    result.material.youngs_modulus = youngs_modulus;
    // of four materials the first yields against the others
    result.material.yield_stress = result.material.e_star() / modulus_over_yield * std::sqrt(onset / 3e-4);
    worst = granulaw::larger(worst, worst_error(shape, result.curve));
    return result;
  };
  for (const std::string& name : names) {
    law.bodies[name] = body(name);
    law.pairs.push_back({name, granulaw::wall_name});
  }
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t j = i; j < names.size(); ++j) {
      law.pairs.push_back({names[i], names[j]});
      if (i == j || !pair_laws) continue;
      granulaw::TwoBodyLaw own{body(names[i])};
      own.law.material = law.bodies[names[i]].material;  // of the pair's weaker body
      std::vector<granulaw::TwoBodyLaw>& laws = law.pair_laws[names[i] + ":" + names[j]];
      laws.assign(std::max<std::size_t>(1, ratios.size()), own);
      for (std::size_t k = 0; k < ratios.size(); ++k) {
        laws[k].radius_ratio = ratios[k];
        laws[k].law.certificate.origin = granulaw::composed_origin;
      }
    }
  granulaw::write_law(law, file);
  return worst;
}

}  // namespace

int main(int argc, char** argv)
{
  const std::string kind = argc > 2 ? argv[1] : "";
  if (kind == "one" && argc == 4)
    std::printf("%.3g\n", one(argv[2], std::strtod(argv[3], nullptr)));
  else if (kind == "axis" && argc == 3)
    std::printf("%.3g\n", with_axis(argv[2]));
  else if (kind == "rule" && argc == 3)
    std::printf("%.3g\n", four(argv[2], {}, false));
  else if (kind == "four") {
    std::vector<double> ratios;
    for (int k = 3; k < argc; ++k) ratios.push_back(std::strtod(argv[k], nullptr));
    std::printf("%.3g\n", four(argv[2], ratios));
  } else
    return 2;
}
