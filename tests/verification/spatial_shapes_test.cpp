// Three-dimensional runs of bodies that are no spheres: closed forms, and bodies that must agree.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "base/larger.hpp"
#include "solver/runs.hpp"
#include "solver/shape/rotation.hpp"
#include "solver/shape/shapes.hpp"

namespace granulaw::spatial_shapes_test {

// E* = 1 GPa, rho = 1000 kg/m^3, nu = 0.3, about 1 mm.

constexpr double mm = 1e-3, e_star = 1e9, density = 1000;

Material material(double stiffness)
{
  Material m;
  m.density = density, m.poisson_ratio = 0.3, m.youngs_modulus = 0.91 * e_star;
  if (stiffness > 0) m.yield_stress = e_star / stiffness;
  return m;
}

Particle particle(SharedShape solid, double stiffness)
{
  Particle p;
  p.materials = {material(stiffness)};
  p.radius = std::cbrt(0.75 / M_PI * solid->mass_properties().volume);
  p.shape = std::move(solid);
  return p;
}

Particle sphere(double stiffness)
{
  return Particle::sphere(mm, material(stiffness));
}

double customary_velocity(double stiffness)
{
  return yield_velocity(e_star, e_star / stiffness, density);
}

/// On the grid of three dimensions, whatever the scene would need.
RunOptions in_space(RunOptions options)
{
  options.grid = GridKind::spatial;
  return options;
}

RunOptions coarse(int cells, int grids = 1)
{
  RunOptions options;
  options.resolution = cells, options.shifted_grids = grids;
  return options;
}

RunResult thrown(const Particle& p, double velocity, const std::array<double, 3>& direction,
                 const RunOptions& options)
{
  Approach t{velocity};
  t.orientation = direction;
  return impact(p, t, {}, in_space(options));
}

/// Hertz's contact over an ellipse on a rigid wall (Johnson 1985, eqs 4.24 to 4.28). With R_e = sqrt(R' R''):
///     sqrt(a b) = (3 P R_e/(4 E*))^(1/3) F1(e)        delta = (9 P^2/(16 E*^2 R_e))^(1/3) F2(e)
class EllipticContact
{
 public:
  EllipticContact(const PrincipalRadii& radii, double modulus) : radius_(std::sqrt(radii.flatter * radii.sharper)), e_star_(modulus)
  {
    double low = 1e-7, high = 1;  // of b/a: eq. 4.28, whose right side falls as b/a rises
    for (int step = 0; step < 60; ++step) {
      ratio_ = std::sqrt(low * high);
      (flat() / sharp() > radii.flatter / radii.sharper ? low : high) = ratio_;
    }
    widening_ = std::cbrt(4 / (M_PI * (1 - ratio_ * ratio_)) * std::pow(ratio_, 1.5) * std::sqrt(flat() * sharp()));
    approach_ = 2 / M_PI * std::sqrt(ratio_) * k() / widening_;
  }
  double force(double overlap) const { return 4.0 / 3.0 * e_star_ * std::sqrt(radius_) * std::pow(overlap / approach_, 1.5); }
  double semi_major(double force) const { return widening_ * std::cbrt(3 * force * radius_ / (4 * e_star_)) / std::sqrt(ratio_); }
  double semi_minor(double force) const { return semi_major(force) * ratio_; }

