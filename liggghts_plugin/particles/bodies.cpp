#include "liggghts_plugin/particles/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "fix_multisphere.h"
#include "fix_rigid.h"
#include "fix_template_multisphere.h"
#include "liggghts_plugin/engine/private_members.hpp"

namespace granulaw::plugin {

// fix rigid gives its mass and body numbers away (extract), but not the rest.
GRANULAW_EXPOSE(RigidCentre, LAMMPS_NS::FixRigid, xcm);
GRANULAW_EXPOSE(RigidInertia, LAMMPS_NS::FixRigid, inertia);
GRANULAW_EXPOSE(RigidEx, LAMMPS_NS::FixRigid, ex_space);
GRANULAW_EXPOSE(RigidEy, LAMMPS_NS::FixRigid, ey_space);
GRANULAW_EXPOSE(RigidEz, LAMMPS_NS::FixRigid, ez_space);
GRANULAW_EXPOSE(TemplateCentres, LAMMPS_NS::FixTemplateMultiplespheres, x_sphere);
GRANULAW_EXPOSE(TemplateRadii, LAMMPS_NS::FixTemplateMultiplespheres, r_sphere);

namespace {

template <class Fix>
Fix* next_fix(LAMMPS_NS::LAMMPS* lmp, int& f)
{
  while (f < lmp->modify->nfix)
    if (Fix* found = dynamic_cast<Fix*>(lmp->modify->fix[f++])) return found;
  return nullptr;
}

double distance(const double* a, const double* b)
{
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

bool spheres_overlap(const double* a, double radius_a, const double* b, double radius_b)
{
  return distance(a, b) < (radius_a + radius_b) * (1.0 - 1e-12);
}

bool overlaps_itself(LAMMPS_NS::FixTemplateMultisphere& clump)
{
  double** x = clump.*exposed(TemplateCentres{});
  const double* r = clump.*exposed(TemplateRadii{});
  for (int i = 0; i < clump.number_spheres(); ++i)
    for (int j = 0; j < i; ++j)
      if (spheres_overlap(x[i], r[i], x[j], r[j])) return true;
  return false;
}

bool encloses(const double* a, double radius_a, const double* b, double radius_b)
{
  return radius_b < radius_a && distance(a, b) + radius_b <= radius_a * (1.0 + 1e-12);
}

/// Spheres of this rank and its ghosts by the clump that they belong to.
std::map<int, std::vector<int>> spheres_by_clump(LAMMPS_NS::FixMultisphere& clumps, const LAMMPS_NS::Atom& atom)
{
  std::map<int, std::vector<int>> found;
  for (int i = 0; i < atom.nlocal + atom.nghost; ++i)
    if (clumps.belongs_to(i) >= 0) found[clumps.belongs_to(i)].push_back(i);
  return found;
}

/// True if spheres of one body overlap, of those on this rank.
bool any_overlaps_itself(LAMMPS_NS::FixMultisphere& clumps, const LAMMPS_NS::Atom& atom)
{
  for (const auto& [tag, spheres] : spheres_by_clump(clumps, atom))
    for (const int i : spheres)
      for (const int j : spheres)
        if (atom.tag[j] < atom.tag[i] && spheres_overlap(atom.x[i], atom.radius[i], atom.x[j], atom.radius[j])) return true;
  return false;
}

}  // namespace

/// To ghosts and, since a body may belong to another rank than its sphere, back from them.
constexpr ParticleColumns::Spec Bodies::spec()
{
  return {
      .name = "granulaw_body", .columns = columns, .restart = false, .to_ghosts = true, .from_ghosts = true};
}

void Bodies::provide(LAMMPS_NS::LAMMPS* lmp, bool inertia)
{
  int from = 0, from_clumps = 0;
  const bool rigid = next_fix<LAMMPS_NS::FixRigid>(lmp, from);
  const bool clumps = next_fix<LAMMPS_NS::FixMultisphere>(lmp, from_clumps);
  if (rigid || (clumps && inertia)) ParticleColumns::provide(lmp, spec());
}

bool Bodies::overlap_themselves(LAMMPS_NS::LAMMPS* lmp)
{
  int f = 0;
  while (auto* clump = next_fix<LAMMPS_NS::FixTemplateMultisphere>(lmp, f))
    if (overlaps_itself(*clump)) return true;
  f = 0;
  while (auto* clumps = next_fix<LAMMPS_NS::FixMultisphere>(lmp, f))
    if (any_overlaps_itself(*clumps, *lmp->atom)) return true;
  return false;
}

double Bodies::smallest_radius(LAMMPS_NS::FixTemplateSphere& particle)
{
  auto* clump = dynamic_cast<LAMMPS_NS::FixTemplateMultisphere*>(&particle);
  if (!clump) return particle.min_rad();
  double** x = clump->*exposed(TemplateCentres{});
  const double* r = clump->*exposed(TemplateRadii{});
  const int n = clump->number_spheres();
  double smallest = particle.max_rad();
  for (int j = 0; j < n; ++j) {
    bool free = true;
    for (int i = 0; i < n; ++i) free = free && !encloses(x[i], r[i], x[j], r[j]);
    if (free) smallest = std::min(smallest, r[j]);
  }
  return smallest;
}

std::vector<bool> Bodies::enclosed(LAMMPS_NS::LAMMPS* lmp)
{
  const LAMMPS_NS::Atom& atom = *lmp->atom;
  std::vector<bool> found;
  int f = 0;
  while (auto* clumps = next_fix<LAMMPS_NS::FixMultisphere>(lmp, f)) {
    found.resize(static_cast<std::size_t>(atom.nlocal + atom.nghost));
    for (const auto& [tag, spheres] : spheres_by_clump(*clumps, atom))
      for (const int i : spheres)
        for (const int j : spheres)
          if (encloses(atom.x[i], atom.radius[i], atom.x[j], atom.radius[j])) found[static_cast<std::size_t>(j)] = true;
  }
  return found;
}

void Bodies::update(LAMMPS_NS::LAMMPS* lmp)
{
  values_ = ParticleColumns::find(lmp, spec());
  if (!values_) return;
  atom_ = lmp->atom;
  const LAMMPS_NS::Fix* freeze = lmp->modify->find_fix_style_strict("freeze", 0);
  freeze_bit_ = freeze ? freeze->groupbit : 0;
  alone_ = lmp->comm->nprocs == 1 ? lmp : nullptr;
  clear();
  const bool rigid_bodies = fill_rigid(lmp);
  if (alone_) {
    if (rigid_bodies) values_.send();
    return;
  }
  fill_clumps(lmp);
  values_.gather();  // sums: each sphere was filled once, on the rank of its body
  values_.send();
}

void Bodies::clear() const
{
  for (int i = 0; i < atom_->nlocal + atom_->nghost; ++i) {
    if (!alone_) std::fill_n(row(i), static_cast<int>(columns), 0.0);
    row(i)[mass_column] = alone_ ? not_looked_up : 0.0;
  }
}

bool Bodies::fill_rigid(LAMMPS_NS::LAMMPS* lmp) const
{
  int f = 0;
  bool any = false;
  while (LAMMPS_NS::FixRigid* rigid = next_fix<LAMMPS_NS::FixRigid>(lmp, f)) {
    any = true;
    int dim = 0;
    const int* body = static_cast<int*>(rigid->extract("body", dim));
    const double* mass = static_cast<double*>(rigid->extract("masstotal", dim));
    for (int i = 0; i < lmp->atom->nlocal; ++i)
      if (const int b = body[i]; b >= 0)
        fill(lmp, i, mass[b], (rigid->*exposed(RigidCentre{}))[b], (rigid->*exposed(RigidInertia{}))[b],
             (rigid->*exposed(RigidEx{}))[b], (rigid->*exposed(RigidEy{}))[b],
             (rigid->*exposed(RigidEz{}))[b]);
  }
  return any;
}

void Bodies::fill_clumps(LAMMPS_NS::LAMMPS* lmp) const
{
  LAMMPS_NS::Atom& atom = *lmp->atom;
  int f = 0;
  while (LAMMPS_NS::FixMultisphere* clumps = next_fix<LAMMPS_NS::FixMultisphere>(lmp, f)) {
    LAMMPS_NS::Multisphere& bodies = clumps->data();
    const auto vectors = [&](const char* name) { return bodies.extract_double_vector(name); };
    double **centre = vectors("xcm"), **inertia = vectors("inertia"), **ex = vectors("ex_space"),
           **ey = vectors("ey_space"), **ez = vectors("ez_space");
    for (int i = 0; i < atom.nlocal + atom.nghost; ++i) {
      const int tag = clumps->belongs_to(i);
      const int b = tag >= 0 ? bodies.map(tag) : -1;  // -1: the body belongs to another rank
      // of a sphere and its periodic images one is filled, and the others hear of it
      if (b < 0 || atom.map(atom.tag[i]) != i) continue;
      fill(lmp, i, bodies.mass(b), centre[b], inertia[b], ex[b], ey[b], ez[b]);
    }
  }
}

const double* Bodies::looked_up(int i) const
{
  if (alone_ && row(i)[mass_column] == not_looked_up) find_clump(alone_, i);
  return row(i);
}

void Bodies::find_clump(LAMMPS_NS::LAMMPS* lmp, int i) const
{
  row(i)[mass_column] = 0.0;
  int f = 0;
  while (LAMMPS_NS::FixMultisphere* clumps = next_fix<LAMMPS_NS::FixMultisphere>(lmp, f)) {
    LAMMPS_NS::Multisphere& bodies = clumps->data();
    const int tag = clumps->belongs_to(i), b = tag >= 0 ? bodies.map(tag) : -1;
    if (b < 0) continue;
    const auto vector = [&](const char* name) { return bodies.extract_double_vector(name)[b]; };
    fill(lmp, i, bodies.mass(b), vector("xcm"), vector("inertia"), vector("ex_space"), vector("ey_space"),
         vector("ez_space"));
  }
}

void Bodies::fill(LAMMPS_NS::LAMMPS* lmp, int i, double body_mass, const double* centre,
                  const double* moments, const double* ex, const double* ey, const double* ez) const
{
  double* values = row(i);
  std::fill_n(values, static_cast<int>(columns), 0.0);
  values[mass_column] = body_mass;
  double* r = values + arm;
  for (int c = 0; c < 3; ++c) r[c] = lmp->atom->x[i][c] - centre[c];
  lmp->domain->minimum_image(r[0], r[1], r[2]);
  // I^-1 = sum of e e^T/I over the principal axes; a moment of zero (a body on a line) does not turn about it
  const double* axes[3] = {ex, ey, ez};
  double* inverse = values + inverse_inertia;
  for (int k = 0; k < 3; ++k) {
    if (!(moments[k] > 0.0)) continue;
    const double* e = axes[k];
    inverse[0] += e[0] * e[0] / moments[k];
    inverse[1] += e[1] * e[1] / moments[k];
    inverse[2] += e[2] * e[2] / moments[k];
    inverse[3] += e[0] * e[1] / moments[k];
    inverse[4] += e[0] * e[2] / moments[k];
    inverse[5] += e[1] * e[2] / moments[k];
  }
}

double Bodies::height(int i, const double* n, double sphere_radius) const
{
  const double* values = looked_up(i);
  if (!(values[mass_column] > 0.0)) return sphere_radius;
  const double* r = values + arm;
  return sphere_radius + r[0] * n[0] + r[1] * n[1] + r[2] * n[2];
}

double Bodies::inverse_mass(int i, const double* n, double sphere_mass) const
{
  const double* values = looked_up(i);
  if (!(values[mass_column] > 0.0)) return 1.0 / sphere_mass;
  const double *r = values + arm, *v = values + inverse_inertia;
  const double t[3] = {r[1] * n[2] - r[2] * n[1], r[2] * n[0] - r[0] * n[2], r[0] * n[1] - r[1] * n[0]};
  // n.[(I^-1 t) x r] = t.(I^-1 t)
  return 1.0 / values[mass_column] + v[0] * t[0] * t[0] + v[1] * t[1] * t[1] + v[2] * t[2] * t[2] +
         2.0 * (v[3] * t[0] * t[1] + v[4] * t[0] * t[2] + v[5] * t[1] * t[2]);
}

}  // namespace granulaw::plugin
