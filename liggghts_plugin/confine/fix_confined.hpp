#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "contact/confined.hpp"
#include "liggghts_plugin/confine/confinement.hpp"
#include "liggghts_plugin/confine/wall_planes.hpp"
#include "liggghts_plugin/deck/session.hpp"
#include "neigh_list.h"

namespace granulaw::plugin {

/// `fix granulaw_confined all granulaw/confined`: each particle of this rank with all of its contacts, neighbours and walls alike
/// (mpm_core/contact/confined.hpp). A contact of two particles is two halves: the owner of each puts half of its force on its own
/// particle, and the opposite on the neighbour. Halves on ghosts reach their owner by one reverse sum of six columns.
///
/// `confinement auto`: only a particle that is pressed has all of its contacts here (look()). A neighbour that is not has its side of
/// that one contact alone, and follows the pair law there.
///
/// Global vector: 1 confined particles, 2 particles whose cell is closed, 3 largest radius of a bulged sphere over its own, 4 contacts
/// with a force, 5 those of them beyond the sum of the radii, 6 contacts with a force that left the neighbour lists so far, 7 particles
/// whose contacts are all here.
/// Per atom, in the deck's units: 1 mean pressure, 2 area of its contacts, 3 share of its surface that is free, 4 plastic work.
class FixConfined final : public LAMMPS_NS::Fix, public Confinement
{
 public:
  static constexpr const char* style_name = "granulaw/confined";

  FixConfined(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);
  ~FixConfined() override;

  /// In a plan it only has the values that a deck may name.
  int setmask() override { return is_planning ? 0 : LAMMPS_NS::FixConst::END_OF_STEP | LAMMPS_NS::FixConst::PRE_EXCHANGE; }
  void init() override;
  void setup_pre_exchange() override { reserve_exchange(); }
  void pre_exchange() override;
  void setup(int) override
  {
    if (!is_planning) write_rows();
  }
  void end_of_step() override
  {
    if (takes_some) write_rows();
  }
  double compute_vector(int n) override;

  /// Before LIGGGHTS chooses its cells and ghosts for a run: they reach as far as bulged particles do. Collective.
  void widen_lists();
  void choose(PairGran& pair) override;
  void compute(PairGran& pair, const Observer* observer) override;
  AtWall at_wall(const FixWallGran& wall, const ContactData& contact, const double* wall_velocity, int mesh, int triangle, ForceData& on_i) override;

  void grow_arrays(int nmax) override;
  void copy_arrays(int from, int to, int) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double* buffer) override { return pack(particles_[static_cast<std::size_t>(i)], buffer); }
  int unpack_exchange(int i, double* buffer) override { return unpack(i, buffer); }
  int pack_restart(int i, double* buffer) override;
  void unpack_restart(int i, int nth) override;
  int size_restart(int i) override { return record_size(particles_[static_cast<std::size_t>(i)]) + 1; }
  int maxsize_restart() override { return largest_record() + 1; }
  int pack_comm(int n, int* list, double* buffer, int, int*) override;
  void unpack_comm(int n, int first, double* buffer) override;
  int pack_reverse_comm(int n, int first, double* buffer) override;
  void unpack_reverse_comm(int n, int* list, double* buffer) override;

 private:
  /// Half of a contact that acts on its particle, and what it does to the neighbour.
  struct Half
  {
    Vector force{};  // N, on the particle
    Vector turn{};   // N, n x T: torque over the arm, on either
    double arm = 0;  // m, from the particle's centre to the contact
  };
  /// A side's neighbour as this rank has it; follows from the rest. Small: a step reads those of all particles.
  struct Link
  {
    int partner = -1;  // index of the neighbour; of a wall: its triangle
    int slot = -1;     // place of the pair in the neighbour list; of a wall: its type
  };
  /// A wall as its loop found it in this step.
  struct Wall
  {
    bool seen = false;
    double distance = 0;
    Vector normal{}, velocity{};
  };
  /// A side in the step of its particle.
  struct Contact
  {
    Vector normal;    // outward
    double distance;  // of the centres, or to the wall
    double way = 0;   // m, of the plane between two particles
    double before;    // force before the step, over Y R^2
  };
  struct Particle
  {
    ConfinedParticle law;
    std::vector<Link> links;   // of law.sides
    std::vector<Wall> walls;   // of the first sides: keys of walls are negative
    std::vector<Half> halves;  // of law.sides, of a step with walls, or as find_halves() left them
    double reach = 1;          // grown radius that others have
    double area = 0;           // of all faces, over R^2
    int number = 0;            // the particle's, when its sides were named
    bool pressed = false;      // all of its contacts are sides
    bool restored = true;      // the law's caches follow from its state
  };
  /// A pair's or wall's own contacts, from which a particle is seen to be pressed.
  struct Load
  {
    double overlaps = 0;  // sum, over the radius
    int contacts = 0;
  };
  /// What ghosts get: reach_ and pressed_; of each side its full force and stiffness, or its half. Sides go in parts, so that the buffers are small.
  enum class Sent { reach, planes, halves };
  /// Steps from one move of the planes between particles to the next: 20 to 100 agree within 1 %. As often look() looks.
  static constexpr int planes_every = 20;
  static constexpr int sides_a_part = 12, name_columns = 4, most_columns = name_columns + 7, largest_row = 1 + sides_a_part * most_columns;

