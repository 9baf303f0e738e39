// Synthetic laboratories: random materials, measured with noise, calibrated; how often the truth lies in the
// intervals, and how near the values are (docs/evidence/calibration.md). What is measured comes from laws as `mpm table`
// makes them (drops), and from the atlas's midplane curves (platens).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>

#include "characterise/atlas_file.hpp"
#include "base/scales.hpp"
#include "calibrate/calibrate.hpp"
#include "calibrate/kind/kind.hpp"
#include "calibrate/noise.hpp"
#include "characterise/body/characterised_body.hpp"
#include "atlas/law_from_atlas.hpp"
#include "law/replay.hpp"

namespace {

using namespace granulaw;

constexpr double radius = 1e-3, density = 1500;

/// One laboratory's sources of chance.
class Chance
{
 public:
  explicit Chance(unsigned seed) : random_(seed) {}
  double uniform(double low, double high)
  {
    return low + (high - low) * static_cast<double>(random_()) / 4294967296.0;
  }
  double between(double low, double high) { return low * std::pow(high / low, uniform(0, 1)); }
  double normal() { return normal_(random_); }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

LawMaterial random_material(Chance& chance, bool hardens)
{
  LawMaterial m;
  m.name = "synthetic";
  m.density = density;
  m.poisson_ratio = chance.uniform(0, 0.45);
  m.youngs_modulus = chance.between(1e8, 1e11);
  m.yield_stress = m.e_star() / chance.between(30, 2000);
  if (hardens && chance.uniform(0, 1) < 0.75)
    m.hardening_modulus = m.youngs_modulus * chance.between(1e-3, 0.1);
  return m;
}

Measurement drops(const Atlas& atlas, const LawMaterial& m, Chance& chance, int count, double noise)
{
  LawRange options;
  options.depth = Atlas::depth;
  options.fastest = SphereLaws::fastest;
  const BodyLaw law = law_from(atlas, m, options);
  const double mass = 4.0 / 3.0 * M_PI * density * std::pow(radius, 3);
  const double slow = 2 * yield_velocity(m.e_star(), m.yield_stress, m.density);
  const double fast = std::min(100 * slow, 0.2 * std::sqrt(m.yield_stress / m.density));
  Measurement measured;
  measured.source = "drops";
  measured.radius = radius;
  for (int k = 0; k < count; ++k) {
    const double v = slow * std::pow(fast / slow, static_cast<double>(k) / (count - 1));
    const double e = replay_on_wall(law, radius, mass, v).restitution;
    measured.data.push_back({v, std::min(1.0, e * (1 + noise * chance.normal())), 0, k + 2});
  }
  complete_standard_deviations(measured, 0.01);
  return measured;
}

Measurement platens(const Atlas& atlas, const LawMaterial& m, Chance& chance, double noise)
{
  constexpr int loading = 60, unloading = 30;
  const SphereLaws laws(atlas, MaterialRatios::of(m));
  const double unit = 4.0 / 3.0 * m.e_star() * radius * radius;
  const double depth = chance.between(std::max(20 * laws.onset(), 0.01), std::max(25 * laws.onset(), 0.2));
  const double x_m = std::min(depth, 0.3);
  const Reversal top = laws.midplane().reversal(x_m);
  const double offset = chance.uniform(-0.05, 0.05) * 2 * x_m * radius;
  Measurement measured;
  measured.kind = &kind_named("platens", "study");
  measured.source = "platens";
  measured.radius = radius;
  measured.fit_offset = true;
  const auto add = [&](double x, double force) {
    const double d = 2 * x * radius + offset;
    measured.data.push_back(
        {d, unit * force * (1 + noise * chance.normal()), 0, static_cast<int>(measured.data.size()) + 2});
  };
  for (int k = 1; k <= loading; ++k) {
    const double x = x_m * k / loading;
    add(x, laws.midplane().loading(x).force);
  }
  for (int k = unloading - 1; k > 0; --k) {
    const double u = static_cast<double>(k) / unloading;
    add(top.residual() + u * (x_m - top.residual()), top.force_at(u, std::sqrt(u)));
  }
  complete_standard_deviations(measured, 0.01);
  return measured;
}

/// Counts over the synthetic data sets for one parameter.
struct Tally
{
  int labs = 0, told = 0, within = 0, all_within = 0;
  std::vector<double> errors;
  void add(const FittedParameter& p, double truth)
  {
    ++labs;
    const Interval& i = p.profile.within95;
    const bool inside = i.low * (1 - 1e-9) <= truth && truth <= i.high * (1 + 1e-9);
    all_within += inside;
    if (!p.identifiable()) return;
    ++told;
    within += inside;
    if (truth > 0) errors.push_back(std::abs(p.profile.value / truth - 1));
  }
  double median() const
  {
    if (errors.empty()) return 0;
    std::vector<double> sorted = errors;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
};

}  // namespace

int main(int argc, char** argv)
{
  CLI::App app{"Synthetic laboratories: how true the intervals of mpm calibrate are."};
  std::string atlas_file, kind = "drops";
  int count = 100;
  unsigned seed = 1;
  double noise = 0.01;
  std::vector<std::string> wanted{"yield_stress"};
  bool verbose = false;
  app.add_option("ATLAS", atlas_file)->required();
  app.add_option("--kind", kind, "drops, platens")->check(CLI::IsMember({"drops", "platens"}));
  app.add_option("--fit", wanted);
  app.add_option("--count", count);
  app.add_option("--seed", seed);
  app.add_option("--noise", noise);
  app.add_flag("--verbose", verbose);
  CLI11_PARSE(app, argc, argv);

  const Atlas atlas = read_atlas(atlas_file);
  std::vector<Parameter> fit;
  for (const std::string& name : wanted) fit.push_back(parameter_named(name, "--fit"));
  const bool hardens = std::find(fit.begin(), fit.end(), Parameter::hardening_modulus) != fit.end();
  std::vector<Tally> tallies(fit.size());
  std::vector<double> seconds;
  int misfits = 0, unlikely = 0;
  for (int lab = 0; lab < count; ++lab) {
    Chance chance(seed * 1000 + static_cast<unsigned>(lab));
    const LawMaterial truth = random_material(chance, hardens);
    CalibrationRequest request;
    request.known = truth;
    request.fit = fit;
    for (const Parameter p : fit) set_value(request.known, p, 0);
    request.measurements = {kind == "drops" ? drops(atlas, truth, chance, 8, noise)
                                            : platens(atlas, truth, chance, noise)};
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    const CalibrationProblem problem(atlas, request);
    const Calibration c = calibrate(problem);
    seconds.push_back(static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC);
    (void)start;
    misfits += !c.misfits.empty();
    unlikely += c.p_value < 0.05;
    for (std::size_t k = 0; k < fit.size(); ++k) {
      tallies[k].add(c.parameters[k], value_of(truth, fit[k]));
      if (verbose) {
        const auto& p = c.parameters[k].profile;
        fmt::print(
            "{:3} E*/Y {:6.1f} nu {:.2f} H/E {:.4f} {}: {:.4g} truth {:.4g}, 95 % {:.4g} to {:.4g}{}\n", lab,
            truth.e_star() / truth.yield_stress, truth.poisson_ratio,
            truth.hardening_modulus / truth.youngs_modulus, name_of(fit[k]), p.value, value_of(truth, fit[k]),
            p.within95.low, p.within95.high, c.parameters[k].identifiable() ? "" : " (not told)");
      }
    }
    if (verbose)
      for (const Misfit& m : c.misfits) fmt::print("    {}\n", m.sentence);
    std::fflush(stdout);
  }
  for (std::size_t k = 0; k < fit.size(); ++k)
    fmt::print(
        "{:<18} told in {} of {} laboratories; truth within 95 % in {} of {} told, {} of all; median error "
        "{:.2f} %\n",
        name_of(fit[k]), tallies[k].told, tallies[k].labs, tallies[k].within, tallies[k].told,
        tallies[k].all_within, 100 * tallies[k].median());
  std::sort(seconds.begin(), seconds.end());
  fmt::print("misfits named in {}; p below 0.05 in {}; CPU s: median {:.2f}, longest {:.2f}\n", misfits,
             unlikely, seconds[seconds.size() / 2], seconds.back());
}
