#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <vector>

#include "liggghts_plugin/confine/confinement.hpp"
#include "liggghts_plugin/deck/session.hpp"
#include "liggghts_plugin/engine/shapes.hpp"
#include "liggghts_plugin/particles/bodies.hpp"

namespace granulaw::plugin {

/// The loop over neighbouring particles, in the place of LIGGGHTS's own (PairStyles::Granular): the same
/// forces to the bit, in the same order, in less time.
///
/// A neighbour that does not touch costs its distance and one flag, not a cleared set of forces and a visit
/// to its history: contact_flags says which models hold history, so surfacesClose is called in the step in
/// which a pair parts, however far it got, and not again. What only some decks ask for (virial, stored
/// contact forces, compute pair/gran/local) stands apart from the path of every contact.
///
/// Left out: `fix multicontact`, which belongs to surface models that ours refuse; it stops the run.
template <class ContactModel>
class PairLoop : public LIGGGHTS::PairStyles::IGranularPairStyle
{
  using ForceData = LIGGGHTS::ContactModels::ForceData;
  using SurfacesIntersectData = LIGGGHTS::ContactModels::SurfacesIntersectData;

 public:
  PairLoop(LAMMPS* lmp, PairGran* parent, int64_t hash) : lmp_(lmp), model_(lmp, parent, false, hash) {}

  int64_t hashcode() override { return model_.hashcode(); }
  int get_history_offset(const std::string name) override { return model_.get_history_offset(name); }
  double stressStrainExponent() override { return model_.stressStrainExponent(); }
  bool contact_match(const std::string kind, const std::string model) override
  {
    return model_.contact_match(kind, model);
  }

  void settings(int nargs, char** args, LIGGGHTS::IContactHistorySetup* hsetup) override
  {
    Settings settings(lmp_);
    model_.registerSettings(settings);
    const bool understood = settings.parseArguments(nargs, args);
    model_.postSettings(hsetup);
    if (!understood) lmp_->error->all(FLERR, settings.error_message.c_str());
  }

  void init_granular() override { model_.connectToProperties(lmp_->force->registry); }

  void write_restart_settings(FILE* file) override
  {
    const int64_t code = hashcode();
    std::fwrite(&code, sizeof code, 1, file);
  }
  /// `known`: read already by LIGGGHTS; -1: an old file, still to be compared with its own.
  void read_restart_settings(FILE* file, int64_t known) override
  {
    if (lmp_->comm->me != 0) return;
    int64_t written = -1;
    const bool complete = std::fread(&written, sizeof written, 1, file) == 1;
    if (known == -1) known = complete ? written : -1;
    if (known != hashcode()) lmp_->error->one(FLERR, "the restart file was written by another pair style");
  }

  void compute_force(PairGran* pair, int eflag, int vflag, int addflag) override
  {
    if (eflag || vflag)
      pair->ev_setup(eflag, vflag);
    else
      pair->evflag = pair->vflag_fdotr = 0;
    if (pair->storeSumDelta())
      lmp_->error->all(FLERR, "fix multicontact needs 'surface multicontact', which this normal model lacks");
    copy_predefined_histories(pair);
    const bool observed = pair->evflag || (pair->cpl() && addflag) || pair->storeContactForces() ||
                          pair->storeContactForcesStress() || pair->store_sum_normal_force();
    Confinement* const confinement = confinement_ ? *confinement_ : nullptr;
    if (confinement) [[unlikely]] confinement->choose(*pair);
    if (!confinement || !confinement->takes_all) run_walk(pair, observed, addflag);
    if (confinement && confinement->takes_some) [[unlikely]] confine(*confinement, pair, observed, addflag);
    if (pair->cpl() && addflag) pair->cpl_pair_finalize();
    if (pair->storeContactForces()) pair->fix_contact_forces()->do_forward_comm();
    if (pair->storeContactForcesStress()) pair->fix_contact_forces_stress()->do_forward_comm();
  }