  static int record_size(const Particle& particle);
  int largest_record() const;
  void reserve_exchange() const;
  int pack(Particle& particle, double* buffer) const;
  int unpack(int i, const double* buffer);

  /// Sum of a particle's overlaps, over R, from which it is pressed: the pressure of its contacts is no larger than that says.
  static double pressing_overlaps(const PlasticBody& body);
  void check_material(int type, const BodyLaw* body);
  void find_walls();
  void follow_numbers();
  /// Particles that begin to be pressed, or end. Collective. Number of them.
  int look(const LAMMPS_NS::NeighList& list);
  void mark_pressed();
  /// Contacts of pressed particles that the pair loop has.
  void take_over(PairGran& pair);
  /// A contact that its loop had. `shear`: on the particle, the side's part.
  int take_side(int i, std::int64_t key, const Link& link, const Vector& normal, double distance, double overlap, double deepest, const Vector& shear,
                double stored);
  /// Sides that no pressed particle has.
  void drop_sides();
  /// After lists were made anew: the neighbour of each side.
  void renew(const LAMMPS_NS::NeighList& list);
  void check_reach() const;
  /// Collective.
  void send(Sent what);
  void write_sides(int i);
  /// What was sent of the side of particle or ghost `i` that has this key and normal, behind its name; null: nothing.
  const double* sent_side(int i, std::int64_t key, const Vector& normal) const;
  void collect(const LAMMPS_NS::NeighList& list);
  void collect_walls();
  void add_side(int i, int j, int slot, const Vector& normal, double distance);
  void remove_side(Particle& particle, int q, bool is_lost);
  void step(int i, bool moves_planes, bool keeps_halves);
  bool follow(int i, int q, bool moves_planes);
  /// Adds to `work` what the tangential force took, J.
  Half half_of(int i, int q, const Contact& contact, const SideAnswer& answer, double& work);
  void add_to(int i, const Vector& force, const Vector& turn, double arm);
  /// Halves of contacts between particles as they are.
  void find_halves(int i);
  void observe(PairGran& pair, const Observer& observer);
  void write_rows();

  Particle& particle(int i) { return particles_[static_cast<std::size_t>(i)]; }
  const Particle& particle(int i) const { return particles_[static_cast<std::size_t>(i)]; }
  const PlasticBody& body(int i) const { return *bodies_[static_cast<std::size_t>(atom->type[i])]; }
  double yield(int i) const { return yield_[static_cast<std::size_t>(atom->type[i])]; }
  /// N: Y R^2.
  double force_unit(int i) const { return yield(i) * atom->radius[i] * atom->radius[i]; }
  /// m, where the middle between two bulged spheres is touched by both, or the wall by one.
  double grown(int i) const { return reach_[static_cast<std::size_t>(i)]; }

  std::shared_ptr<Session> session_;
  std::vector<std::unique_ptr<PlasticBody>> bodies_;  // by type; null: no particle has it
  std::string only_material_;  // of all particles
  std::vector<double> yield_;                         // by type, deck's unit
  std::vector<double> pressing_overlaps_;             // by type
  std::vector<ContactStatistics::Pair*> counts_;      // by type
  const double* const* friction_ = nullptr;           // by types; null: none
  std::map<const FixWallGran*, WallPlanes> walls_;
  bool walls_known_ = false, links_known_ = false, seeks_ = false, widens_ = false;
  std::vector<Particle> particles_;
  std::vector<Load> loads_;           // in look()
  std::vector<char> pressed_;         // of particles and ghosts
  std::vector<double> reach_;         // of particles and ghosts, m: radius times Particle::reach
  std::vector<double> ghost_halves_;  // force and torque on each ghost
  std::vector<char> taken_;           // of each slot of the neighbour list: all owners have the side
  std::vector<double> sent_;          // of each particle and ghost: number of its sides, and columns_ numbers of each
  std::vector<SideStep> steps_;
  std::vector<Contact> contacts_;  // of the particle at hand, as steps_
  ConfinedRoom room_;
  Sent sending_ = Sent::reach;
  int columns_ = 0, row_ = 0, part_ = 0;  // of sent_; the part on its way
  bool collecting_ = false, advances_ = false;
  bool begins_pressed_ = false;  // a side of the particle at hand begins with an overlap, which no motion has paid for
  double lost_ = 0;
  double** rows_ = nullptr;
};

}  // namespace granulaw::plugin
