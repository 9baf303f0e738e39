// Indentations by the solver, from which mpm_core/calibrate/kind/hardness_table.hpp is made (docs/evidence/hardness.md):
// elastic cones and Brinell's ball in two dimensions, Vickers' pyramid with friction in three.
//
//   granulaw_hardness_study FILE.csv      30 CPU minutes
//
// The material is a half space of E* = 1 and nu (0.3), with Swift's power law, Y (1 + E ep/Y)^exponent: its flow stress
// at a plastic strain of 8 % is 1/stiffness; stiffness 0: elastic. `place`: the cone's semi-angle, degrees; of the ball
// a/R. `pressure`: mean pressure on the area of the contact, by the pyramid's diagonals, over the flow stress at the
// representative strain (8 %; of the ball 0.2 a/R). `spread`: radius of the contact over that where the undeformed
// surface cuts the indenter. Elastic: the force over Sneddon's 2/pi E* tan(angle) depth^2, by the slope of its root.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <fstream>

#include "base/error.hpp"
#include "solver/contact/planes.hpp"
#include "solver/grid/spatial_grid.hpp"
#include "solver/loading/press.hpp"
#include "solver/material/law_table.hpp"
#include "solver/run/axisymmetric_setup.hpp"
#include "solver/run/simulation.hpp"
#include "solver/runs.hpp"
#include "solver/shape/shapes.hpp"

namespace {

using namespace granulaw;

struct Case
{
  std::string indenter;  ///< cone, ball, pyramid
  double stiffness = 0, exponent = 0;
  double friction = 0;  ///< of the pyramid
  double nu = 0.3, angle = 70.3;
  int cells = 12;
};

struct Row
{
  double place, pressure, spread;
};

constexpr double vickers_strain = 0.08, brinell_strain = 0.2;  // plastic; over a/R (Tabor 1951)

Material half_space(const Case& c)
{
  Material m;
  m.density = 1, m.poisson_ratio = c.nu, m.youngs_modulus = 1 - c.nu * c.nu;
  if (c.stiffness == 0) return m;
  double low = 1e-12, high = 1 / c.stiffness;  // Y by bisection
  for (int k = 0; k < 200; ++k) {
    const double y = std::sqrt(low * high);
    (y * std::pow(1 + m.youngs_modulus * vickers_strain / y, c.exponent) < 1 / c.stiffness ? low : high) = y;
  }
  m.yield_stress = c.exponent > 0 ? low : 1 / c.stiffness;
  const double offset = m.yield_stress / m.youngs_modulus;
  if (c.exponent > 0)
    m.hardening = {"swift",
                   {{"strength", {m.yield_stress / std::pow(offset, c.exponent)}},
                    {"exponent", {c.exponent}},
                    {"offset", {offset}}}};
  return m;
}

/// Loading so slow that rho v^2 over the flow stress stays below `inertia`.
double ramp_of(const Case& c, double depth, double inertia)
{
  return std::max(60.0, 0.5 * M_PI * depth * std::sqrt(c.stiffness / inertia));
}

/// Least squares y = a + b x.
std::pair<double, double> line_through(const std::vector<std::pair<double, double>>& points)
{
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [px, py] : points) n += 1, x += px, y += py, xx += px * px, xy += px * py;
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  return {(y - slope * x) / n, slope};
}

/// A body of revolution, a thousand times as stiff as the half space and as dense, so that waves have one speed.
RunResult press_into(const Case& c, const std::vector<ProfilePoint>& profile, double depth)
{
  constexpr double rigid = 1000;
  Material hard;
  hard.density = rigid, hard.poisson_ratio = 0.3, hard.youngs_modulus = rigid * (1 - 0.09);
  Particle p = Particle::sphere(1, hard);
  if (!profile.empty()) p.profile = Profile(profile);
  PressPlan plan;
  plan.depth = depth, plan.ramp = ramp_of(c, depth, 4e-4);
  Partner wall;
  wall.wall = half_space(c);
  RunOptions options;
  options.resolution = c.cells, options.shifted_grids = c.stiffness > 0 ? 2 : 1;
  return press(p, plan, wall, options);
}

/// Samples of the loading with a force, from an overlap on.
std::vector<TraceSample> loading(const RunResult& run, double from)
{
  std::vector<TraceSample> all;
  for (const TraceSample& t : run.trace)
    if (t.branch == Branch::load && t.delta >= from && t.force > 0) all.push_back(t);
  return all;
}

/// Elastic; to 0.6 of the cone's radius, cos(angle). Its tip has 0.03. By self-similarity the root of the force is linear
/// in the depth.
std::vector<Row> cone(const Case& c)
{
  const double tangent = std::tan(c.angle * M_PI / 180);
  const double depth = M_PI / 2 / tangent * 0.6 * std::cos(c.angle * M_PI / 180);
  std::vector<std::pair<double, double>> force, radius;
  for (const TraceSample& t : loading(press_into(c, conical_tip(1, c.angle, 0.03), depth), 0.4 * depth))
    force.emplace_back(t.delta, std::sqrt(t.force)), radius.emplace_back(t.delta, t.contact_radius);
  const double slope = line_through(force).second;
  return {{c.angle, slope * slope / (2 / M_PI * tangent), line_through(radius).second / tangent}};
}

