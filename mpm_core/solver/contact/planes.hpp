#pragma once

#include <vector>

#include "solver/contact/contact.hpp"

namespace granulaw {

/// A rigid plane; the body lies where normal.x > position.
struct Plane
{
  Vector3 normal;  ///< unit vector away from the plane, into the body
  double position;
  double start = position;  ///< where it stood at first
  double velocity = 0;      ///< of the plane along its normal
  double friction = 0;      ///< Coulomb's coefficient
  /// Planes that the mirrored parts of the body meet where this part meets this one, itself included.
  int copies = 1;
};

/// Work and momentum of a plane since the last read, for the computed part of the body.
struct PlaneTally
{
  Vector3 impulse = Vector3::Zero();  ///< on the body
  Vector3 torque = Vector3::Zero();   ///< angular impulse about the origin
  Vector3 centre = Vector3::Zero();   ///< sum of normal impulse times place
};

/// The surface of one body against rigid planes with Coulomb friction.
class Planes : public Side
{
 public:
  /// `centre`: of mass, at rest.
  Planes(const Body& body, const Vector3& centre, std::vector<Plane> planes);

  int add_rows(std::span<Body> bodies, const RowNodes* nodes, double kick, double dt, double recovery,
               ContactRow* rows) override;
  std::size_t most_rows() const override { return planes_.size() * static_cast<std::size_t>(markers_); }
  double finish(std::span<const Body> bodies, std::span<const ContactRow> rows, double dt) override;
  /// Radius at the first plane: root of the product of contact_axes().
  double edge_radius(std::span<const Body> bodies) const override;
  void end_sample(std::span<const Body> bodies, double time, std::vector<PlaneTrace>& planes) override;
  void visit_state(StateArchive& archive) override;

  std::vector<Plane>& planes() { return planes_; }
  const std::vector<Plane>& planes() const { return planes_; }
  /// Markers that might come within `more` of a plane soon are candidates, too. Before the first step.
  void widen(const Body& body, double more);
  const std::vector<int>& candidates(std::size_t plane) const { return candidates_[plane]; }
  Vector3 place(const Body& body, int marker) const;
  /// Adds an impulse on the body at a place to what the plane has done in this step.
  void tally(int plane, const Vector3& impulse, const Vector3& place);
  /// True if a plane pushed or pulled in the last step.
  bool acts(int plane) const { return acting_[plane]; }
  /// Half axes of the contact with a plane, larger first; 0, 0 without contact. Where the gap ends that opens
  /// behind the edge: between the ellipses of the markers in contact, and with one and two rings of patches
  /// more, by edge_between().
  std::array<double, 2> contact_axes(const Body& body, int plane) const;

 private:
  void choose_candidates(const Body& body);
  double* impulse(std::size_t plane, int marker) { return impulse_.data() + 4 * (plane * markers_ + marker); }

  std::vector<Plane> planes_;
  Vector3 centre_;
  int markers_;
  std::array<int, cell_nodes> offsets_;       // entries from a cell's lowest node to each of its nodes
  std::vector<std::vector<int>> candidates_;  // by plane: markers that might reach it soon
  double room_ = 0;                           // way that markers may go before candidates are chosen anew
  double wider_ = 0;                          // gap up to which markers are candidates at any time
  AlignedVector<double> impulse_;             // [plane][marker][4], of the last step
  std::vector<char> pushing_, acting_, in_this_step_;
  std::vector<PlaneTally> tallies_;
};

}  // namespace granulaw
