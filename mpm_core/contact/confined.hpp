#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/cell_faces.hpp"
#include "contact/plastic_body.hpp"
#include "contact/vector.hpp"

// The law of a particle that is pressed from all sides: docs/theory/confined.md. Units of PlasticBody: lengths over the
// particle's radius R, forces over Y R^2, energies over Y R^3. Compression is positive, normals point out of the particle.
namespace granulaw {

/// One contact as its particle has it: a plane n.x <= 1 - overlap about the particle's centre. All zero in a new one.
/// Two like bodies share their overlap: each has half of its way, and the contact's force is the mean of both sides'.
struct SideState
{
  std::int64_t key = 0;   ///< of the neighbour, the caller's; sides are kept in the order of their keys
  double force = 0;       ///< of the spring, >= 0, without the pressure of a closed cell
  double stiffness = 0;   ///< of the spring; only grows
  double gap = 0;         ///< >= 0: way to where it touches again, where the force is 0
  double overlap = 0;     ///< 1 less the plane's distance from the centre; negative where only bulging reaches the plane
  double deepest = 0;     ///< largest overlap; of a particle that is not confined
  // of the last refresh: every cached number follows from these
  double cached_overlap = 0, cached_elastic = 0;  ///< the part of the overlap that an unloading gives back
  Vector cached_normal{};
  double cap = 0, cap_slope = 0;  ///< largest force that the face bears, and its slope by the overlap
  bool touched = false;           ///< it has had a force
  double sheared = 0;             ///< 6 (T/F)^2: what the tangential force takes of the largest force
  // the caller's: no law reads them
  double distance = 0;         ///< to the neighbour's centre or the wall, in the caller's unit
  Vector shear{};              ///< tangential force on this particle, of this half
  double shear_stiffness = 0;  ///< only grows
};

/// What a particle has beside its sides. As made: a sphere that nothing presses.
struct ConfinedState
{
  double grown_radius = 1;    ///< R_a, of the ball that the planes cut; bulging reaches so far
  double cell_volume = 0;     ///< of a closed cell, carried
  double share = 0;           ///< r, 0: every contact is by itself, the pair law; 1: confined. Never falls
  double dissipated = 0;      ///< plastic, of all sides
  double plastic_strain = 0;  ///< mean
  double flow_stress = 1;     ///< over Y, of the last refresh
  std::array<double, 6> strain{};  ///< mean elastic: xx yy zz yz xz xy, compression positive
  bool closed = false;        ///< no free surface is left
};

/// Every number of a state, for a record: visit(double&) in a fixed order. A key is below 2^53.
template <class Visit>
void visit_numbers(SideState& s, Visit&& visit)
{
  double key = static_cast<double>(s.key), touched = s.touched;
  visit(key);
  for (double* x : {&s.force, &s.stiffness, &s.gap, &s.overlap, &s.deepest, &s.cached_overlap, &s.cached_elastic, &s.cap, &s.cap_slope, &s.sheared, &s.distance, &s.shear_stiffness}) visit(*x);
  for (Vector* v : {&s.cached_normal, &s.shear})
    for (double& x : *v) visit(x);
  visit(touched);
  s.key = static_cast<std::int64_t>(key), s.touched = touched != 0.0;
}
template <class Visit>
void visit_numbers(ConfinedState& c, Visit&& visit)
{
  double closed = c.closed;
  for (double* x : {&c.grown_radius, &c.cell_volume, &c.share, &c.dissipated, &c.plastic_strain, &c.flow_stress}) visit(*x);
  for (double& x : c.strain) visit(x);
  visit(closed);
  c.closed = closed != 0.0;
}
inline constexpr int side_numbers = 20, confined_numbers = 13;

/// A side in a step. `advance`: by which its overlap grows.
struct SideStep
{
  Vector normal;
  double advance;
};
/// `force`: >= 0; `stiffness`: > 0, elastic; `flow`: plastic part of the advance, >= 0; `area`: of the face, over R^2.
struct SideAnswer
{
  double force = 0, stiffness = 0, flow = 0, area = 0;
};

/// A side as a pair law has it: its half of the energies.
struct SideOfPair
{
  double force;    ///< >= 0
  double stored;   ///< that it gives back; over 0 where there is a force
  double lost;     ///< plastic, so far
  double overlap;
  double gap = 0;  ///< >= 0: way to where it touches again, where the force is 0
};

/// Room that a step needs; one for each thread.
struct ConfinedRoom
{
  CellFaces faces;
  std::vector<Vector> normals;
  std::vector<double> heights, areas, trial, gaps, mode, plastic;
  struct Surface  // a yield surface that the trial forces are outside of
  {
    std::size_t side;
    double excess, own, common, rate;  // g, dg/dF of the own part, dg/dQ^2, of the multiplier
  };
  std::vector<Surface> outside;
  std::vector<SideAnswer> answers;
  double scaled = 0;  // by which forces far outside were scaled, over what is left
  std::vector<SideOfPair> of_pair;
};

/// One particle: its state, its sides in the order of their keys, and caches that follow from both.
class ConfinedParticle
{
 public:
  /// Mean pressure over Y at which a particle of two loaded sides or more begins to be confined, and at which it is.
  static constexpr double begins_at = 0.15, complete_at = 0.3;

  ConfinedState state;
  std::vector<SideState> sides;