 private:
  double k() const { return std::comp_ellint_1(std::sqrt(1 - ratio_ * ratio_)); }
  double e() const { return std::comp_ellint_2(std::sqrt(1 - ratio_ * ratio_)); }
  double flat() const { return e() / (ratio_ * ratio_) - k(); }
  double sharp() const { return k() - e(); }
  double radius_, e_star_, ratio_ = 1, widening_ = 1, approach_ = 1;
};

/// Timoshenko and Goodier, Theory of Elasticity, section 140: a = m h, b = n h with h = (3 P/(4 E* (A + B)))^(1/3), over theta,
/// cos(theta) = (B - A)/(A + B). Printed to three digits.
TEST(EllipticContact, TabulatedAxes)
{
  const double table[][3] = {{30, 2.731, 0.493}, {45, 1.926, 0.604}, {60, 1.486, 0.717}, {75, 1.202, 0.846}};
  for (const auto& [theta, m, n] : table) {
    const double cosine = std::cos(theta * M_PI / 180);                                   // A + B = 1
    const EllipticContact contact({1 / (1 + cosine), 1 / (1 - cosine), {}}, 0.75);  // h = 1 at P = 1
    EXPECT_NEAR(contact.semi_major(1), m, 2e-3);
    EXPECT_NEAR(contact.semi_minor(1), n, 2e-3);
    // the approach of one contact with its pressures, eq. 4.27: delta = 3 P K/(2 pi a E*)
    const double q = contact.semi_minor(1) / contact.semi_major(1), delta = 1.5 * std::comp_ellint_1(std::sqrt(1 - q * q)) / (M_PI * contact.semi_major(1) * 0.75);
    EXPECT_NEAR(contact.force(delta), 1, 1e-9);
  }
}

/// Largest force of a frictionless elastic impact by Hertz (Johnson 1985, eq. 11.25), and the ellipse then.
/// Off the axis the contact moves the mass 1/(1/m + (r x n)^2/I).
struct HertzImpact
{
  double force, major, minor;

