#include "solver/run/spatial_setup.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "solver/contact/plane_pull.hpp"
#include "solver/contact/touching.hpp"
#include "solver/grid/spatial_grid.hpp"
#include "solver/material/law_table.hpp"
#include "solver/run/axisymmetric_setup.hpp"
#include "solver/run/estimates.hpp"
#include "solver/shape/rotation.hpp"

namespace granulaw {

namespace {

constexpr double same = 1e-9;  ///< directions closer than this are one
/// Radii of curvature between these count for the size of a contact, in R.
constexpr double sharpest = 1e-3, flattest = 5;
/// A cell at the distance d from the block, of half width b, has an edge of (b + growth d)/cells, at most
/// this fraction of the body's smallest half width over cells. So all edges shrink as one: two resolutions
/// show the error of every part.
constexpr double growth = 3, coarsest_share = 1.5;
/// Cells in a rounded edge that touches: with fewer the force creeps.
constexpr double cells_in_edge = 4;

bool equal(const Vector3& a, const Vector3& b)
{
  return (a - b).lpNorm<Eigen::Infinity>() < same;
}

/// 1/(1/a + 1/b): masses, radii and moduli of two bodies.
double in_series(double a, double b)
{
  return a * b / (a + b);
}

}  // namespace

Plane touching_plane(const Vector3& normal)
{
  return {normal, std::numeric_limits<double>::quiet_NaN()};
}

SpatialSetup::SpatialSetup(const Particle& particle, const Eigen::Matrix3d& rotation,
                           std::vector<Plane> planes, const std::array<bool, 3>& may_mirror,
                           const RunOptions& options, const Attraction& attraction)
    : SpatialSetup(particle, scales_of(particle), rotation, std::move(planes), may_mirror, options)
{
  attraction_ = attraction;
}

SpatialSetup::SpatialSetup(const Particle& particle, const Scales& scale, const Eigen::Matrix3d& rotation,
                           std::vector<Plane> planes, const std::array<bool, 3>& may_mirror,
                           const RunOptions& options)
    : Setup(scale),
      particle_(particle),
      solid_(shape_of(particle)),
      rotation_(particle.is_sphere() && particle.inclusions.empty() ? Eigen::Matrix3d::Identity() : rotation),
      planes_(std::move(planes)),
      drawn_(options.fields),
      single_(options.precision == Precision::single)
{
  for (const Material& m : particle.materials) validate(m, "particle");
  validate(particle, "particle");
  yield_ = std::numeric_limits<double>::infinity();
  for (const Material& m : particle.materials) yield_ = std::min(yield_, m.yield_stress);
  mass_ = particle.volume() * particle.materials.front().density / scale_.mass();
  for (int d = 0; d < 3; ++d) {
    const Vector3 axis = Vector3::Unit(d), own = rotation_.transpose() * axis;
    high_[d] = solid_->support(own, nullptr) / scale_.length;
    low_[d] = -solid_->support(-own, nullptr) / scale_.length;
  }
  for (Plane& plane : planes_)
    if (std::isnan(plane.position)) {
      plane.position = -solid_->support(rotation_.transpose() * -plane.normal, nullptr) / scale_.length;
      plane.start = plane.position;
    }
  find_mirrors(may_mirror);
  drop_mirrored_planes();
  for (const Plane& plane : planes_) touches_.push_back(touch_of(plane));
}

void SpatialSetup::find_mirrors(const std::array<bool, 3>& may_mirror)
{
  const std::array<bool, 3> own = solid_->symmetric();
  for (int d = 0; d < 3; ++d) {
    if (!may_mirror[d]) continue;
    bool symmetric = false;
    const Vector3 axis = rotation_.transpose() * Vector3::Unit(d);
    for (int e = 0; e < 3; ++e) symmetric = symmetric || (own[e] && std::abs(std::abs(axis[e]) - 1) < same);
    for (const Particle::Inclusion& i : particle_.inclusions)
      symmetric = symmetric && std::abs(axis.dot(Vector3(i.x, i.y, i.z))) < same * particle_.radius &&
                  particle_.shape != nullptr;
    for (const Plane& plane : planes_) {
      Vector3 image = plane.normal;
      image[d] = -image[d];
      symmetric = symmetric && std::any_of(planes_.begin(), planes_.end(), [&](const Plane& other) {
                    return equal(other.normal, image) && std::abs(other.position - plane.position) < same &&
                           other.velocity == plane.velocity && other.friction == plane.friction;
                  });
    }
    mirrored_[d] = symmetric;
  }
}

/// Planes that meet the computed upper part of mirrored bodies stay; the others are dropped.
void SpatialSetup::drop_mirrored_planes()
{
  given_ = planes_;
  std::vector<Plane> kept;
  std::vector<Vector3> normals;
  for (const Plane& plane : given_) {
    Vector3 met = plane.normal;  // of its image at the part that is computed
    int copies = 1;
    for (int d = 0; d < 3; ++d)
      if (mirrored_[d]) {
        if (std::abs(met[d]) < same) copies *= 2;
        met[d] = -std::abs(met[d]);
      }
    const auto found =
        std::find_if(normals.begin(), normals.end(), [&](const Vector3& n) { return equal(n, met); });
    computed_.push_back(static_cast<int>(found - normals.begin()));
    if (found != normals.end()) continue;
    normals.push_back(met);
    kept.push_back(plane);
    kept.back().normal = met, kept.back().copies = copies;
  }
  planes_ = kept;
}

std::optional<Eigen::Matrix3d> SpatialSetup::exact_inertia() const
{
  if (!particle_.layers.empty() || !particle_.inclusions.empty()) return {};
  const double density = particle_.materials.front().density / scale_.density;
  return density * rotation_ * solid_->mass_properties().inertia * rotation_.transpose() /
         std::pow(scale_.length, 5);
}

/// 8, as a certificate over orientations (characterise/shape/shape_certificate.cpp).
int SpatialSetup::cells(const RunOptions& options, double) const
{
  return cells_of(options, 8, 100, " in three dimensions");
}

std::unique_ptr<Drive> SpatialSetup::drive() const
{
  std::vector<double> speeds;
  for (const Plane& plane : planes_) speeds.push_back(plane.velocity);
  return std::make_unique<MovingPlanes>(speeds);
}

void SpatialSetup::give_planes(std::vector<PlaneTrace>& planes) const
{
  std::vector<PlaneTrace> all;
  for (std::size_t k = 0; k < given_.size(); ++k) {
    PlaneTrace trace = planes[computed_[k]];
    for (int d = 0; d < 3; ++d) {
      if (given_[k].normal[d] * trace.normal[d] >= 0) continue;
      for (PlaneSample& s : trace.samples) {
        s.vector[d] = -s.vector[d], s.centre[d] = -s.centre[d];
        for (int e = 0; e < 3; ++e)
          if (e != d) s.torque[e] = -s.torque[e];
      }
    }
    trace.normal = {given_[k].normal[0], given_[k].normal[1], given_[k].normal[2]};
    all.push_back(std::move(trace));
  }
  planes = std::move(all);
}

SpatialSetup::Touch SpatialSetup::touch_of(const Plane& plane) const
{
  const Vector3 own = rotation_.transpose() * -plane.normal;
  Touch touch;
  solid_->support(own, &touch.place);
  const PrincipalRadii radii = solid_->principal_radii(own);
  touch.place = rotation_ * touch.place / scale_.length;
  touch.sharper_direction = (rotation_ * radii.sharper_direction).normalized();
  touch.flatter_direction = plane.normal.cross(touch.sharper_direction).normalized();
  const double finest = std::isfinite(solid_->finest_radius()) ? solid_->finest_radius() / scale_.length : 0;
  touch.sharper = std::clamp(std::max(finest, radii.sharper / scale_.length), sharpest, flattest);
  touch.flatter = std::clamp(std::max(finest, radii.flatter / scale_.length), sharpest, flattest);
  return touch;
}

double SpatialSetup::plastic_overlap_of(double mass, double v) const
{
  const double radius = std::sqrt(touches_.front().sharper * touches_.front().flatter);
  double deepest = 0;
  for (const Material& m : particle_.materials) {
    if (!m.yields()) continue;
    const double rate = v * scale_.velocity() / scale_.length;
    const double yield = m.yield_stress / scale_.stress * rate_factor(m, rate);
    deepest = std::max(deepest, plastic_overlap(mass, radius, yield, v));
  }
  return deepest;
}

double SpatialSetup::expected_overlap(double v) const
{
  const double radius = std::sqrt(touches_.front().sharper * touches_.front().flatter);
  const double mass = partner_ ? in_series(mass_, partner_->mass_) : mass_;
  const double drawn_in = drawn_in_overlap(attraction_.work / (scale_.stress * scale_.length), e_star_, radius);
  double deepest = std::max({hertz_overlap(mass, e_star_, radius, v), plastic_overlap_of(mass, v), drawn_in});
  if (partner_) deepest = std::max(deepest, partner_->plastic_overlap_of(mass, v));
  return std::min(deepest_overlap, deepest);
}

void SpatialSetup::meet(const Particle& other, const RunOptions& options)
{
  for (const Particle* p : {&std::as_const(particle_), &other})
    if (!p->is_sphere() || !p->inclusions.empty())
      fail("partner", "two bodies in three dimensions are spheres without inclusions");
  if (drawn_) fail("--fields", "shows one body in three dimensions");
  partner_.reset(new SpatialSetup(other, scale_, Eigen::Matrix3d::Identity(),
                                  {touching_plane(Vector3::UnitZ())}, mirrored_, options));
  Touch &own = touches_.front(), &others = partner_->touches_.front();
  for (double Touch::*radius : {&Touch::sharper, &Touch::flatter})
    own.*radius = others.*radius = in_series(own.*radius, others.*radius);
  e_star_ = partner_->e_star_ = in_series(1, other.materials.front().e_star() / scale_.stress);
  yield_ = partner_->yield_ = std::min(yield_, partner_->yield_);
}

/// Half widths of the fine block across and along the sharper direction: as Collision::block_for, with the
/// principal radii.
std::array<double, 2> SpatialSetup::block_of(const Touch& touch, double deepest) const
{
  const double radius = std::sqrt(touch.sharper * touch.flatter);
  const double onset =
      std::isfinite(yield_)
          ? radius * onset_overlap(e_star_ * scale_.stress, yield_, particle_.materials.front().poisson_ratio)
          : yield_;
  const double gap = gap_at_edge(deepest, onset), widest = widest_block * (high_ - low_).maxCoeff() / 2;
  const auto half_width = [&](double r) {
    return std::clamp(block_over_contact * std::sqrt(2 * gap * r), 1e-4,
                      std::min(widest, widest_block * std::max(1.0, r)));
  };
  return {half_width(touch.sharper), half_width(touch.flatter)};
}

/// `cells` to each half width of the block, across and along: in the metric in which the block is a circle a
/// cell's edge has the length 1/cells.
Vector3 SpatialSetup::edges_of(const Touch& touch, const Vector3& normal, double deepest, int cells) const
{
  const std::array<double, 2> block = block_of(touch, deepest);
  const auto edge = [&](double half_width, double radius) {
    return std::min(half_width / cells, std::max(radius / cells_in_edge, 0.1 * half_width / cells));
  };
  const double across = edge(block[0], touch.sharper), along = edge(block[1], touch.flatter);
  const Vector3 metric = (touch.sharper_direction.cwiseAbs2() + normal.cwiseAbs2()) / (across * across) +
                         touch.flatter_direction.cwiseAbs2() / (along * along);
  return metric.cwiseSqrt().cwiseInverse();
}

SpatialSection SpatialSetup::section(double deepest, int cells, double shift) const
{
  SpatialSection s;
  for (const Material& m : particle_.materials) s.phases.push_back(phase_of(m, scale_));
  const double length = scale_.length;
  s.depth = [this, length](const Vector3& x) { return solid_->depth(to_body(x)) / length; };
  s.normal = [this](const Vector3& x) { return Vector3(rotation_ * solid_->outward_normal(to_body(x))); };
  const Particle& p = particle_;
  if (!p.layers.empty() || !p.inclusions.empty()) {
    s.phase_at = [this](const Vector3& x) {
      const Vector3 own = to_body(x);
      return particle_.material_at(own, std::max(0.0, solid_->depth(own)));
    };
    s.interface_distance = [this, length](const Vector3& x) {
      const Vector3 own = to_body(x);
      const double depth = solid_->depth(own);
      double least = std::numeric_limits<double>::infinity(), at = 0;
      for (const Particle::Layer& layer : particle_.layers) {
        at += layer.thickness;
        least = std::min(least, std::abs(depth - at));
      }
      for (const Particle::Inclusion& i : particle_.inclusions)
        least = std::min(least, std::abs((own - Vector3(i.x, i.y, i.z)).norm() - i.radius));
      return least / length;
    };
  }
  s.mirrored = mirrored_, s.drawn = drawn_;
  int copies = 1;
  for (int d = 0; d < 3; ++d) copies *= mirrored_[d] ? 2 : 1;
  if (!s.phase_at) s.mass = mass_ / copies;
  for (int d = 0; d < 3; ++d) {
    std::vector<FineZone> zones;
    double finest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < touches_.size(); ++k) {
      const Touch& t = touches_[k];
      const std::array<double, 2> block = block_of(t, deepest);
      const double depth = 0.8 * block[1] * planes_[k].normal[d];  // into the body
      const double reach =
          std::abs(t.sharper_direction[d]) * block[0] + std::abs(t.flatter_direction[d]) * block[1];
      const double edge = edges_of(t, planes_[k].normal, deepest, cells)[d];
      finest = std::min(finest, edge);
      zones.push_back({t.place[d] - reach + std::min(0.0, depth), t.place[d] + reach + std::max(0.0, depth),
                       edge, growth / cells});
    }
    const double low = mirrored_[d] ? 0.0 : low_[d];
    const double coarsest = coarsest_share / cells * std::min(1.0, (high_ - low_).minCoeff() / 2);
    s.lines[d] = graded_axis(low, high_[d], zones, std::max(coarsest, finest), shift, mirrored_[d]);
  }
  return s;
}