 protected:
  /// Calls visit(i, j, weight, history) for each contact that is open now. One between a sphere of this rank
  /// and a ghost is seen twice, with weight 1/2.
  template <class Visit>
  void each_open_contact(PairGran& pair, Visit&& visit) const
  {
    if (!pair.list || !pair.listgranhistory) return;
    const LAMMPS_NS::NeighList &list = *pair.list, &history = *pair.listgranhistory;
    for (int ii = 0; ii < list.inum; ++ii) {
      const int i = list.ilist[ii];
      for (int jj = 0; jj < list.numneigh[i]; ++jj)
        if (history.firstneigh[i][jj]) {
          const int j = list.firstneigh[i][jj] & NEIGHMASK;
          visit(i, j, j < lmp_->atom->nlocal ? 1.0 : 0.5, &history.firstdouble[i][pair.dnum() * jj]);
        }
    }
  }
  ContactModel& model() { return model_; }
  /// From where the masses of rigid bodies come.
  void set_bodies(const Bodies* bodies) { bodies_ = bodies; }
  /// Who computes the forces of confined particles in the place of this loop; null: nobody.
  void set_confinement(Confinement* const* confinement) { confinement_ = confinement; }

 private:
  /// A neighbour that touches, or did one step ago.
  struct Candidate
  {
    int i, j;         // indices of the spheres
    int* flags;       // which models hold history
    double* history;  // of the contact
  };

  /// LIGGGHTS's arrays of particles. Each is one block: row k begins at 3 k.
  struct Particles
  {
    const double *x, *radius, *rmass, *mass;  // rmass null: mass, by type
    double *v, *omega, *f, *torque;
    const int *type, *mask;
    int count;  // of this rank, without ghosts

    explicit Particles(const LAMMPS_NS::Atom& atom)
        : x(atom.x[0]),
          radius(atom.radius),
          rmass(atom.rmass),
          mass(atom.mass),
          v(atom.v[0]),
          omega(atom.omega[0]),
          f(atom.f[0]),
          torque(atom.torque[0]),
          type(atom.type),
          mask(atom.mask),
          count(atom.nlocal)
    {
    }
  };

  /// The values that all contacts of a step share.
  struct Pass
  {
    PairGran* pair;
    int computeflag, shearupdate, addflag;
    int frozen;     // bit of the frozen group, 0: none
    bool rigid;     // spheres may be part of fix rigid's bodies
    bool newton;    // forces on ghosts count
    bool observed;  // tell_observers
    const char* confined;  // of particles and ghosts: contacts are not this loop's; null: all are
  };
  /// True if spheres that do not touch may act on each other; also those that have not touched (liquid bridges): all within
  /// LIGGGHTS's contact distance are visited then.
  bool acts_at_distance() const
  {
    if constexpr (requires { model_.acts_at_distance(); })
      return model_.acts_at_distance();
    else
      return false;
  }
  bool begins_apart() const
  {
    if constexpr (requires { model_.begins_apart(); })
      return model_.begins_apart();
    else
      return false;
  }
  static constexpr bool superquadric = requires { requires ContactModel::superquadric; };

  /// So many are collected before their forces are computed: what was read of them is still in the cache.
  static constexpr std::size_t batch = 256;