  HertzImpact(const Particle& p, const Vector3& direction, double velocity)
  {
    const SharedShape solid = shape_of(p);
    const MassProperties m = solid->mass_properties();
    Vector3 place;
    const Vector3 n = direction.normalized();
    solid->support(n, &place);
    const Vector3 lever = (place - m.centre).cross(n);
    const double mass =
        density / (1 / m.volume + lever.dot(m.inertia.ldlt().solve(lever)));  // of density 1 kg/m^3
    const PrincipalRadii radii = solid->principal_radii(n);
    const EllipticContact contact(radii, e_star);
    const double stiffness = contact.force(1e-6) / 1e-9;  // F = k delta^1.5
    force = std::pow(stiffness, 0.4) * std::pow(1.25 * mass * velocity * velocity, 0.6);
    major = contact.semi_major(force), minor = contact.semi_minor(force);
  }
};

/// Half axes of the contact over those of Hertz's ellipse of the same force: mean over the samples near the
/// largest force.
std::array<double, 2> axes_over_hertz(const RunResult& r, const Particle& p, const Vector3& direction)
{
  const PrincipalRadii radii = shape_of(p)->principal_radii(direction.normalized());
  const EllipticContact contact(radii, e_star);
  std::array<double, 2> sum{};
  int count = 0;
  for (const PlaneSample& s : r.planes.front().samples)
    if (s.force > 0.8 * r.summary.force_max) {
      sum[0] += s.axes[0] / contact.semi_major(s.force), sum[1] += s.axes[1] / contact.semi_minor(s.force);
      ++count;
    }
  return {sum[0] / count, sum[1] / count};
}

/// Elastic ellipsoid flat-on and at 45 degrees against Hertz's elliptic contact (Johnson 1985, eqs 4.24 to
/// 4.28). Waves, the finite body and the grid make the sphere's force and contact differ from Hertz's too:
/// over what they do to the sphere, force and contact radius are within 1 %. A single axis also has the
/// scatter of two grids with seven cells to the contact radius: the sphere's two differ by 0.8 %.
TEST(SpatialShapesSlow, ElasticEllipsoidFollowsHertz)
{
  const double velocity = 0.0004 * std::sqrt(e_star / density);
  const Particle ball = sphere(0);
  const Particle egg = particle(ellipsoid_shape(Vector3(1.25, 1, 0.8) * mm), 0);
  const RunOptions options = coarse(8, 2);
  const RunResult round = thrown(ball, velocity, {0, 0, 1}, options);
  const double force = round.summary.force_max / HertzImpact(ball, {0, 0, 1}, velocity).force;
  const std::array<double, 2> axes = axes_over_hertz(round, ball, {0, 0, 1});
  EXPECT_NEAR(force, 1, 0.03);
  for (const Vector3& direction : {Vector3(0, 0, 1), Vector3(1, 0, 1)}) {
    const RunResult r = thrown(egg, velocity, {direction[0], direction[1], direction[2]}, options);
    const std::array<double, 2> found = axes_over_hertz(r, egg, direction);
    EXPECT_NEAR(r.summary.force_max / HertzImpact(egg, direction, velocity).force / force, 1, 0.01);
    const double mean = 0.5 * (axes[0] + axes[1]);
    EXPECT_NEAR(std::sqrt(found[0] * found[1]) / mean, 1, 0.01);
    for (const double axis : found) EXPECT_NEAR(axis / mean, 1, 0.015);
  }
}

/// With exponents 2 a superquadric is the ellipsoid: the same surface, found by another way to 1e-9.
TEST(SpatialShapes, SuperquadricOfExponentsTwoIsTheEllipsoid)
{
  const Vector3 axes = Vector3(0.8, 1, 1.3) * mm;
  const double v = 100 * customary_velocity(100);
  const RunSummary a = thrown(particle(ellipsoid_shape(axes), 100), v, {1, 0, 0}, coarse(6)).summary;
  const RunSummary b = thrown(particle(superquadric_shape(axes, 2, 2), 100), v, {1, 0, 0}, coarse(6)).summary;
  EXPECT_NEAR(b.restitution / a.restitution, 1, 1e-4);
  EXPECT_NEAR(b.force_max / a.force_max, 1, 1e-4);
}

/// A ball by triangles: an octahedron whose triangles are halved along each edge `times` times.
TriangleMesh ball_mesh(double radius, int times)
{
  TriangleMesh mesh;
  for (int d = 0; d < 3; ++d)
    for (const double side : {radius, -radius}) mesh.vertices.push_back(side * Vector3::Unit(d));
  for (int k = 0; k < 8; ++k) {
    const int x = k & 1 ? 1 : 0, y = k & 2 ? 3 : 2, z = k & 4 ? 5 : 4;
    const bool even =
        (k & 1) + (k >> 1 & 1) + (k >> 2 & 1) == 0 || (k & 1) + (k >> 1 & 1) + (k >> 2 & 1) == 2;
    mesh.triangles.push_back(even ? std::array<int, 3>{x, y, z} : std::array<int, 3>{x, z, y});
  }
  for (int n = 0; n < times; ++n) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [at, fresh] = middles.try_emplace({std::min(a, b), std::max(a, b)}, 0);
      if (fresh) {
        at->second = static_cast<int>(mesh.vertices.size());
        mesh.vertices.push_back(radius * (mesh.vertices[a] + mesh.vertices[b]).normalized());
      }
      return at->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = finer;
  }
  return mesh;
}

/// A clump of one ball is the sphere: the same surface, but a scale of its own (the radius of its volume), so
/// that rounding grows through the impact. The mesh of 32768 triangles has edges of 0.025 R, so it lies
/// within 1e-4 R of the sphere: 0.3 % of the overlap of 0.03 R. It has no mirror planes, so that its grid is
/// the whole one, which moves e by what a single grid of six cells scatters: 1 %.
TEST(SpatialShapesSlow, ClumpOfOneBallAndMeshedBallAreTheSphere)
{
  const double v = 100 * customary_velocity(100);
  const RunSummary ball = thrown(sphere(100), v, {0, 0, -1}, coarse(6)).summary;
  const std::vector<ClumpBall> one{{Vector3::Zero(), mm}};
  const RunSummary clump = thrown(particle(clump_shape(one, "test"), 100), v, {0, 0, -1}, coarse(6)).summary;
  EXPECT_NEAR(clump.restitution / ball.restitution, 1, 1e-4);
  EXPECT_NEAR(clump.force_max / ball.force_max, 1, 1e-4);
  const Particle meshed = particle(mesh_shape(ball_mesh(mm, 6), "test"), 100);
  const RunSummary mesh = thrown(meshed, v, {0, 0, -1}, coarse(6)).summary;
  EXPECT_NEAR(mesh.restitution / ball.restitution, 1, 0.01);
  EXPECT_NEAR(mesh.force_max / ball.force_max, 1, 0.01);
  EXPECT_NEAR(mesh.delta_max / ball.delta_max, 1, 0.006);  // the mesh, and the start of the contact on it
}

