#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "contact/pair.hpp"
#include "contact/vector.hpp"
#include "liggghts_plugin/deck/session.hpp"
#include "liggghts_plugin/engine/shapes.hpp"
#include "liggghts_plugin/particles/bodies.hpp"
#ifdef SUPERQUADRIC_ACTIVE_FLAG
#include "superquadric.h"
#endif

// Parts of a contact of superquadrics beyond one of spheres (shapes.hpp says where they are built).
namespace granulaw::plugin {

/// R*, m. Superquadrics have a local one: 1/(k_i + k_j), with the curvatures k (1/m) at the point of contact.
inline double effective_radius(const cm::SurfacesIntersectData& sidata)
{
#ifdef SUPERQUADRIC_ACTIVE_FLAG
  if (sidata.is_non_spherical) return sidata.reff;
#endif
  return sidata.is_wall ? sidata.radi : granulaw::effective_radius(sidata.radi, sidata.radj);
}

/// A body at its contact, m: radius of curvature, and height of its centre of mass over the contact.
struct BodyAtContact
{
  double radius, height;
};
/// Both bodies of a contact; that of a wall has no height, and is not asked for.
inline std::array<BodyAtContact, 2> bodies_at_contact(const cm::SurfacesIntersectData& sidata, const Bodies& bodies, LAMMPS_NS::Atom& atom)
{
  const double* n = sidata.en;
#ifdef SUPERQUADRIC_ACTIVE_FLAG
  if (sidata.is_non_spherical) {
    const double* point = sidata.contact_point;
    const auto height = [&](int particle) {
      double over = 0.0;
      for (int c = 0; c < 3; ++c) over += (atom.x[particle][c] - point[c]) * n[c];
      return std::abs(over);
    };
    const auto curvature = [&](int particle) {
      Superquadric shape(atom.x[particle], atom.quaternion[particle], atom.shape[particle], atom.blockiness[particle]);
      return shape.calc_curvature_coefficient(0, point);  // 0: the mean one
    };
    if (sidata.is_wall) return {{{sidata.reff, height(sidata.i)}, {}}};
    // of 1/R* each has the part that its curvature has of both
    const double i = curvature(sidata.i), both = i + curvature(sidata.j), share = both > 0.0 ? i / both : 0.5;
    return {{{sidata.reff / share, height(sidata.i)}, {sidata.reff / (1.0 - share), height(sidata.j)}}};
  }
#endif
  (void)atom;
  const double inward[3] = {-n[0], -n[1], -n[2]}, outward[3] = {n[0], n[1], n[2]};
  const BodyAtContact i{sidata.radi, bodies.height(sidata.i, inward, sidata.radi)};
  if (sidata.is_wall) return {{i, {}}};
  return {{i, {sidata.radj, bodies.height(sidata.j, outward, sidata.radj)}}};
}

/// Adds the torque of the normal force (N, along en) about the centres. That of a sphere is zero.
inline void add_normal_torque(const cm::SurfacesIntersectData& sidata, const double* const* x, double force,
                              cm::ForceData& i_forces, cm::ForceData& j_forces)
{
#ifdef SUPERQUADRIC_ACTIVE_FLAG
  if (!sidata.is_non_spherical) return;
  const auto add = [&](int particle, double along_normal, double* torque) {
    double arm[3];
    for (int c = 0; c < 3; ++c) arm[c] = sidata.contact_point[c] - x[particle][c];
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      torque[c] += along_normal * (arm[d] * sidata.en[e] - arm[e] * sidata.en[d]);
    }
  };
  add(sidata.i, force, i_forces.delta_torque);
  if (!sidata.is_wall) add(sidata.j, -force, j_forces.delta_torque);
#else
  (void)sidata, (void)x, (void)force, (void)i_forces, (void)j_forces;
#endif
}