  /// The inner loop of the simulation, once inlined. Contacts are collected first, because no processor can
  /// predict which neighbours touch: a branch around the force was mispredicted once for each contact.
  /// collect() has no such branch.
  [[gnu::flatten]] void walk(PairGran* pair, bool observed, int addflag)
  {
    walk_body(pair, observed, addflag);
  }
#ifdef __x86_64__
  /// The same for processors with AVX2, to the bit: without fused products. Instructions with three operands
  /// save a twentieth of the time.
  [[gnu::flatten, gnu::target("avx2")]] void walk_avx2(PairGran* pair, bool observed, int addflag)
  {
    walk_body(pair, observed, addflag);
  }
#endif
  void run_walk(PairGran* pair, bool observed, int addflag)
  {
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx2")) return walk_avx2(pair, observed, addflag);
#endif
    walk(pair, observed, addflag);
  }
  Pass pass_of(PairGran* pair, bool observed, int addflag) const
  {
    return {.pair = pair,
            .computeflag = pair->computeflag(),
            .shearupdate = pair->shearupdate(),
            .addflag = addflag,
            .frozen = pair->freeze_group_bit(),
            .rigid = pair->fr_pair() && bodies_ && bodies_->known(),
            .newton = lmp_->force->newton_pair != 0,
            .observed = observed,
            .confined = confinement_ && *confinement_ ? (*confinement_)->pressed : nullptr};
  }
  /// The forces of confined particles.
  [[gnu::noinline, gnu::cold]] void confine(Confinement& confinement, PairGran* pair, bool observed, int addflag)
  {
    const Pass pass = pass_of(pair, observed, addflag);
    const Confinement::Observer tell = [&](SurfacesIntersectData& contact, const ForceData& on_i, const ForceData& on_j) {
      tell_observers(pass, contact, on_i, on_j);
    };
    confinement.compute(*pair, observed ? &tell : nullptr);
  }
  [[gnu::always_inline]] inline void walk_body(PairGran* pair, bool observed, int addflag)
  {
    const LAMMPS_NS::NeighList& list = *pair->list;
    const Pass pass = pass_of(pair, observed, addflag);
    SurfacesIntersectData of_pass;
    ForceData on_i, on_j;
    of_pass.is_wall = false;
    of_pass.area_ratio = 1.0;
    of_pass.computeflag = pass.computeflag;
    of_pass.shearupdate = pass.shearupdate;
    model_.beginPass(of_pass, on_i, on_j);
    if (list.inum > 0) {
      const Particles particles(*lmp_->atom);
      std::size_t found = 0;
      for (int ii = 0; ii < list.inum; ++ii) {
        found += collect(*pair, particles, list.ilist[ii], found);
        if (found < batch && ii + 1 < list.inum) continue;
        for (std::size_t k = 0; k < found; ++k) visit(pass, particles, candidates_[k]);
        found = 0;
      }
    }
    model_.endPass(of_pass, on_i, on_j);
  }

  /// Writes the candidates of sphere i to candidates_[at] and on. Returns how many there are.
  std::size_t collect(PairGran& pair, const Particles& particles, int i, std::size_t at)
  {
    const int* neighbours = pair.list->firstneigh[i];
    int* flags = pair.listgranhistory->firstneigh[i];
    double* history = pair.listgranhistory->firstdouble[i];
    const int count = pair.list->numneigh[i], values = pair.dnum();
    if (candidates_.size() < at + static_cast<std::size_t>(count)) [[unlikely]]
      candidates_.resize(2 * (at + static_cast<std::size_t>(count)));
    const double *const x = particles.x, *const radius = particles.radius;
    const double xi = x[3 * i], yi = x[3 * i + 1], zi = x[3 * i + 2], ri = radius[i];
    Candidate* out = candidates_.data() + at;
    double reach2 = 1.0;  // of the squared sum of radii
    if (begins_apart())
      reach2 = lmp_->neighbor->contactDistanceFactor * lmp_->neighbor->contactDistanceFactor;
    for (int jj = 0; jj < count; ++jj) {
      const int j = neighbours[jj] & NEIGHMASK;
      const double* const xj = x + 3 * j;
      const double dx = xi - xj[0], dy = yi - xj[1], dz = zi - xj[2];
      const double rsq = dx * dx + dy * dy + dz * dz, radsum = ri + radius[j];
      *out = {i, j, flags + jj, history};
      history += values;
      out += static_cast<std::size_t>((rsq < reach2 * (radsum * radsum)) | (flags[jj] != 0));
    }
    return static_cast<std::size_t>(out - (candidates_.data() + at));
  }

