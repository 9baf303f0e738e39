#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "liggghts_plugin/confine/confinement.hpp"
#include "liggghts_plugin/engine/shapes.hpp"

namespace granulaw::plugin {

/// One contact of a sphere with a wall, in the place of LIGGGHTS's own (Walls::Granular): the same forces.
/// LIGGGHTS finds the contacts (fix wall/gran) and calls compute_force for each.
///
/// A sphere beside the wall is none: where another model registers a contact distance (liquid bridges), fix
/// wall/gran calls for spheres that do not touch, too. They may have a force of that model; heat, `compute
/// wall/gran/local` and the law itself see only those that touch.
///
/// Left out: the energies of `computeElasticPotential` and `computeDissipatedEnergy`, which our models
/// refuse.
template <class ContactModel>
class WallLoop : public LIGGGHTS::Walls::IGranularWall
{
  using ForceData = LIGGGHTS::ContactModels::ForceData;
  using SurfacesIntersectData = LIGGGHTS::ContactModels::SurfacesIntersectData;

 public:
  WallLoop(LAMMPS* lmp, FixWallGran* parent, int64_t hash)
      : lmp_(lmp), model_(lmp, parent, true, hash), parent_(parent)
  {
  }

  void settings(int nargs, char** args, LIGGGHTS::IContactHistorySetup* hsetup) override
  {
    Settings settings(lmp_);
    model_.registerSettings(settings);
    const bool understood = settings.parseArguments(nargs, args);
    model_.postSettings(hsetup);
    if (!understood) lmp_->error->fix_error(FLERR, parent_, settings.error_message.c_str());
  }

  void init_granular() override { model_.connectToProperties(lmp_->force->registry); }
  bool checkSurfaceIntersect(SurfacesIntersectData& contact) override
  {
    return model_.checkSurfaceIntersect(contact);
  }
  int get_history_offset(const std::string name) override { return model_.get_history_offset(name); }
  bool contact_match(const std::string kind, const std::string model) override
  {
    return model_.contact_match(kind, model);
  }

  void compute_force(FixWallGran* wall, SurfacesIntersectData& contact, bool touches, double* wall_velocity,
                     LAMMPS_NS::FixMeshSurface* fix_mesh, int mesh_number, LAMMPS_NS::TriMesh* mesh,
                     int triangle) override
  {
    const LAMMPS_NS::Atom& atom = *lmp_->atom;
    const int i = contact.i;
    contact.v_i = atom.v[i];
    contact.omega_i = atom.omega[i];
    contact.v_j = wall_velocity;
    contact.j = mesh ? triangle : -wall->atom_type_wall();
    contact.itype = atom.type[i];
    contact.jtype = wall->atom_type_wall();
    contact.contact_flags = nullptr;
    contact.r = contact.radi - contact.deltan;
    contact.rsq = contact.r * contact.r;
    contact.rinv = 1.0 / contact.r;
    double normal_per_delta = contact.rinv;
    if (superquadrics_built && atom.superquadric_flag) {  // delta ends in the surface, not at the centre
      const double* d = contact.delta;
      normal_per_delta = 1.0 / std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
      contact.radi = volume_radius(atom, i);
    }
    contact.radsum = contact.radi;
    for (int c = 0; c < 3; ++c) contact.en[c] = contact.delta[c] * normal_per_delta;
    contact.area_ratio = 1.0;
    contact.meff = contact.mi = mass(*wall, i);
    contact.computeflag = wall->computeflag();
    contact.shearupdate = wall->shearupdate();

    const double overlap = contact.deltan;  // a body behind the contact takes a part of it
    ForceData on_i, on_wall;
    using AtWall = Confinement::AtWall;
    AtWall confined = AtWall::apart;
    if (confinement_ && *confinement_ && (*confinement_)->asks_walls) [[unlikely]]
      confined = (*confinement_)->at_wall(*wall, contact, wall_velocity, mesh_number, mesh ? mesh->id(triangle) : -1, on_i);
    if (confined == AtWall::collected) return;
    if (confined != AtWall::apart) {
      touches = contact.has_force_update = confined == AtWall::acts;
    } else if (contact.has_force_update = touches; touches) {
      model_.surfacesIntersect(contact, on_i, on_wall);
      model_.endSurfacesIntersect(contact, mesh, on_i, on_wall);
    } else
      model_.surfacesClose(contact, on_i, on_wall);

    const bool acts = contact.computeflag && contact.has_force_update;
    if (acts)
      for (int c = 0; c < 3; ++c) {
        atom.f[i][c] += on_i.delta_F[c];
        atom.torque[i][c] += on_i.delta_torque[c];
      }
    if (contact.computeflag && wall->store_sum_normal_force())
      *wall->get_sum_normal_force_ptr(i) +=
          on_i.delta_F[0] * contact.en[0] + on_i.delta_F[1] * contact.en[1] + on_i.delta_F[2] * contact.en[2];
    const int triangle_id = mesh ? mesh->id(triangle) : 0;
    if (wall->store_force_contact() && lmp_->update->ntimestep % wall->store_force_contact_every() == 0)
      wall->add_contactforce_wall(i, on_i, triangle_id);
    if (wall->store_force_contact_stress())
      wall->add_contactforce_stress_wall(i, on_i, contact.delta, wall_velocity, triangle_id);
    if (touches && wall->compute_wall_gran_local() && wall->addflag())
      list(wall, contact, on_i, wall_velocity, mesh_number, triangle_id);
    if (touches && wall->heattransfer_flag())
      wall->addHeatFlux(mesh, i, contact.radi, heat_overlap(contact, overlap), 1.0);
    if (!contact.has_force_update) return;
    double force[3] = {0, 0, 0}, lever[3];
    for (int c = 0; c < 3; ++c) {
      if (acts) force[c] = on_i.delta_F[c];
      lever[c] = -contact.delta[c];
    }
    if (wall->store_force())
      for (int c = 0; c < 3; ++c) wall->fix_wallforce()->array_atom[i][c] += force[c];
    if (fix_mesh) fix_mesh->add_particle_contribution(i, force, lever, triangle, wall_velocity);
  }