/// Adds a shear force (N) and its torques about the centres. `lever`: m, from the centre of a sphere i.
[[gnu::always_inline]] inline void add_shear(const cm::SurfacesIntersectData& sidata, const LAMMPS_NS::Atom& atom, const Vector& shear,
                                             double lever, cm::ForceData& i_forces, cm::ForceData& j_forces)
{
  // component by component: in a loop whose places are variables the arrays stay in memory
  const double share = sidata.is_wall ? sidata.area_ratio : 1.0, x = shear[0], y = shear[1], z = shear[2];
  const auto add = [](double (&to)[3], double a, double b, double c) { to[0] += a, to[1] += b, to[2] += c; };
  add(i_forces.delta_F, x * share, y * share, z * share);
  if (!sidata.is_wall) add(j_forces.delta_F, -x, -y, -z);
#ifdef SUPERQUADRIC_ACTIVE_FLAG
  if (sidata.is_non_spherical) {
    const auto torque = [&](int particle) {
      double arm[3];
      for (int c = 0; c < 3; ++c) arm[c] = sidata.contact_point[c] - atom.x[particle][c];
      return times(cross(arm, shear), share);
    };
    const Vector on_i = torque(sidata.i);
    add(i_forces.delta_torque, on_i[0], on_i[1], on_i[2]);
    if (sidata.is_wall) return;
    const Vector on_j = torque(sidata.j);
    return add(j_forces.delta_torque, -on_j[0], -on_j[1], -on_j[2]);
  }
#endif
  (void)atom;
  const Vector torque = cross(sidata.en, shear);
  add(i_forces.delta_torque, -lever * torque[0] * share, -lever * torque[1] * share, -lever * torque[2] * share);
  if (!sidata.is_wall) add(j_forces.delta_torque, -sidata.crj * torque[0], -sidata.crj * torque[1], -sidata.crj * torque[2]);
}

/// Throws Error where a law of one size (`rated`) meets particles that have another radius at each point.
inline void refuse_rated(LAMMPS_NS::LAMMPS* lmp, const Setup& setup, bool rated)
{
  if (superquadrics_built && lmp->atom->superquadric_flag && rated)
    fail(setup.where,
         "the law depends on the strain rate and holds for spheres of one radius: superquadrics have another "
         "at each point");
}

/// Takes the surface model's own words out of `words`. Throws Error unless they require the local curvature:
/// without it LIGGGHTS gives R* of spheres of the same volume, whatever the shape.
inline std::vector<std::string> take_curvature_words(const std::string& where, std::vector<char*>& words)
{
  std::vector<std::string> taken;
  const auto take = [&](const char* key) {
    const auto found =
        std::find_if(words.begin(), words.end(), [&](const char* w) { return std::string(w) == key; });
    if (found == words.end() || found + 1 == words.end()) return std::string();
    const std::string value = *(found + 1);
    taken.insert(taken.end(), {key, value});
    words.erase(found, found + 2);
    return value;
  };
  const bool mean = take("meanCurvature") == "yes", gaussian = take("gaussianCurvature") == "yes";
  const std::string limit = take("curvatureLimitFactor");
  char* end = nullptr;
  if (mean == gaussian || !(std::strtod(limit.c_str(), &end) > 0) || *end)
    fail(where,
         "'surface superquadric' needs the local curvature, which the contact law depends on: say either "
         "'meanCurvature yes' or 'gaussianCurvature yes', and 'curvatureLimitFactor F' with F > 0, the "
         "largest R* over that of spheres of the same volume");
  return taken;
}

/// Throws Error where a surface model meets particles that it is not for, or a keyword what it cannot serve.
inline void refuse_shape(LAMMPS_NS::LAMMPS* lmp, const Setup& setup, bool superquadric_surface)
{
  if constexpr (superquadrics_built) {
    if (!superquadric_surface && lmp->atom->superquadric_flag)
      fail(setup.where, "atom_style superquadric needs 'surface superquadric' behind the other models");
    if (superquadric_surface && setup.session->energy)
      fail(setup.where,
           "'energy on' is for spheres: of superquadrics the normal force does work on rotations, too, which "
           "these books do not hold");
  }
}

}  // namespace granulaw::plugin
