#include "solver/run/axisymmetric_setup.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "solver/contact/node_plane.hpp"
#include "solver/contact/surface_pull.hpp"
#include "solver/grid/mapped_body.hpp"
#include "solver/grid/updated_body.hpp"
#include "solver/material/law_table.hpp"
#include "solver/run/estimates.hpp"

namespace granulaw {

namespace {

/// Radius of the ball whose half represents a deformable wall, in R: its far side changes the stiffness by
/// about 2 a/(pi extent), and a wave that is thrown back there comes when most impacts are over. e and F of
/// elastic impacts differ by 1e-4 from those with 60.
constexpr double wall_extent = 30;

/// Modulus of the hourglass control: 0.05 G keeps the one-point cells in shape while elastic; where the
/// material yields it must not outlast the yield stress, else bending cells store energy that flow should
/// have taken (E*/Y = 1000, pressed to 0.1 R: force 3 % low with 0.05 G, within 0.6 % of finite elements with
/// Y).
double hourglass_modulus(const Moduli& m)
{
  return m.yields ? std::min(0.05 * m.shear, m.yield) : 0.05 * m.shear;
}

/// Volume of each material, m^3, by midpoint samples of the section: exact for homogeneous bodies.
double mass_of(const Particle& p)
{
  if (p.layers.empty() && p.inclusions.empty()) return p.volume() * p.materials.front().density;
  constexpr int n = 400;
  const double height = p.height(), dr = p.radius / n, dz = height / (2 * n);
  double mass = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      const int material = p.material_at((i + 0.5) * dr, (j + 0.5) * dz);
      if (material >= 0) mass += 2 * M_PI * (i + 0.5) * dr * dr * dz * p.materials[material].density;
    }
  return mass;
}

double smallest_yield(const std::vector<Material>& materials)
{
  double least = std::numeric_limits<double>::infinity();
  for (const Material& m : materials) least = std::min(least, m.yield_stress);
  return least;
}

/// A point outside the body is moved towards the middle of its axis until it lies on the surface; over
/// `length`.
std::pair<double, double> onto_body(const Particle& p, double r, double z, double length)
{
  const double middle = 0.5 * p.height();
  double inside = 0, outside = 1;
  if (p.depth(r, z) < 0) {
    for (int n = 0; n < 40; ++n) {
      const double t = 0.5 * (inside + outside);
      (p.depth(t * r, middle + t * (z - middle)) >= 0 ? inside : outside) = t;
    }
    r *= inside, z = middle + inside * (z - middle);
  }
  return {r / length, z / length};
}

/// Places on opposite walls of the pores, in R, which must stay apart: top and bottom, of rings also the
/// inner and the outer wall. Those that a later inclusion covers are left out.
std::vector<std::pair<double, double>> pore_walls(const Particle& p, double length)
{
  std::vector<std::pair<double, double>> walls;
  for (const Particle::Inclusion& pore : p.inclusions) {
    if (pore.material >= 0) continue;
    const auto add = [&](double dr, double dz) {
      const auto material = [&](double side) {
        return p.material_at(pore.r + side * pore.radius * dr, pore.z + side * pore.radius * dz);
      };
      constexpr double hair = 1e-6;
      for (const double side : {-1.0, 1.0})
        if (material(side * (1 - hair)) >= 0 || material(side * (1 + hair)) < 0) return;
      for (const double side : {-1.0, 1.0})
        walls.emplace_back((pore.r + side * pore.radius * dr) / length,
                           (pore.z + side * pore.radius * dz) / length);
    };
    add(0, 1);
    if (pore.r > pore.radius) add(1, 0);
  }
  return walls;
}

void check_particle(const Particle& p, const char* where)
{
  check_revolution(p, where);
  for (const Material& m : p.materials) validate(m, where);
  validate(p, where);
}

}  // namespace

