#pragma once

#include "base/parallel.hpp"
#include "solver/contact/neighbours.hpp"
#include "solver/contact/touching.hpp"

namespace granulaw {

/// Two bodies that touch, or a body and a wall; sums since the last reset.
struct PairTally
{
  int near, far;                      ///< far < 0: wall -1 - far, in the order -x +x -y +y -z +z
  std::array<int, 3> image;           ///< the near body, moved by as many boxes, meets the far one
  Vector3 impulse = Vector3::Zero();  ///< on the near body
  double push = 0, slide = 0;         ///< normal and tangential impulses of the markers
  double area = 0;                    ///< of the near body's patches that were pushed, undeformed
  double distance = 0;                ///< of the centres, or of the centre and the wall, now
};

/// Contacts of many deformable spheres with each other and with the sides of a box, with Coulomb friction.
/// Rows are grouped by contact. Each contact is swept by itself, on copies of the velocities that follow from
/// the impulses of the last step. Then every body takes the changes, in the order of its contacts. So
/// contacts are independent, and the bits do not depend on the number of threads.
class PackingContact : public Contact
{
 public:
  /// `friction`: Coulomb's coefficient of all contacts. `cells`: of the grids, to a diameter.
  PackingContact(std::vector<Ball> balls, const PackingBox& box, double friction, int cells,
                 Parallel& threads);
  ~PackingContact() override;
  double correct(std::span<Body> bodies, double kick, double dt) override;
  void account(std::span<const Body> bodies) override;
  double edge_radius(std::span<const Body>) const override { return 0; }
  /// Of walls and of periodic images.
  double work() const override { return work_; }
  void visit_state(StateArchive& archive) override;

  const std::vector<Ball>& balls() const { return balls_; }

  /// Since the last reset: sum of impulse times branch vector, from the far centre (or the wall) to the near
  /// one. Over volume and time that is the stress, compression positive.
  const Eigen::Matrix3d& virial() const { return virial_; }
  /// Since the last reset: impulse of each wall on the bodies.
  const std::array<Vector3, 6>& wall_impulse() const { return wall_impulse_; }
  std::vector<PairTally> tallies(std::span<const Body> bodies) const;
  void reset_tallies();

  PackingBox box;  ///< moved by the programme

 private:
  struct Block;
  struct Scratch
  {
    AlignedVector<double> near, far, weights;
    std::vector<ContactRow> rows;
  };
  struct BodySide
  {
    int block;
    bool far;
  };

  void search(std::span<Body> bodies, double dt);
  void make_blocks(std::span<const Body> bodies);
  void list_sides();
  void add_rows(const Markers& surface, Block& block, Scratch& scratch, double kick, double dt) const;
  void add_impulses(bool changes);
  void sweep(Block& block, Scratch& scratch) const;
  void tally(const Body& near, Block& block) const;
  RowPlane plane_of(int wall) const;

  std::vector<Ball> balls_;
  double friction_;
  SweepRule rule_;
  double margin_;
  Parallel& threads_;
  std::vector<Outline> outlines_;
  std::vector<RowNodes> nodes_;
  std::vector<Block> blocks_;                 // in the order of their bodies
  std::vector<std::vector<BodySide>> sides_;  // by body
  std::vector<Scratch> scratch_;              // by thread
  int until_search_ = 0;
  double work_ = 0;
  Eigen::Matrix3d virial_ = Eigen::Matrix3d::Zero();
  std::array<Vector3, 6> wall_impulse_;
};

}  // namespace granulaw