  /// One contact. Its numbers live in registers: no function that is not inlined is given their address. One
  /// that needs them takes a copy, made in a block that is seldom entered.
  void visit(const Pass& pass, const Particles& particles, const Candidate& candidate)
  {
    const int i = candidate.i, j = candidate.j;
    if (pass.confined) [[unlikely]]
      if (pass.confined[i] | pass.confined[j]) return;
    const double *const xi = particles.x + 3 * i, *const xj = particles.x + 3 * j;
    SurfacesIntersectData contact;
    ForceData on_i, on_j;
    contact.is_wall = false;
    contact.area_ratio = 1.0;
    contact.computeflag = pass.computeflag;
    contact.shearupdate = pass.shearupdate;
    contact.i = i;
    contact.itype = particles.type[i];
    contact.radi = particles.radius[i];
    contact.v_i = particles.v + 3 * i;
    contact.omega_i = particles.omega + 3 * i;
    contact.j = j;
    contact.jtype = particles.type[j];
    contact.radj = particles.radius[j];
    contact.v_j = particles.v + 3 * j;
    contact.omega_j = particles.omega + 3 * j;
    for (int c = 0; c < 3; ++c) contact.delta[c] = xi[c] - xj[c];
    contact.rsq = contact.delta[0] * contact.delta[0] + contact.delta[1] * contact.delta[1] +
                  contact.delta[2] * contact.delta[2];
    contact.radsum = contact.radi + contact.radj;
    contact.contact_flags = candidate.flags;
    contact.contact_history = candidate.history;
    if (!(contact.rsq < contact.radsum * contact.radsum) || !surfaces_meet(pass, particles, contact)) {
      contact.has_force_update = false;
      if (acts_at_distance()) set_normal(pass, particles, contact);
      model_.surfacesClose(contact, on_i, on_j);
      if (acts_at_distance())
        if (contact.has_force_update) apply(pass, particles, contact, on_i, on_j);
      return;
    }
    if (contact.rsq == 0.0) [[unlikely]]
      stop_at_one_place(i, j);
    set_normal(pass, particles, contact);
    model_.surfacesIntersect(contact, on_i, on_j);
    model_.endSurfacesIntersect(contact, nullptr, on_i, on_j);
    contact.has_force_update = true;
    apply(pass, particles, contact, on_i, on_j);
  }

  void set_normal(const Pass& pass, const Particles& particles, SurfacesIntersectData& contact) const
  {
    contact.r = std::sqrt(contact.rsq);
    contact.rinv = 1.0 / contact.r;
    if constexpr (!superquadric)
      for (int c = 0; c < 3; ++c) contact.en[c] = contact.delta[c] * contact.rinv;
    set_masses(pass, particles, contact);
  }

  void apply(const Pass& pass, const Particles& particles, const SurfacesIntersectData& contact,
             const ForceData& on_i, const ForceData& on_j)
  {
    const int i = contact.i, j = contact.j;
    if (pass.computeflag) {
      add(pass.pair->relax(i), on_i, particles.f + 3 * i, particles.torque + 3 * i);
      if (pass.newton || j < particles.count)
        add(pass.pair->relax(j), on_j, particles.f + 3 * j, particles.torque + 3 * j);
    }
    if (pass.observed) [[unlikely]]
      tell_observers(pass, contact, on_i, on_j);
  }

  /// Narrow phase. The bounding spheres meet; the surface model of superquadrics says whether the surfaces
  /// do, and finds contact point, normal, overlap and R*.
  bool surfaces_meet(const Pass& pass, const Particles& particles, SurfacesIntersectData& contact)
  {
    if constexpr (superquadric) {
      contact.radi = volume_radius(*lmp_->atom, contact.i);
      contact.radj = volume_radius(*lmp_->atom, contact.j);
      set_masses(pass, particles, contact);
      return model_.checkSurfaceIntersect(contact);
    }
    return true;
  }

  /// The body's mass where a sphere is part of one: fix multisphere has it in rmass; that of fix rigid is
  /// with Bodies, for ghosts, too. A frozen sphere leaves the other its own.
  void set_masses(const Pass& pass, const Particles& particles, SurfacesIntersectData& contact) const
  {
    const int i = contact.i, j = contact.j;
    double mass_i = particles.rmass ? particles.rmass[i] : particles.mass[contact.itype];
    double mass_j = particles.rmass ? particles.rmass[j] : particles.mass[contact.jtype];
    if (pass.rigid) [[unlikely]] {
      if (bodies_->mass(i) > 0.0) mass_i = bodies_->mass(i);
      if (bodies_->mass(j) > 0.0) mass_j = bodies_->mass(j);
    }
    contact.mi = mass_i;
    contact.mj = mass_j;
    contact.meff = mass_i * mass_j / (mass_i + mass_j);
    if (pass.frozen) [[unlikely]] {
      if (particles.mask[i] & pass.frozen) contact.meff = mass_j;
      if (particles.mask[j] & pass.frozen) contact.meff = mass_i;
    }
  }

  static void add(double share, const ForceData& part, double* force, double* torque)
  {
    for (int c = 0; c < 3; ++c) {
      force[c] += share * part.delta_F[c];
      torque[c] += share * part.delta_torque[c];
    }
  }