Phase phase_of(const Material& m, const Scales& scale)
{
  const flow::Flow laws = flow_of(m, scale.stress, scale.time());
  const double e = m.youngs_modulus / scale.stress, nu = m.poisson_ratio;
  return {{e / (2 * (1 + nu)), e / (3 * (1 - 2 * nu)), m.yields() ? m.yield_stress / scale.stress : 0,
           laws.hardening == 0 ? laws.hardening_values[0] : 0, m.yields(), laws},
          m.density / scale.density};
}

const char* name_of(GridKind grid)
{
  constexpr const char* names[] = {"auto", "mapped", "rectilinear", "updated", "rectilinear-3d"};
  return names[static_cast<int>(grid)];
}

GridChoice choose_grid(const Particle& p)
{
  if (p.shape) return {GridKind::spatial, "a body of any shape: three dimensions"};
  if (p.is_homogeneous_sphere())
    return {GridKind::mapped, "a homogeneous sphere: the grid fitted to it is fastest and most exact"};
  if (!p.layers.empty() || !p.inclusions.empty())
    return {GridKind::rectilinear, "layers or inclusions: cells are cut where the material changes"};
  return {GridKind::rectilinear, "not a sphere: cells are cut by the surface"};
}

Scales scales_of(const Particle& p)
{
  return {p.radius, p.materials.front().e_star(), p.materials.front().density};
}

Collision::Collision(const Particle& particle, const Partner& partner, const RunOptions& options,
                     Support support)
    : Setup(scales_of(particle)), particle_(particle), partner_(partner), options_(options), support_(support)
{
  check_bodies();
  check_grid();
  double compliance = 1, inverse_mass = scale_.mass() / mass_of(particle), inverse_radius = 0;
  const auto pole = [&](const Particle& p) {
    return std::min(5.0, p.pole_curvature_radius() / scale_.length);
  };
  inverse_radius = 1 / std::max(1e-3, pole(particle));
  yield_ = smallest_yield(particle.materials);
  if (partner.particle) {
    const Particle& other = *partner.particle;
    compliance += scale_.stress / other.materials.front().e_star();
    inverse_mass += scale_.mass() / mass_of(other);
    inverse_radius += 1 / std::max(1e-3, pole(other));
    yield_ = std::min(yield_, smallest_yield(other.materials));
  } else if (partner.wall) {
    compliance += scale_.stress / partner.wall->e_star();
    yield_ = std::min(yield_, partner.wall->yield_stress);
  }
  e_star_ = 1 / compliance;
  reduced_mass_ = 1 / inverse_mass;
  length_ = 1 / inverse_radius;
}

void Collision::check_bodies() const
{
  check_particle(particle_, "particle");
  if (partner_.particle) check_particle(*partner_.particle, "partner");
  if (partner_.wall) validate(*partner_.wall, "wall");
}

void Collision::check_grid() const
{
  const bool two = partner_.particle || partner_.wall;
  if (partner_.attraction.work > 0 && options_.grid == GridKind::updated)
    fail("--work-of-adhesion", "is computed on reference grids only", name_of(options_.grid), "mapped, rectilinear");
  if (options_.grid == GridKind::spatial)
    fail("--grid", "is one of three dimensions", name_of(options_.grid), "mapped, rectilinear, updated");
  if (options_.grid == GridKind::mapped)
    for (const Particle* p : {&particle_, partner_.particle ? &*partner_.particle : nullptr})
      if (p && !p->is_homogeneous_sphere())
        fail("--grid", "'mapped' is fitted to homogeneous spheres, and this particle is none", "mapped",
             "rectilinear, updated");
  if (two && support_ == Support::midplane)
    fail("--support", "the midplane is driven against a rigid plane only, not against a second body",
         "midplane", "free");
  if (options_.grid == GridKind::updated)
    for (const Material& m : particle_.materials)
      if (dilates(m))
        fail("--grid", "'updated' cannot follow plastic flow that changes the volume (yield_surface)",
             name_of(options_.grid), "mapped, rectilinear");
  if (options_.grid == GridKind::updated && (two || support_ == Support::midplane))
    fail("--grid", "'updated' does one free body against the rigid plane", name_of(options_.grid),
         "mapped, rectilinear");
}

