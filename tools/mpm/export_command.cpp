// mpm export: a law as plain columns, for codes that do not read the law file.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <memory>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "command.hpp"
#include "law/pair_statement.hpp"
#include "law/law_file.hpp"
#include "law/pair_names.hpp"
#include "option_checks.hpp"

namespace granulaw {

namespace of_export {

struct ExportRequest
{
  std::string law, output, pair;
  double r_eff = 1e-3;      // m
  double radius_ratio = 1;  // of the pair's second body over the first; infinity: a thick deformable wall
  double speed = 0;         // m/s at first touch; 0: quasi-static
  bool dimensionless = false;
  int points = 400;
};

void write_heading(std::ostream& out, const Law& law, const ExportRequest& r)
{
  out << fmt::format("# contact law, exported from {}; formulas: docs/reference/law-format.md of granulaw\n", r.law);
  for (const char* note : {"version", "git_hash"})
    if (const auto found = law.provenance.find(note); found != law.provenance.end()) out << fmt::format("# {} = {}\n", note, printable(found->second));
  out << "# one row: loading for the first time up to this overlap, and what follows if the contact turns there\n"
         "# loading (overlap d not below the largest so far, d_m): force, stiffness, contact_radius of the row at d\n"
         "# unloading and reloading (d < d_m): F = force(d_m) phi(u), u = (d - d_r)/(d_m - d_r), 0 where u < 0;\n"
         "#   phi = A u^1.5 + B u^2 + C u^2.5, A = foot, B = 5 - 2 A - 2 n, C = A + 2 n - 4, n = exponent,\n"
         "#   d_r = residual_overlap of the row at d_m; contact radius: docs/theory/law.md\n"
         "# while yielded = 0 at d_m the contact is elastic: loading, unloading and reloading are one curve\n"
         "# d_m is reset when the overlap ends; rows are uniform in overlap^(1/4): interpolate in that\n";
  if (r.dimensionless)
    out << "# x = d/(lambda R*); force in 4/3 E* lambda R*^2, stiffness in 4/3 E* R*, radius in sqrt(lambda) R*\n";
  else
    out << fmt::format("# SI units, for R* = R_i R_j/(R_i + R_j) = {:.10g} m (R* = R_i on a wall)\n", r.r_eff);
}

/// The pair's law at the ratio of radii asked for. On the rigid wall the ratio has no meaning.
PairLaw asked_law(const Law& law, const PairNames& names, const ExportRequest& r)
{
  const auto& [a, b] = names;
  return resolve_pair(law, a, b, r.law, 1.0, b == wall_name ? 1.0 : r.radius_ratio);
}

/// Kind of the law, its error bound, and how far the ratio of radii lies from it.
void write_statement(std::ostream& out, const Law& law, const PairLaw& pair, const PairNames& names, const ExportRequest& r)
{
  const auto& [a, b] = names;
  PairStatement stated = statement_of(law, pair, a, b);
  std::string radii = "rigid wall";
  if (b != wall_name) {
    stated = stated.at_distance(distance_in_size(law, pair, a, b, 1.0, r.radius_ratio));
    radii = std::isfinite(r.radius_ratio) ? fmt::format("radii 1 : {:.6g}", r.radius_ratio) : std::string("radii 1 : a deformable wall");
  }
  out << fmt::format("# {}:{}: {} law, {}, error bound {}{}\n", a, b, name_of(stated.kind), radii, stated.bound.text(),
      stated.covers_size() ? std::string() : fmt::format(", but the nearest law is {:.2g} off in R_s/(R_s + R_h)", stated.size_off));
}

void write_pair(std::ostream& out, const PairLaw& pair, const std::string& name, const ExportRequest& r)
{
  const PairMapping& m = pair.mapping;
  const Curve& curve = *pair.curve;
  const double lambda = m.sqrt_lambda * m.sqrt_lambda;
  const double length = r.dimensionless ? 1 : m.length(r.r_eff), force = r.dimensionless ? 1 : m.force(r.r_eff), radius = r.dimensionless ? 1 : m.radius(r.r_eff);
  out << fmt::format("# {}: {} yields, E* = {:.10g} Pa (its own), lambda = {:.10g}, ", name, pair.yielding->material.name, m.e_star, lambda);
  out << (std::isfinite(curve.onset()) ? fmt::format("onset of yield at overlap {:.10g}\n", curve.onset() * length) : std::string("elastic\n"));
  const double impact_overlap = pair.impact_overlap(r.r_eff, pair.usual_mass(r.r_eff), r.speed);
  if (r.speed > 0)
    out << (curve.axis() ? fmt::format("# {}: first touch at {:.10g} m/s, impact overlap X = {:.10g}\n", name, r.speed, impact_overlap * length)
                         : fmt::format("# {}: the law has no velocity axis: quasi-static at any speed\n", name));
  for (int k = 0; k <= r.points; ++k) {
    const double x = std::min(curve.end() * std::pow(static_cast<double>(k) / r.points, 4), curve.end());
    const Curve::Loading now = curve.loading(x, impact_overlap);
    const Reversal t = k > 0 ? curve.reversal(x, impact_overlap) : Reversal{};
    const UnloadingShape shape = k > 0 ? t.shape() : UnloadingShape{};
    const bool yielded = x > curve.onset();
    out << fmt::format("{},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{}\n", name, length * x, force * now.force, force / length * now.stiffness,
        radius * now.radius, yielded ? length * t.residual() : 0.0, shape.exponent, shape.hertz_share, yielded ? 1 : 0);
  }
}

/// Throws Error where the pair's law does not hold for the size or the speed asked for.
void check_pair(const PairLaw& pair, const PairNames& names, const ExportRequest& r)
{
  const auto& [a, b] = names;
  // a rate-dependent law's one size: as R* on a wall and in a like pair; other partners have any
  if (!r.dimensionless && (b == wall_name || a == b)) check_size(pair, b == wall_name ? r.r_eff : 2 * r.r_eff, "--effective-radius");
  const double mass = pair.usual_mass(r.r_eff), slowest = pair.min_speed(r.r_eff, mass), fastest = pair.max_speed(r.r_eff, mass);
  if (r.speed > 0 && r.speed < slowest)
    fail("--speed", fmt::format("the rate axis of the law for {}:{} begins above it", a, b), fmt::format("{:g} m/s", r.speed), fmt::format("{:g} m/s or more", slowest));
  if (r.speed > fastest)
    fail("--speed", fmt::format("the law's velocity axis for {}:{} ends below it", a, b), fmt::format("{:g} m/s", r.speed), fmt::format("up to {:g} m/s", fastest));
}

void write_csv(const Law& law, const std::vector<PairNames>& pairs, const ExportRequest& r)
{
  write_atomically(r.output, [&](const std::string& temporary) {
    std::ofstream out(temporary);
    write_heading(out, law, r);
    out << (r.dimensionless ? "pair,overlap,force,stiffness,contact_radius,residual_overlap,exponent,hertz_share,yielded\n"
                            : "pair,overlap_m,force_N,stiffness_N_per_m,contact_radius_m,residual_overlap_m,exponent,foot,yielded\n");
    for (const PairNames& names : pairs) {
      const PairLaw pair = asked_law(law, names, r);
      write_statement(out, law, pair, names, r);
      write_pair(out, pair, names.first + ":" + names.second, r);
    }
    if (!out.flush()) fail(r.output, "cannot be written (disk full?)");
  });
}

void export_law(const ExportRequest& r)
{
  check_output("-o", r.output, ".csv");
  const Law law = read_law(r.law);
  require(r.r_eff > 0 && std::isfinite(r.r_eff), "--effective-radius", fmt::format("{:g} m", r.r_eff), "over 0");
  require(r.radius_ratio > 0, "--radius-ratio", fmt::format("{:g}", r.radius_ratio), "over 0, or inf");
  const std::vector<PairNames> pairs = pairs_asked(r.pair, law);
  require(r.speed >= 0 && std::isfinite(r.speed), "--speed", fmt::format("{:g} m/s", r.speed), "0 or more");
  for (const PairNames& names : pairs) check_pair(asked_law(law, names, r), names, r);
  write_csv(law, pairs, r);
  fmt::print("wrote {}: {} pairs of {} rows\n", r.output, pairs.size(), r.points + 1);
}

void define(Options& command)
{
  const auto r = std::make_shared<ExportRequest>();
  command.add_option("LAW", r->law, "law file of mpm table").required();
  command.add_option("-o,--output", r->output, "NAME.csv").required();
  command.add_option("--pair", r->pair, "a:b or a:wall (default: every pair of the file)");
  const Option radius = command.add_option("--effective-radius", r->r_eff, "R* = R_i R_j/(R_i + R_j), on a wall R_i, m (default 1e-3)");
  command.add_flag("--dimensionless", r->dimensionless, "overlap in lambda R*, force in 4/3 E* lambda R*^2, and so on").excludes(radius);
  command.add_option("--radius-ratio", r->radius_ratio, "radius of the pair's second body over the first's (default 1); inf: a thick deformable wall");
  command.add_option("--speed", r->speed, "relative normal speed at first touch, m/s, for laws with a velocity axis (default 0: quasi-static)");
  command.add_option("--points", r->points, "intervals, uniform in overlap^(1/4) (default 400)").check(whole_from_to(10, 100000));
  command.callback([r] { export_law(*r); });
}

}  // namespace of_export

extern const Command export_command{"export",
    "A law as columns of a CSV file, for other codes: loading force, stiffness and contact radius against\n"
    "overlap. For a reversal there: residual overlap, exponent and foot (Hertz coefficient) of the unloading. Lines that begin with # state the\n"
    "units and the formulas. Example: mpm export law.h5 -o law.csv --pair powder:wall --effective-radius 2e-3",
    of_export::define};

}  // namespace granulaw