/// Two presses, so that the contact spans ten cells or more at each place.
std::vector<Row> ball(const Case& c)
{
  const Material m = half_space(c);
  std::vector<Row> rows;
  for (const auto& [depth, places] : {std::pair{0.08, std::vector{0.25, 0.3, 0.35}}, {0.25, std::vector{0.4, 0.45, 0.5, 0.55}}}) {
    const std::vector<TraceSample> samples = loading(press_into(c, {}, depth), 0.05 * depth);
    for (const double u : places) {
      std::vector<std::pair<double, double>> near;  // pressure about this radius, linear in ln a
      double spread = 0;
      for (const TraceSample& t : samples)
        if (const double a = t.contact_radius; std::abs(std::log(a / u)) < 0.15) {
          near.emplace_back(std::log(a / u), std::log(t.force / (M_PI * a * a)));
          spread += a / std::sqrt(t.delta * (2 - t.delta));
        }
      if (near.size() < 10 || near.back().first < 0) continue;
      rows.push_back({u, std::exp(line_through(near).first) / flow_stress(m, brinell_strain * u),
                      spread / static_cast<double>(near.size())});
    }
  }
  return rows;
}

/// A press that ends at its depth. Calls watch(overlap) every `interval` steps of the last part of the loading.
class WatchedPress : public Press
{
 public:
  WatchedPress(const Plan& plan, std::unique_ptr<Drive> drive, std::function<void(double)> watch)
      : Press(plan, 1, std::move(drive)), depth_(plan.stops.back()), watch_(std::move(watch))
  {
  }
  void apply(Scene& scene, double time, double dt, bool touching) override
  {
    Press::apply(scene, time, dt, touching);
    constexpr int interval = 8;
    if (overlap(scene) > last_part * depth_ && ++steps_ % interval == 0) watch_(overlap(scene));
  }
  bool finished() const override { return Press::finished() || progress() > 1 - 1e-9 || branch() != Branch::load; }

  static constexpr double last_part = 0.7;

 private:
  double depth_;
  std::function<void(double)> watch_;
  int steps_ = 0;
};

/// A quarter of a cube of half width and height 10, pressed by one face of a pyramid. Its edges lie in the
/// planes of symmetry, so that the quarter meets one plane. Half the diagonal is about 1.
class Pyramid
{
 public:
  explicit Pyramid(const Case& c) : case_(c), edge_(block / c.cells) {}

  /// By self-similarity force and corner of all depths are one number each; in the mean over many depths the edge of
  /// the contact has passed several markers.
  Row press()
  {
    const double ramp = ramp_of(case_, depth, 1e-2);
    Simulation run(scene(), RunOptions{}, ramp, 1);
    std::vector<std::pair<double, double>> side;
    double force = 0, samples = 0;
    WatchedPress programme({{depth}, ramp, 0.4 * ramp}, std::make_unique<MovingPlanes>(std::vector<double>{std::sin(angle), 0.0}),
                           [&](double overlap) {
                             for (int row = 0; row < 4; ++row) {
                               const auto [end, beside] = end_of_row(run.scene, row);
                               side.emplace_back(beside / overlap, end / overlap);
                             }
                           });
    run.run(programme, {{}, Scales{}, ramp}, {});
    for (std::size_t k = 0; k < run.result.trace.size(); ++k)
      if (const double d = run.result.trace[k].delta; d > WatchedPress::last_part * depth)
        force += std::abs(run.result.planes[0].samples[k].vector[2]) / (d * d), samples += 1;
    // the corner, where a microscope reads it: the side beside it, extended straight
    const double corner = line_through(side).first;
    return {68, case_.stiffness * force / samples / (2 * corner * corner), corner * ridge};
  }

 private:
  static constexpr double depth = 0.28, extent = 10, block = 1.25;
  static constexpr double angle = 68 * M_PI / 180;                // between axis and face
  const double ridge = 1 / (std::tan(angle) * std::sqrt(2.0));    // slope of an edge