  [[noreturn, gnu::noinline, gnu::cold]] void stop_at_one_place(int i, int j) const
  {
    const LAMMPS_NS::Atom& atom = *lmp_->atom;
    stop_one(lmp_,
             fmt::format("step {}: particles {} and {} are at one place ({:.6g}, {:.6g}, {:.6g}): two that "
                         "lie upon each other have no contact normal",
                         lmp_->update->ntimestep, atom.tag[i], atom.tag[j], atom.x[i][0], atom.x[i][1],
                         atom.x[i][2]));
  }

  [[gnu::noinline, gnu::cold]] void tell_observers(const Pass pass, SurfacesIntersectData contact,
                                                   ForceData on_i, ForceData on_j)
  {
    PairGran* const pair = pass.pair;
    const int i = contact.i, j = contact.j, nlocal = lmp_->atom->nlocal;
    const bool newton = pass.newton;
    const double* force = on_i.delta_F;
    if (contact.computeflag && pair->store_sum_normal_force()) {
      const double normal = force[0] * contact.en[0] + force[1] * contact.en[1] + force[2] * contact.en[2];
      *pair->get_sum_normal_force_ptr(i) += normal;
      if (newton || j < nlocal) *pair->get_sum_normal_force_ptr(j) += normal;
    }
    if (pair->cpl() && pass.addflag) pair->cpl_add_pair(contact, on_i);
    if (pair->evflag) {  // not contact.delta, in which the narrow phase leaves the overlap
      const double *xi = lmp_->atom->x[i], *xj = lmp_->atom->x[j];
      pair->ev_tally_xyz(i, j, nlocal, newton, 0.0, 0.0, force[0], force[1], force[2], xi[0] - xj[0],
                         xi[1] - xj[1], xi[2] - xj[2]);
    }
    if (pair->storeContactForces() && lmp_->update->ntimestep % pair->storeContactForcesEvery() == 0) {
      store_force(*pair->fix_contact_forces(), i, j, on_i);
      store_force(*pair->fix_contact_forces(), j, i, on_j);
    }
    if (pair->storeContactForcesStress()) {
      store_partner(*pair->fix_contact_forces_stress(), i, j, on_i);
      store_partner(*pair->fix_contact_forces_stress(), j, i, on_j);
    }
  }

  /// Row of fix contactproperty/atom, in its layout: force and torque; force and the partner's index.
  void store_force(LAMMPS_NS::FixContactPropertyAtom& fix, int i, int j, const ForceData& on_i) const
  {
    const int tag = lmp_->atom->tag[j];
    if (fix.has_partner(i, tag) != -1) return;
    double values[6];
    for (int c = 0; c < 3; ++c) values[c] = on_i.delta_F[c], values[3 + c] = on_i.delta_torque[c];
    fix.add_partner(i, tag, values);
  }
  void store_partner(LAMMPS_NS::FixContactPropertyAtom& fix, int i, int j, const ForceData& on_i) const
  {
    const int tag = lmp_->atom->tag[j];
    if (fix.has_partner(i, tag) != -1) return;
    double values[4] = {on_i.delta_F[0], on_i.delta_F[1], on_i.delta_F[2], static_cast<double>(j)};
    fix.add_partner(i, tag, values);
  }

  /// After fix insert/stream/predefined inserted particles that touch already, with their histories.
  void copy_predefined_histories(PairGran* pair) const
  {
    const char* style = "insert/stream/predefined";
    for (int k = 0; k < lmp_->modify->n_fixes_style(style); ++k) {
      auto* fix = static_cast<LAMMPS_NS::FixInsertStreamPredefined*>(lmp_->modify->find_fix_style(style, k));
      if (!fix->has_inserted()) continue;
      const LAMMPS_NS::NeighList& list = *pair->list;
      for (int ii = 0; ii < list.inum; ++ii) {
        const int i = list.ilist[ii];
        for (int jj = 0; jj < list.numneigh[i]; ++jj)
          fix->copy_history(i, list.firstneigh[i][jj] & NEIGHMASK,
                            &pair->listgranhistory->firstdouble[i][pair->dnum() * jj]);
      }
    }
  }

  LAMMPS* lmp_;
  ContactModel model_;
  const Bodies* bodies_ = nullptr;
  Confinement* const* confinement_ = nullptr;
  std::vector<Candidate> candidates_;  // of walk(); kept for its memory
};

}  // namespace granulaw::plugin