 protected:
  ContactModel& model() { return model_; }
  /// Who knows the forces on confined particles in the place of this loop; null: nobody.
  void set_confinement(Confinement* const* confinement) { confinement_ = confinement; }

  /// The overlap whose circle heat passes through, in LIGGGHTS's formula: area pi (R^2 - (R - overlap)^2). `overlap`: the geometric one.
  virtual double heat_overlap(const SurfacesIntersectData& contact, double overlap) const = 0;

  /// Calls visit(i, atom type of the wall, history) for each contact of a local sphere that is open now.
  template <class Visit>
  void each_open_contact(Visit&& visit) const
  {
    const int nlocal = lmp_->atom->nlocal;
    if (!parent_->is_mesh_wall()) {
      // fix wall/gran keeps the histories of a primitive in a fix of this name
      const std::string name = std::string("history_") + parent_->id;
      const auto* fix = static_cast<LAMMPS_NS::FixPropertyAtom*>(lmp_->modify->find_fix_property(
          name.c_str(), "property/atom", "vector", 0, 0, parent_->style, false));
      if (!fix || !fix->array_atom) return;
      for (int i = 0; i < nlocal; ++i) visit(i, parent_->atom_type_wall(), fix->array_atom[i]);
      return;
    }
    for (int m = 0; m < parent_->n_meshes(); ++m) {
      LAMMPS_NS::FixContactHistoryMesh* contacts = parent_->mesh_list()[m]->contactHistory();
      if (!contacts) continue;
      for (int i = 0; i < nlocal; ++i) {
        const int places = contacts->n_partner(i) > 0 ? contacts->nneighs(i) : 0;
        for (int k = 0; k < places; ++k)
          if (contacts->get_partner_idTri(i, k) >= 0)
            visit(i, parent_->mesh_list()[m]->atomTypeWall(), contacts->contacthistory(i, k));
      }
    }
  }

 private:
  double mass(FixWallGran& wall, int i) const
  {
    return wall.fix_rigid() && wall.body(i) >= 0 ? wall.masstotal(wall.body(i)) : lmp_->atom->rmass[i];
  }

  /// For compute wall/gran/local.
  void list(FixWallGran* wall, SurfacesIntersectData& contact, const ForceData& on_i, double* wall_velocity,
            int mesh_number, int triangle_id) const
  {
    double point[3], normal[3];
    for (int c = 0; c < 3; ++c) {
      point[c] = lmp_->atom->x[contact.i][c] - contact.delta[c];
      normal[c] = -contact.en[c];
    }
#ifdef SUPERQUADRIC_ACTIVE_FLAG
    if (lmp_->atom->superquadric_flag) std::copy_n(contact.contact_point, 3, point);
#endif
    LAMMPS_NS::ComputePairGranLocal* rows = wall->compute_wall_gran_local();
    rows->add_wall_1(mesh_number, triangle_id, contact.i, point, wall_velocity);
    const double *f = on_i.delta_F, *t = on_i.delta_torque;
    rows->add_wall_2(contact.i, f[0], f[1], f[2], t[0], t[1], t[2], contact.contact_history, contact.rsq,
                     normal);
  }

  LAMMPS* lmp_;
  ContactModel model_;
  FixWallGran* parent_;
  Confinement* const* confinement_ = nullptr;
};

}  // namespace granulaw::plugin