  Scene scene() const
  {
    const auto depth_of = [](const Vector3& x) {
      return std::min({extent - x[0], extent - x[1], x[2], extent - x[2]});
    };
    SpatialSection section;
    section.phases = {phase_of(half_space(case_), Scales{})};
    section.depth = depth_of;
    section.normal = [=](const Vector3& x) {
      constexpr double hair = 1e-6;
      Vector3 gradient;
      for (int d = 0; d < 3; ++d) gradient[d] = depth_of(x) - depth_of(x + hair * Vector3::Unit(d));
      return gradient.normalized();
    };
    section.mirrored = {true, true, false};
    section.mass = extent * extent * extent;
    for (int d = 0; d < 3; ++d)
      section.lines[d] = graded_axis(0, extent, {{0, d < 2 ? block : 0.7 * block, edge_, 3.0 / case_.cells}},
                                     1.5 * extent / case_.cells, 0.25, section.mirrored[d]);
    Scene scene;
    scene.bodies.push_back(spatial_body(section));
    scene.bodies.front().use_single();
    const double across = std::cos(angle) / std::sqrt(2.0);
    Plane face{Vector3(across, across, std::sin(angle)), 0};
    face.friction = case_.friction;
    Plane bottom{-Vector3::UnitZ(), -extent};
    face.copies = bottom.copies = 4;
    scene.centre = 0.5 * extent * Vector3::UnitZ();
    scene.meet(std::make_unique<Planes>(scene.bodies.front(), scene.centre, std::vector<Plane>{face, bottom}));
    return scene;
  }

  /// Place x, y where the contact of a row of markers along the pyramid's edge ends. A row is half a cell wide.
  std::pair<double, double> end_of_row(const Scene& scene, int number) const
  {
    const Body& body = scene.bodies.front();
    const Markers& surface = body.reference().surface;
    const Plane& face = scene.planes->planes()[0];
    struct Place
    {
      double x, y, gap;
    };
    std::vector<Place> row;
    for (int m = 0; m < surface.count; ++m) {
      const auto& start = surface.place[m];
      if (start[2] > 0.5 * edge_ || start[0] > 2 || static_cast<int>(2 * start[1] / edge_) != number) continue;
      const Vector3 now = Vector3(start[0], start[1], start[2]) + carried(body.u_i, surface, m);
      row.push_back({now[0], now[1], face.normal.dot(now) - face.position});
    }
    std::sort(row.begin(), row.end(), [](const Place& a, const Place& b) { return a.x < b.x; });
    std::size_t last = 0;
    for (std::size_t k = 0; k + 2 < row.size(); ++k)
      if (row[k].gap < 0.002 * edge_) last = k;
    // beyond the edge of a pyramid the gap opens at an angle: the place where the line through the next two vanishes
    const Place first = row[last + 1], second = row[last + 2];
    const double away = first.gap * (second.x - first.x) / (second.gap - first.gap);
    return {std::max(row[last].x, first.x - away), row[last].y};
  }

  Case case_;
  double edge_;
};

std::vector<Case> cases()
{
  std::vector<Case> all;
  for (const double nu : {0.3, 0.4, 0.45}) all.push_back({.indenter = "cone", .nu = nu});
  for (const double angle : {75.0, 80.0, 84.0}) all.push_back({.indenter = "cone", .angle = angle});
  constexpr double friction = 0.15;  // of diamond on metals (Tabor 1951: 0.1 to 0.15)
  const auto add = [&](double n, std::initializer_list<double> stiffnesses) {
    for (const double k : stiffnesses) all.push_back({"pyramid", k, n, friction});
  };
  add(0.1, {15, 25, 45, 80, 150, 300, 700, 2000});
  add(0.25, {25, 80, 300, 2000});
  add(0.5, {15, 45, 150, 700, 2000});
  for (const double k : {25.0, 150.0, 700.0}) all.push_back({"pyramid", k, 0.1, 0});
  all.push_back({"pyramid", 150, 0.1, 0.3});
  for (const double nu : {0.15, 0.45}) all.push_back({"pyramid", 150, 0.1, friction, nu});
  all.push_back({.indenter = "pyramid", .stiffness = 150, .exponent = 0.1, .friction = friction, .cells = 18});
  for (const double n : {0.1, 0.25, 0.5})
    for (const double k : {25.0, 60.0, 150.0, 400.0, 1500.0})
      all.push_back({.indenter = "ball", .stiffness = k, .exponent = n, .cells = 20});
  return all;
}

}  // namespace

int main(int argc, char** argv)
{
  CLI::App app("Indentations for the table of hardness over flow stress");
  std::string file;
  app.add_option("file", file)->required();
  CLI11_PARSE(app, argc, argv);
  std::ofstream out(file);
  out << "indenter,stiffness,exponent,friction,poisson_ratio,angle,cells,place,pressure,spread\n";
  for (const Case& c : cases()) try {
      const std::vector<Row> rows = c.indenter == "cone" ? cone(c) : c.indenter == "ball" ? ball(c) : std::vector<Row>{Pyramid(c).press()};
      for (const Row& r : rows)
        out << fmt::format("{},{:g},{:g},{:g},{:g},{:g},{},{:g},{:.4f},{:.4f}\n", c.indenter, c.stiffness, c.exponent,
                           c.friction, c.nu, c.angle, c.cells, r.place, r.pressure, r.spread)
            << std::flush;
    } catch (const Error& e) {
      fmt::print(stderr, "{} {} {}: {}\n", c.indenter, c.stiffness, c.exponent, e.what());
      return 1;
    }
  return 0;
}
