// What the size of a contact law costs and buys: bytes and nanoseconds a lookup against the error in force
// and e, of one law thinned to fewer nodes, fewer levels of its velocity axis, or without the axis.
//
//   law_size_benchmark LAW.h5 [-o OUT.json]
//
// Against: the law as the file has it. That law's own errors (`mpm info LAW.h5`) come on top. Of each
// variant:
//     nodes, levels, ratio_nodes   of the curve, of the axis (0: the axis is left out)
//     evaluator                    "curve": ContactCurve, as stored; "fast": FastCurve, what the plug-in
//     reads bytes                        that evaluation reads ns_load, ns_unload           CPU nanoseconds
//     for force, stiffness and contact radius: median of rounds ns_load_low, ns_load_high, ns_unload_low,
//     ns_unload_high   lowest and highest round err_force                    largest difference of force over
//     the loading force at the largest overlap
//                                  so far, over contacts whose overlaps spread over decades, each with an X
//     err_e                        largest difference of e (absolute), head-on impacts on a rigid wall from
//                                  twice the onset of yield to the end of the law, and the speed it is at
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/larger.hpp"
#include "base/version.hpp"
#include "law/fast_curve.hpp"
#include "law/law_file.hpp"
#include "law/replay.hpp"

namespace {

using namespace granulaw;
using nlohmann::json;

/// Values and slopes of a Hermite table of `from` uniform nodes, read at `to` of them. `spacing`: of the old
/// nodes.
void resample(std::vector<double>& value, std::vector<double>& slope, std::size_t to, double spacing)
{
  const std::size_t from = value.size();
  std::vector<double> v(to), s(to);
  for (std::size_t k = 0; k < to; ++k) {
    const double place = static_cast<double>(k) * static_cast<double>(from - 1) / static_cast<double>(to - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(place), from - 2);
    double c[4];
    hermite(c, value[i], value[i + 1], slope[i] * spacing, slope[i + 1] * spacing);
    v[k] = cubic(c, place - static_cast<double>(i));
    s[k] = cubic_slope(c, place - static_cast<double>(i)) / spacing;
  }
  value = std::move(v), slope = std::move(s);
}

/// Slopes with which cubics over nodes `h` apart stay above 0: up to 3/h of the value.
void keep_positive(const std::vector<double>& value, std::vector<double>& slope, double h)
{
  for (std::size_t k = 0; k < value.size(); ++k)
    slope[k] = std::clamp(slope[k], -3 / h * value[k], 3 / h * value[k]);
}

/// So that the unloading rises between the nodes, too: A >= 0 and 10 - A - 4 n >= 0.
void keep_unloading_rising(ContactCurve::Table& t, double h)
{
  keep_positive(t.hertz_share, t.hertz_share_slope, h);
  std::vector<double> room, slope;
  for (std::size_t k = 0; k < t.exponent.size(); ++k) {
    room.push_back(std::max(0.0, 10 - t.hertz_share[k] - 4 * t.exponent[k]));
    slope.push_back(-t.hertz_share_slope[k] - 4 * t.exponent_slope[k]);
  }
  keep_positive(room, slope, h);
  for (std::size_t k = 0; k < slope.size(); ++k)
    t.exponent_slope[k] = -0.25 * (slope[k] + t.hertz_share_slope[k]);
}

ContactCurve::Table thinned(ContactCurve::Table t, std::size_t nodes)
{
  const double h = t.s_end / static_cast<double>(t.force_ratio.size() - 1);
  resample(t.force_ratio, t.force_ratio_slope, nodes, h);
  resample(t.residual_ratio, t.residual_ratio_slope, nodes, h);
  resample(t.exponent, t.exponent_slope, nodes, h);
  resample(t.hertz_share, t.hertz_share_slope, nodes, h);
  resample(t.radius_ratio, t.radius_ratio_slope, nodes, h);
  keep_unloading_rising(t, t.s_end / static_cast<double>(nodes - 1));
  return t;
}

/// Fewer levels, read from those there are as the law reads them: linear in X between two.
VelocityAxis::Table thinned(VelocityAxis::Table t, std::size_t levels)
{
  const std::size_t nodes = t.ratio_nodes(), from = t.levels;
  const std::size_t at_first = std::min(t.first_levels, levels);
  const ImpactLevels before = ImpactLevels::from_standstill(from, t.first_levels, 1.0),
                     after = ImpactLevels::from_standstill(levels, at_first, 1.0);
  const auto at = [&](const std::vector<double>& all, double place, std::size_t l) {
    const auto k = std::min(static_cast<std::size_t>(place), from - 1);
    const double low = k == 0 ? 0.0 : all[(k - 1) * nodes + l], high = all[k * nodes + l];
    return low + (place - static_cast<double>(k)) * (high - low);
  };
  for (auto* all : {&t.force_correction, &t.force_correction_slope, &t.residual_correction,
                    &t.residual_correction_slope, &t.exponent_correction, &t.exponent_correction_slope}) {
    std::vector<double> fewer;
    for (std::size_t k = 1; k <= levels; ++k)
      for (std::size_t l = 0; l < nodes; ++l)
        fewer.push_back(at(*all, before.row(after.overlap(static_cast<double>(k))), l));
    *all = std::move(fewer);
  }
  t.levels = levels, t.first_levels = at_first;
  return t;
}

struct Contact
{
  double x, x_max, impact_overlap;
};

/// Overlaps spread over decades, the largest of each a tenth to 1.3 of its X; unloading, after yield: down to
/// nine tenths of the way back to the residual overlap.
std::vector<Contact> contacts_of_a_flow(const ContactCurve& law, bool unloading)
{
  std::mt19937 random(1);
  const double end = std::log10(law.x_end());
  const bool yields = law.onset() < law.x_end();
  const double begin = unloading && yields ? std::log10(law.onset()) : std::min(-5.0, end - 4);
  std::uniform_real_distribution<double> decade(begin, end), part(0.1, 1.0), ratio(0.1, 1.3);
  std::vector<Contact> all(4096);
  for (Contact& c : all) {
    c.x = c.x_max = std::pow(10.0, decade(random));
    c.impact_overlap = law.axis() ? std::min(law.axis()->overlap_end(), c.x_max / ratio(random)) : 0.0;
    const double rest = law.reversal(c.x_max, c.impact_overlap).residual, place = part(random);
    if (unloading) c.x = rest + (c.x_max - rest) * place;
    if (!unloading) c.x_max = 0;
  }
  return all;
}

double thread_ns()
{
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

/// Lowest, median, highest CPU nanoseconds of `evaluate` over the contacts, in rounds.
template <class Evaluate>
std::array<double, 3> time_of(const std::vector<Contact>& contacts, const Evaluate& evaluate)
{
  constexpr int rounds = 15, repeats = 60;
  std::vector<double> found;
  volatile double sink = 0;
  for (int round = 0; round < rounds; ++round) {
    double sum = 0;
    const double start = thread_ns();
    for (int r = 0; r < repeats; ++r)
      for (const Contact& c : contacts) {
        const ContactForce f = evaluate(c);
        sum += f.force + f.stiffness + f.contact_radius;
      }
    found.push_back((thread_ns() - start) / repeats / static_cast<double>(contacts.size()));
    sink = sink + sum;
  }
  std::sort(found.begin(), found.end());
  return {found.front(), found[rounds / 2], found.back()};
}

const PairMapping wall = PairMapping::rigid_partner(0.75);  // Hertz's force 1 at x = 1

/// e of a unit sphere thrown at the wall; `evaluate`: a variant's.
template <class Evaluate>
double restitution(const Evaluate& evaluate, double mass, double speed, double impact_overlap)
{
  const double duration = 2.87 * std::pow(mass * mass / (0.75 * 0.75 * speed), 0.2);
  const auto law = [&](double delta, double delta_max) {
    return evaluate(Contact{delta, delta_max, impact_overlap});
  };
  return replay_collision(law, mass, speed, duration, 4000).restitution;
}

/// `evaluate` beside the law of the file.
template <class Evaluate>
json measured(const BodyLaw& body, const Evaluate& evaluate, std::size_t bytes)
{
  const auto full = [&](const Contact& c) {
    return body.curve.evaluate(wall, 1.0, c.x, c.x_max, c.impact_overlap);
  };
  json found = {{"bytes", bytes}};
  double force = 0;
  for (const bool unloading : {false, true}) {
    const std::vector<Contact> contacts = contacts_of_a_flow(body.curve, unloading);
    for (const Contact& c : contacts) {
      const double top = body.curve.loading(std::max(c.x, c.x_max), c.impact_overlap).force;
      force = larger(force, std::abs(evaluate(c).force - full(c).force) / top);
    }
    const auto [low, median, high] = time_of(contacts, evaluate);
    const std::string name = unloading ? "ns_unload" : "ns_load";
    found[name] = median, found[name + "_low"] = low, found[name + "_high"] = high;
  }
  found["err_force"] = force;

  // Units here: R = 1, E* = 0.75. Y and rho in them: Y/E* from the file, rho = 1; speeds by I = rho V^2/Y.
  const double yield = 0.75 * body.material.yield_stress / body.material.e_star(), mass = 4.0 / 3.0 * M_PI;
  const double onset_work = body.curve.work_loading(body.curve.onset());
  const double slow = 2 * std::sqrt(2 * onset_work / mass);
  const double fast = std::sqrt(yield * body.certificate.damage_number_max);
  double error = 0, error_at = 0;
  for (int k = 0; k <= 12; ++k) {
    const double speed = slow * std::pow(fast / slow, k / 12.0);
    const double x = body.curve.axis() ? body.curve.axis()->impact_overlap(speed / std::sqrt(yield)) : 0.0;
    const double difference =
        std::abs(restitution(evaluate, mass, speed, x) - restitution(full, mass, speed, x));
    if (difference > error) error = difference, error_at = speed * speed / yield;
  }
  found["err_e"] = error, found["err_e_at_inertia_number"] = error_at;
  return found;
}

json variants_of(const BodyLaw& body, const std::string& path)
{
  const ContactCurve& law = body.curve;
  const std::size_t nodes = law.table().force_ratio.size(),
                    levels = law.axis() ? law.axis()->table().levels : 0;
  json rows = json::array();
  const auto add = [&](std::size_t n, std::size_t k) {
    const ContactCurve::Table table = n == nodes ? law.table() : thinned(law.table(), n);
    const auto curve = std::make_unique<ContactCurve>(
        k == 0
            ? ContactCurve(table, path)
            : ContactCurve(table, k == levels ? law.axis()->table() : thinned(law.axis()->table(), k), path));
    const std::size_t stored = (n - 1) * 16 * sizeof(double) + (curve->axis() ? curve->axis()->bytes() : 0);
    const json about = {
        {"nodes", n}, {"slices", k}, {"ratio_nodes", k ? law.axis()->table().ratio_nodes() : 0}};
    const auto keep = [&](const char* evaluator, json row) {
      row.update(about);
      row["evaluator"] = evaluator;
      fmt::print("{}\n", row.dump());
      rows.push_back(std::move(row));
    };
    keep("curve", measured(
                      body,
                      [&](const Contact& c) {
                        return curve->evaluate(wall, 1.0, c.x, c.x_max, k ? c.impact_overlap : 0.0);
                      },
                      stored));
    const FastCurve fast(*curve);
    keep("fast", measured(
                     body,
                     [&](const Contact& c) {
                       return fast.evaluate(wall, 1.0, c.x, c.x_max, k ? c.impact_overlap : 0.0);
                     },
                     fast.bytes()));
  };
  std::vector<std::size_t> lengths;
  for (std::size_t n = 8; n < nodes; n *= 2) lengths.push_back(n);
  lengths.push_back(nodes);
  for (const std::size_t n : lengths) add(n, levels);
  for (std::size_t k = levels / 2; k > 0; k /= 2) add(nodes, k);
  if (levels)
    for (const std::size_t n : lengths) add(n, 0);
  return rows;
}

}  // namespace

int main(int argc, char** argv)
{
  if ((argc != 2 && argc != 4) || (argc == 4 && std::string(argv[2]) != "-o")) {
    fmt::print(stderr, "law_size_benchmark LAW.h5 [-o OUT.json]\n");
    return 2;
  }
  try {
    const Law law = read_law(argv[1]);
    const auto body = std::find_if(law.bodies.begin(), law.bodies.end(),
                                   [](const auto& b) { return b.second.material.yields(); });
    if (body == law.bodies.end())
      fail(argv[1], "no material of this law yields: it is Hertz's, whatever its size");
    const Certificate& c = body->second.certificate;
    json found = {{"benchmark", "law_size"},
                  {"granulaw_version", version()},
                  {"git_hash", git_hash()},
                  {"law", argv[1]},
                  {"material", body->first},
                  {"own_errors",
                   {{"origin", c.origin},
                    {"solver_error_force", c.solver_error_force},
                    {"solver_error_restitution", c.solver_error_restitution},
                    {"atlas_error_force", c.atlas_error_force},
                    {"atlas_error_restitution", c.atlas_error_restitution}}}};
    const auto hertz = [](const Contact& contact) {
      const double a = std::sqrt(contact.x);
      return ContactForce{a * contact.x, 1.5 * a, a, contact.x};
    };
    const auto [low, median, high] = time_of(contacts_of_a_flow(body->second.curve, false), hertz);
    found["hertz"] = {{"ns", median}, {"ns_low", low}, {"ns_high", high}};
    found["rows"] = variants_of(body->second, argv[1]);
    if (argc == 4)
      write_atomically(argv[3],
                       [&](const std::string& path) { std::ofstream(path) << found.dump(1) << "\n"; });
  } catch (const Error& error) {
    fmt::print(stderr, "law_size_benchmark: {}\n", error.what());
    return 2;
  }
}