/// Ellipsoid of aspect 1.5 end-on at V = 100 V_y against the axisymmetric solver.
TEST(SpatialShapesSlow, EllipsoidEndOnAgreesWithTheAxisymmetricSolver)
{
  const double v = 100 * customary_velocity(100);
  Particle revolved = sphere(100);
  revolved.profile = Profile(ellipsoid(mm, 1.5));
  RunOptions fine = coarse(32, 4);
  const RunSummary flat = impact(revolved, {v}, {}, fine).summary;
  const Particle egg = particle(ellipsoid_shape(Vector3(1, 1, 1.5) * mm), 100);
  const RunSummary found = thrown(egg, v, {0, 0, -1}, coarse(10, 4)).summary;
  printf("end-on 2d e %.5f F %.5g d %.5g; 3d e %+.4f F %+.4f d %+.4f cpu %.1f\n", flat.restitution,
         flat.force_max / (e_star * mm * mm), flat.delta_max / mm, found.restitution / flat.restitution - 1,
         found.force_max / flat.force_max - 1, found.delta_max / flat.delta_max - 1, found.cpu_s);
  EXPECT_NEAR(found.restitution / flat.restitution, 1, 0.005);
  EXPECT_NEAR(found.force_max / flat.force_max, 1, 0.005);
  EXPECT_NEAR(found.delta_max / flat.delta_max, 1, 0.003);
}

/// A whole oblique impact of a body without symmetry in the plane of its motion: what the wall's force and
/// torque add up to over the trace is the change of momentum and of angular momentum; the energy closes.
TEST(SpatialShapes, ObliqueImpactKeepsMomentumAndEnergy)
{
  const Particle egg = particle(ellipsoid_shape(Vector3(1.2, 1, 0.8) * mm), 100);
  Approach t{100 * customary_velocity(100)};
  t.orientation = {0.4, 0, 1}, t.friction = 0.3, t.tangential_velocity = 0.7 * t.velocity;
  const RunResult r = impact(egg, t, {}, in_space(coarse(6)));
  Vector3 impulse = Vector3::Zero(), torque = Vector3::Zero();
  double before = 0;
  for (std::size_t k = 0; k < r.trace.size(); ++k) {
    const double end = 2 * r.trace[k].time - before, length = end - before;  // a sample's time is its middle
    const PlaneSample& s = r.planes.front().samples[k];
    for (int d = 0; d < 3; ++d) impulse[d] += length * s.vector[d], torque[d] += length * s.torque[d];
    before = end;
  }
  const MassProperties m = egg.shape->mass_properties();
  const Vector3 spin(r.rebound->spin[0], r.rebound->spin[1], r.rebound->spin[2]);
  // about y, an axis of the body: its moment of inertia changes by less than 1 % as the contact flattens
  const double angular = density * m.inertia(1, 1) * spin[1];
  EXPECT_NEAR(impulse[2] / r.rebound->impulse_normal, 1, 1e-9);
  EXPECT_NEAR(-impulse[0] / r.rebound->impulse_tangential, 1, 1e-9);
  EXPECT_NEAR(torque[1] / angular, 1, 0.01);
  EXPECT_LT(r.summary.energy_error, 1e-3);
}

/// Normal impulse up to a time: a sample is the mean over an interval that ends halfway to the next.
double impulse_until(const RunResult& r, double end)
{
  double sum = 0;
  for (std::size_t k = 1; k < r.trace.size() && r.trace[k].time < end; ++k)
    sum += 0.5 * (r.trace[k].force + r.trace[k - 1].force) * (r.trace[k].time - r.trace[k - 1].time);
  return sum;
}