Body SpatialSetup::body(double deepest, int cells, double shift) const
{
  Body body = spatial_body(section(deepest, cells, shift));
  if (single_) body.use_single();
  return body;
}

std::unique_ptr<Pull> SpatialSetup::pull_of(Planes& planes, const Body& body, double deepest, int cells) const
{
  if (attraction_.work <= 0) return nullptr;
  double widest = 0;
  for (const Touch& touch : touches_) widest = std::max(widest, block_of(touch, deepest)[1]);
  std::vector<Vector3> patches;
  const Markers& surface = body.reference().surface;
  for (int m = 0; m < surface.count; ++m) {
    const auto& x = surface.place[m];
    patches.push_back(surface.area[m] * (rotation_ * solid_->outward_normal(to_body({x[0], x[1], x[2]}))));
  }
  return std::make_unique<PlanePull>(planes, body, in_run_units(attraction_, widest / cells), std::move(patches));
}

Scene SpatialSetup::build(double deepest, int cells, double shift) const
{
  Scene scene;
  scene.bodies.push_back(body(deepest, cells, shift));
  const Body& body = scene.bodies.front();
  scene.outward = planes_.front().normal;
  for (int i = 0; i < body.nodes(); ++i)
    scene.centre += body.reference().mass_i[i] / body.mass() * reference_place(body, i);
  for (int d = 0; d < 3; ++d)
    if (mirrored_[d]) scene.centre[d] = 0;
  if (partner_) {
    scene.bodies.push_back(partner_->body(deepest, cells, shift));
    const double apart = -(planes_.front().position + partner_->planes_.front().position);
    const std::array<double, 2> radii{particle_.radius / scale_.length,
                                      partner_->particle_.radius / scale_.length};
    scene.meet(std::make_unique<TwoSpheres>(scene.bodies, radii, apart, planes_.front().friction));
    return scene;
  }
  std::vector<Plane> at_rest = planes_;
  for (Plane& plane : at_rest) plane.velocity = 0;
  auto side = std::make_unique<Planes>(body, scene.centre, at_rest);
  std::unique_ptr<Pull> pull = pull_of(*side, body, deepest, cells);
  scene.meet(std::move(side), std::move(pull));
  return scene;
}

}  // namespace granulaw