double Collision::expected_overlap(double v) const
{
  const double drawn_in = drawn_in_overlap(partner_.attraction.work / (scale_.stress * scale_.length), e_star_, length_);
  const double hertz = std::max(hertz_overlap(reduced_mass_, e_star_, length_, v), drawn_in);
  const auto plastic = [&](const Material& m) {
    if (!m.yields()) return 0.0;
    const double rate = v * scale_.velocity() / scale_.length;
    const double yield = m.yield_stress / scale_.stress * rate_factor(m, rate);
    return plastic_overlap(reduced_mass_, length_, yield, v);
  };
  double bodies = std::max(hertz, plastic(particle_.materials.front()));
  if (partner_.particle) bodies = std::max(bodies, plastic(partner_.particle->materials.front()));
  if (partner_.wall) bodies = std::max(bodies, plastic(*partner_.wall));
  // a softer layer or inclusion gives way at most by what there is of it
  double deepest = bodies;
  const auto softer = [&](const Material& m, double extent) {
    deepest = std::max(deepest, std::min(plastic(m), bodies + extent / scale_.length));
  };
  for (const Particle* p : {&particle_, partner_.particle ? &*partner_.particle : nullptr}) {
    if (!p) continue;
    double depth = 0;
    for (const Particle::Layer& layer : p->layers)
      softer(p->materials[layer.material], depth += layer.thickness);
    for (const Particle::Inclusion& ball : p->inclusions)
      if (ball.material >= 0) softer(p->materials[ball.material], 2 * ball.radius);
  }
  return std::min(deepest_overlap, deepest);
}

/// sqrt(x) while elastic, growing towards sqrt(2 x) when fully plastic, of a sphere of radius 1 on a plane;
/// in general where both surfaces are gap_at_edge() apart.
double Collision::contact_radius(const Particle& p, double x) const
{
  const double onset = std::isfinite(yield_) ? length_ * onset_overlap(e_star_ * scale_.stress, yield_,
                                                                       p.materials.front().poisson_ratio)
                                             : yield_;
  const double gap = gap_at_edge(x, onset);
  if (particle_.is_sphere() && !partner_.particle && !partner_.wall) return std::sqrt(2 * gap);
  const auto apart = [&](double r) {
    double sum = particle_.surface_z(r * scale_.length);
    if (partner_.particle) sum += partner_.particle->surface_z(r * scale_.length);
    return sum / scale_.length;
  };
  double smallest = particle_.radius / scale_.length;
  if (partner_.particle) smallest = std::min(smallest, partner_.particle->radius / scale_.length);
  double low = 0, high = smallest;
  for (int n = 0; n < 50; ++n) {
    const double middle = 0.5 * (low + high);
    (apart(middle) < gap ? low : high) = middle;
  }
  return high;
}

/// Half width of the block of fine cells under a particle, R.
double Collision::block_for(const Particle& p, double deepest) const
{
  return std::clamp(block_over_contact * contact_radius(p, deepest), 1e-4,
                    widest_block * p.radius / scale_.length);
}

Body Collision::fitted_sphere(const Particle& p, double block, int cells, double shift) const
{
  const double radius = p.radius / scale_.length;
  const Phase phase = phase_of(p.materials.front(), scale_);
  MappedGrid grid = MappedGrid::build(cells, block / radius, support_ == Support::free, shift);
  grid.scale(radius);
  return mapped_body(grid, phase, hourglass_modulus(phase.moduli));
}

Body Collision::thick_wall(const Material& material, double block, int cells, double shift) const
{
  const Phase phase = phase_of(material, scale_);
  return mapped_body(MappedGrid::wall(cells, block, wall_extent, shift), phase,
                     hourglass_modulus(phase.moduli));
}