/// A rod hits with its end at 60 degrees from its axis, turns over it and hits with the other end. The first
/// contact alone is the same to its end (samples begin anew at the reversal, which only one of both has: 1 %
/// of the impulse), and shorter than the whole impact.
TEST(SpatialShapes, FirstContactOnlyEndsBeforeTheBodyHitsAgain)
{
  const Particle rod = particle(ellipsoid_shape(Vector3(1, 1, 3) * mm), 100);
  Approach t{400 * customary_velocity(100)};
  t.orientation = {std::sin(M_PI / 3), 0, -std::cos(M_PI / 3)};
  const RunResult whole = impact(rod, t, {}, in_space(coarse(6)));
  t.first_contact_only = true;
  const RunResult first = impact(rod, t, {}, in_space(coarse(6)));
  EXPECT_LT(first.summary.contact_time, 0.7 * whole.summary.contact_time);
  EXPECT_LT(first.summary.steps, 0.7 * static_cast<double>(whole.summary.steps));
  const double end = first.trace.back().time;
  EXPECT_EQ(first.trace.back().force, 0);
  EXPECT_NEAR(impulse_until(first, end) / impulse_until(whole, end), 1, 0.01);
}

/// A body turned about the wall's normal stands askew to the grid.
TEST(SpatialShapesSlow, TurningTheBodyAgainstTheGridChangesLittle)
{
  const Particle egg = particle(ellipsoid_shape(Vector3(1.25, 1, 0.8) * mm), 100);
  Approach t{100 * customary_velocity(100)};
  RunOptions options = coarse(8, 4);
  options.estimate_error = true;
  const RunSummary straight = impact(egg, t, {}, in_space(options)).summary;
  options.estimate_error = false;
  for (const double degrees : {22.5, 45.0}) {
    t.turn = degrees * M_PI / 180;
    const RunSummary turned = impact(egg, t, {}, in_space(options)).summary;
    EXPECT_NEAR(turned.restitution / straight.restitution, 1, straight.error_estimate);
    EXPECT_NEAR(turned.force_max / straight.force_max, 1, straight.error_estimate);
  }
}

/// Volume of hexahedra, mm3: each the six tetrahedra about its diagonal from corner 0 to 6.
double volume_of(const std::vector<std::array<int, 8>>& cells, const FieldFrame& f)
{
  double sum = 0;
  const auto at = [&](int node) -> Eigen::Vector3d { return Eigen::Vector3d(f.r[node], f.y[node], f.z[node]) / mm; };
  for (const std::array<int, 8>& c : cells)
    for (const auto& [a, b] : std::array<std::array<int, 2>, 6>{{{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}}}) {
      const Eigen::Vector3d o = at(c[0]);
      sum += (at(c[a]) - o).dot((at(c[b]) - o).cross(at(c[6]) - o)) / 6;
    }
  return sum;
}

/// The written fields show the body, and no more than the yield stress where it flows.
TEST(SpatialFields, PerfectPlasticityStaysAtYield)
{
  double largest = 0, strain = 0, volume = 0;
  std::vector<std::array<int, 8>> drawn;
  RunOptions options = coarse(8);
  options.fields.frames = 4;
  options.fields.begin_solid = [&](int, const std::vector<std::array<int, 8>>& cells) { drawn = cells; };
  options.fields.frame = [&](const FieldFrame& f) {
    if (volume == 0) volume = volume_of(drawn, f);
    for (const double s : f.von_mises) largest = larger(largest, s);
    for (const double e : f.plastic_strain) strain = larger(strain, e);
  };
  thrown(sphere(100), 100 * customary_velocity(100), {0, 0, -1}, options);
  EXPECT_GT(strain, 0.05);
  EXPECT_NEAR(largest / (e_star / 100), 1, 1e-6);  // files hold as much; means of cells are below
  EXPECT_NEAR(volume / (M_PI / 3.0), 1, 0.01);  // a quarter, by symmetry; flat faces at the rim leave out 0.5 %
}

}  // namespace granulaw::spatial_shapes_test
