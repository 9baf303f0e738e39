// Cost and benefit of the velocity axis of a contact law: bytes and nanoseconds a lookup against the error in
// force and e of the law without it.
//
//   law_size_benchmark LAW.h5          prints a line of JSON for each variant, and one for Hertz's formula
//
// Against: the law as the file has it. That law's own errors (`mpm info LAW.h5`) come on top. Columns of each
// variant:
//     nodes, slices, ratio_nodes   of the curve, levels of the axis and their nodes (0: the axis is left out)
//     bytes                        that evaluation reads
//     ns_load, ns_unload           CPU nanoseconds for force, stiffness and contact radius: median of rounds;
//                                  with _low and _high the lowest and highest round
//     err_force                    largest difference of force over the loading force at the largest overlap
//                                  so far, over contacts whose overlaps spread over decades, each with an X
//     err_e                        largest difference of e (absolute), head-on impacts on a rigid wall from
//                                  twice the onset of yield to the end of the law, and the speed it is at
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>
#include <random>

#include "base/error.hpp"
#include "base/larger.hpp"
#include "contact/contact.hpp"
#include "law/law_file.hpp"
#include "law/replay.hpp"

namespace {

using namespace granulaw;
using nlohmann::json;

struct Contact
{
  double x, x_max, impact_overlap;
};

/// Overlaps spread over decades, the largest of each a tenth to 1.3 of its X; unloading, after yield: down to
/// nine tenths of the way back to the residual overlap.
std::vector<Contact> contacts_of_a_flow(const Curve& law, bool unloading)
{
  std::mt19937 random(1);
  const double end = std::log10(law.end());
  const bool yields = law.onset() < law.end();
  const double begin = unloading && yields ? std::log10(law.onset()) : std::min(-5.0, end - 4);
  std::uniform_real_distribution<double> decade(begin, end), part(0.1, 1.0), ratio(0.1, 1.3);
  std::vector<Contact> all(4096);
  for (Contact& c : all) {
    c.x = c.x_max = std::pow(10.0, decade(random));
    c.impact_overlap = law.axis() ? std::min(law.axis()->level.back(), c.x_max / ratio(random)) : 0.0;
    const double rest = law.reversal(c.x_max, c.impact_overlap).residual(), place = part(random);
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
        const Answer f = evaluate(c);
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
    return answer(body.curve, wall, 1.0, c.x, c.x_max, c.impact_overlap);
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
  const double onset_work = body.curve.work(body.curve.onset());
  const double slow = 2 * std::sqrt(2 * onset_work / mass);
  const double fast = std::sqrt(yield * body.certificate.damage_number_max);
  double error = 0, error_at = 0;
  for (int k = 0; k <= 12; ++k) {
    const double speed = slow * std::pow(fast / slow, k / 12.0);
    const double x = body.curve.reach(speed / std::sqrt(yield));
    const double difference =
        std::abs(restitution(evaluate, mass, speed, x) - restitution(full, mass, speed, x));
    if (difference > error) error = difference, error_at = speed * speed / yield;
  }
  found["err_e"] = error, found["err_e_at_inertia_number"] = error_at;
  return found;
}

void print_variants(const BodyLaw& body)
{
  const Curve& law = body.curve;
  const auto add = [&](const Curve& curve) {
    const AxisTable* axis = curve.axis();
    json row = measured(
        body,
        [&](const Contact& c) {
          return answer(curve, wall, 1.0, c.x, c.x_max, axis ? c.impact_overlap : 0.0);
        },
        curve.bytes());
    row.update({{"nodes", law.table().force.size()},
                {"slices", axis ? axis->level.size() : 0},
                {"ratio_nodes", axis ? axis->shares() : 0}});
    fmt::print("{}\n", row.dump());
  };
  add(law);
  if (law.axis()) add(Curve(law.table()));
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc != 2) {
    fmt::print(stderr, "law_size_benchmark LAW.h5\n");
    return 2;
  }
  try {
    const Law law = read_law(argv[1]);
    const auto body = std::find_if(law.bodies.begin(), law.bodies.end(),
                                   [](const auto& b) { return b.second.material.yields(); });
    if (body == law.bodies.end())
      fail(argv[1], "no material of this law yields: it is Hertz's, whatever its size");
    print_variants(body->second);
    const auto hertz = [](const Contact& contact) {
      const double a = std::sqrt(contact.x);
      return Answer{a * contact.x, 1.5 * a, a, contact.x};
    };
    const auto [low, median, high] = time_of(contacts_of_a_flow(body->second.curve, false), hertz);
    fmt::print("{}\n", json{{"ns", median}, {"ns_low", low}, {"ns_high", high}}.dump());
  } catch (const Error& error) {
    fmt::print(stderr, "law_size_benchmark: {}\n", error.what());
    return 2;
  }
}