/// Two cells in a layer, as far as four times the cost allows.
double Collision::fine_step(const Particle& p, double block, int cells) const
{
  double step = block / cells;
  for (const Particle::Layer& layer : p.layers)
    step = std::min(step, std::max(0.5 * layer.thickness / scale_.length, 0.5 * block / cells));
  return step;
}

/// `p` must outlive the section.
CutSection Collision::section_of(const Particle& p, double block, int cells, double shift) const
{
  const double length = scale_.length;
  CutSection s;
  for (const Material& m : p.materials) s.phases.push_back(phase_of(m, scale_));
  s.phase_at = [&p, length](double r, double z) { return p.material_at(r * length, z * length); };
  s.surface_z = [&p, length](double r) { return p.surface_z(r * length) / length; };
  if (options_.fields)
    s.onto_body = [&p, length](double r, double z) { return onto_body(p, r * length, z * length, length); };
  s.radius = p.radius / length;
  s.pore_walls = pore_walls(p, length);
  s.height = (support_ == Support::free ? p.height() : p.height_of_largest_radius()) / length;
  if (support_ == Support::free) s.mass = mass_of(p) / scale_.mass();
  s.block = block, s.depth = 0.8 * block;
  s.fine = fine_step(p, block, cells);
  s.shift = shift;
  return s;
}

Body Collision::body_of(const Particle& p, double block, int cells, double shift) const
{
  const GridKind grid = options_.grid == GridKind::automatic ? choose_grid(p).grid : options_.grid;
  if (grid == GridKind::mapped) return fitted_sphere(p, block, cells, shift);
  const CutSection section = section_of(p, block, cells, shift);
  return grid == GridKind::updated ? updated_body(section) : rectilinear_body(section);
}

/// 20, and more for deep contacts, where steps are few and strains large.
int Collision::cells(const RunOptions& options, double deepest) const
{
  return cells_of(options, std::round(20 * (1 + std::min(1.0, deepest / 0.15))), 200, "");
}

/// Cells made; for two bodies the smaller number.
int Collision::cells_made(double deepest, int cells) const
{
  const auto made = [&](const Particle& p) {
    const double block = block_for(p, deepest);
    return static_cast<int>(std::lround(block / fine_step(p, block, cells)));
  };
  return partner_.particle ? std::min(made(particle_), made(*partner_.particle)) : made(particle_);
}

std::unique_ptr<Drive> Collision::drive() const
{
  if (support_ == Support::midplane) return std::make_unique<EquatorPlane>();
  return std::make_unique<BodyForce>();
}

Scene Collision::build(double deepest, int cells, double shift) const
{
  Scene scene;
  const double block = block_for(particle_, deepest);
  double widest = block;
  scene.bodies.push_back(body_of(particle_, block, cells, shift));
  if (const auto& other = partner_.particle) {
    const double beside = block_for(*other, deepest);
    scene.bodies.push_back(body_of(*other, beside, cells, shift));
    widest = std::max(widest, beside);
  }
  if (partner_.wall) scene.bodies.push_back(thick_wall(*partner_.wall, block, cells, shift));
  if (options_.precision == Precision::single)
    for (Body& body : scene.bodies) {
      if (body.moving) fail("--precision", "the updated grid does double precision only", "single", "double");
      body.use_single();
    }
  std::unique_ptr<Pull> pull;
  if (partner_.attraction.work > 0)
    pull = std::make_unique<SurfacePull>(in_run_units(partner_.attraction, widest / cells), scene.bodies);
  if (scene.bodies.size() == 1 && scene.bodies.front().reference().surface.corners == 1)
    scene.contact = std::make_unique<NodePlane>(std::move(pull));
  else
    scene.contact =
        std::make_unique<RowContact>(std::make_unique<Surface>(scene.bodies), sweeps_of_revolution, std::move(pull));
  return scene;
}

}  // namespace granulaw