  bool confined() const { return state.share > 0; }
  /// Position of the side of this key whose normal of the last refresh is within 70 degrees of `normal`; -1: there is none. Two
  /// images of one neighbour have one key.
  int find(std::int64_t key, const Vector& normal) const;
  /// Position of a new side. `overlap`: before the next step.
  int insert(std::int64_t key, const Vector& normal, double overlap);
  /// Position of a new side that the pair law had: its overlap and the largest one. Not of a particle that is confined.
  int take(const PlasticBody& body, std::int64_t key, const Vector& normal, double overlap, double deepest);
  /// Its elastic energy is booked as dissipated.
  void remove(int i);

  /// One step of all sides: `steps` in their order. Answers are in their order, too, and stay until the room's next use. A
  /// particle that is not confined answers by the pair law, to the bit; from begins_at on it is confined. `whole`: these are all of
  /// its contacts; else it is not.
  std::span<const SideAnswer> advance(const PlasticBody& body, std::span<const SideStep> steps, ConfinedRoom& room, bool whole = true);
  /// The answers of the state as it is: nothing advances.
  std::span<const SideAnswer> answers(ConfinedRoom& room) const;

  /// Ends the pair law: takes every side over, in order. Forces and the sum of the stored energies stay as they are.
  void confine(const PlasticBody& body, std::span<const SideOfPair> sides);

  /// Caches of the last refresh, after a record was read.
  void restore(const PlasticBody& body, ConfinedRoom& room);

  double stored(const PlasticBody& body) const;  ///< elastic: springs, mean strain, closed cell
  double pressure() const { return pressure_; }  ///< p, mean of sum F d/(3 V), of the last step
  double free_share() const { return free_share_; }

 private:
  struct Cache  // of a side, of the last refresh
  {
    double area, filter, lever;  // lever: d/V
    std::array<double, 6> dyad;  // n n, at a height d: d n n
  };
  std::span<const SideAnswer> advance_apart(const PlasticBody& body, std::span<const SideStep> steps, ConfinedRoom& room, bool whole);
  bool move(std::span<const SideStep> steps);
  void refresh(const PlasticBody& body, std::span<const SideStep> steps, ConfinedRoom& room);
  void grow(ConfinedRoom& room);
  void cut(bool grows, ConfinedRoom& room);
  void couple(const PlasticBody& body);
  void press_closed_cell(const PlasticBody& body, bool refreshed);
  void predict(const PlasticBody& body, std::span<const SideStep> steps, ConfinedRoom& room);
  double modes_of(ConfinedRoom& room);
  void flow(double mode, ConfinedRoom& room);
  void dissipate(const PlasticBody& body, double energy);

  std::vector<Cache> cache_;
  std::vector<double> coupling_;      // of the modes, lower triangle by rows
  std::array<double, 21> elastic_{};  // Cholesky factor of the mean strain's stiffness, its diagonal inverted
  double pressure_ = 0, free_share_ = 1, volume_ = 0, bulk_ = 0;
  bool fresh_ = false;
};

/// A side's tangential force after a step, on the particle, and what the step dissipates.
struct ShearAnswer
{
  Vector force{};
  double flow = 0, friction = 0;
};
/// Tangential spring of a side that flows with its normal force: T <- T/(1 + 6 k_t v/F), v the plastic part of the advance, cut at
/// friction times share F. It keeps T in `side.shear`. `slide`: of the particle's surface against the neighbour's, over R; `share`:
/// of the contact's force that is this side's, 1/2; 1: a wall.
inline ShearAnswer advance_shear(SideState& side, const SideAnswer& now, const Vector& normal, const Vector& slide, double friction, double share)
{
  constexpr double of_normal = 0.82;  // k_t over k_n: Mindlin at nu = .3
  constexpr double flow_ratio = 6.0;  // yield at F^2 + 6 T^2: docs/theory/confined.md
  ShearAnswer answer;
  const double force = share * now.force;
  const auto energy = [&](const Vector& t) { return side.shear_stiffness > 0 ? 0.5 * dot(t, t) / side.shear_stiffness : 0.0; };
  if (!(force > 0)) {
    answer.friction = energy(side.shear);
    side.shear = {}, side.sheared = 0;
    return answer;
  }
  const double held = energy(side.shear);
  side.shear_stiffness = std::max(side.shear_stiffness, of_normal * share * share * now.stiffness);
  answer.flow = held - energy(side.shear);  // stiffer at constant force
  const Vector in_face = sum(slide, normal, -dot(slide, normal));
  Vector t = sum(sum(side.shear, normal, -dot(side.shear, normal)), in_face, -side.shear_stiffness);
  if (now.flow > 0) {
    const double part = 1.0 / (1.0 + flow_ratio * side.shear_stiffness * (now.flow / share) / force);
    answer.flow += energy(t) * (1.0 - part * part);
    t = times(t, part);
  }
  if (const double size = norm(t), most = friction * force; size > most) {
    const double part = most / size;
    answer.friction = energy(t) * (1.0 - part * part);
    t = times(t, part);
  }
  side.shear = answer.force = t;
  side.sheared = flow_ratio * dot(t, t) / (force * force);
  return answer;
}

/// Way by which the plane between two bodies moves into A (and out of B), so that their forces become equal. Forces and elastic
/// stiffnesses in one unit, stiffnesses > 0. It only loses energy. Every 20 to 100 steps.
inline double plane_way(double force_a, double stiffness_a, double force_b, double stiffness_b) { return (force_b - force_a) / (stiffness_a + stiffness_b); }

}  // namespace granulaw
