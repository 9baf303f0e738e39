#pragma once

#include "solver/contact/contact.hpp"

namespace granulaw {

/// Surface of the first body in three dimensions against that of a second, with Coulomb friction. The second
/// body has its own frame, mirrored in z: the gap is the sum of both heights.
///
/// Markers of the second body in one half cell along x and y are joined to one point, the mean of their
/// patches. These points are the corners of a net, which is bilinear in each mesh. A marker's impulse goes to
/// the four corners of its mesh by the same weights. So momentum is conserved and, up to the gap, angular
/// momentum. The net bears any pressure as its patches would: single markers that are small would be
/// overloaded.
class Facing : public Side
{
 public:
  /// `apart`: of the origins of both frames, along z.
  Facing(std::span<const Body> bodies, double apart, double friction);
  int add_rows(std::span<Body> bodies, const RowNodes* nodes, double kick, double dt, double recovery,
               ContactRow* rows) override;
  std::size_t most_rows() const override { return facing_.size(); }
  double finish(std::span<const Body> bodies, std::span<const ContactRow> rows, double dt) override;
  /// Radius of the disc with the second moment of the patches that push: others between them bear nothing.
  double edge_radius(std::span<const Body> bodies) const override;
  void visit_state(StateArchive& archive) override;

 private:
  struct Corner
  {
    std::vector<int> node;
    std::vector<double> weight;
    Vector3 place = Vector3::Zero();  ///< of the undeformed body
    double area = 0;
    Vector3 now, velocity;
  };
  /// Nodes of the four corners, and their weights for each.
  struct Mesh
  {
    std::vector<int> offset;
    std::array<std::vector<double>, 4> weight;
  };
  /// Place on the second surface: the mesh, and where in it, 0 to 1.
  struct Across
  {
    int mesh;
    double s, t;
    std::array<double, 4> weights() const { return {(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t}; }
  };

  /// A place of the net and its tangents, in the second body's frame.
  struct Patch
  {
    Vector3 now, along_s, along_t;
  };

  void make_corners(const Body& far);
  void make_meshes();
  int corner(int mesh, int k) const { return mesh + k % 2 + k / 2 * along_x_; }
  void move_corners(const Body& far);
  bool find(const Vector3& place, Across& across) const;
  Patch patch(const Across& at) const;
  Stencil far_stencil(const Across& across, double* weight) const;

  double apart_, friction_;
  int along_x_ = 0;  // corners
  std::array<bool, 3> mirrored_;
  std::vector<Corner> corners_;  // [y][x]; without area where the second body has none
  std::vector<Mesh> meshes_;     // by their lowest corner; no nodes where a corner lacks
  std::vector<int> facing_;      // markers of the first body
  std::vector<int> mesh_;        // by marker in facing_: where it was last
  std::array<int, cell_nodes> offsets_;
  std::size_t room_ = 0;  // nodes of the largest mesh
  AlignedVector<double> impulse_;
  std::vector<double> far_weight_;
};

}  // namespace granulaw
