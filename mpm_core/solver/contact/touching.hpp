#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "solver/contact/contact.hpp"
#include "solver/contact/inverse_motion.hpp"

namespace granulaw {

/// A deformable sphere as others touch it: at rest the place X of its reference lies at turn X + start.
struct Ball
{
  std::shared_ptr<const SphereGridTables> tables;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vector3 start = Vector3::Zero();

  const SphereGrid& grid() const { return tables->grid(); }
  /// Centre of mass now.
  Vector3 centre(const Body& body) const { return start + travel_of(body); }
};

/// Where a body's markers are, as a search needs them.
struct Outline
{
  std::vector<Vector3> place;  ///< of each marker
  Vector3 centre, velocity;    ///< of the centre of mass
  double reach = 0;            ///< of the farthest marker from the centre
  double own_speed = 0;        ///< of the fastest marker relative to the centre

  void draw(const Body& body, const Ball& ball);
};

/// One contact of two deformable spheres in three dimensions: markers of the near body against the surface of
/// the far one. A marker's image is the place of the far body's reference that has moved to the marker, by
/// one of Newton's steps from that of the last step. Distance and normal of the reference sphere there,
/// carried on by F, are the gap and the normal. The impulse acts on the marker's nodes and on those of its
/// image, which are one place: momentum is conserved, and angular momentum up to the gap.
class Touching
{
 public:
  /// Places of both bodies in the list of their nodes. A place x of the near body is signs (x + shift) for
  /// the far one.
  Touching(int near, int far, const Vector3& signs) : near_(near), far_(far), signs_(signs) {}

  /// Finds the markers within `margin` of the far body.
  void search(Body& far_body, const Ball& far_ball, const Outline& near, const Outline& far, double margin);
  /// `nodes`: of both bodies. There must be room for size() rows, and for cell_nodes weights of each.
  int add_rows(const Markers& surface, const Ball& near, const Ball& far, const RowNodes* nodes,
               double friction, double kick, double dt, double recovery, ContactRow* rows,
               double* far_weights);
  void visit_state(StateArchive& archive);

  int near() const { return near_; }
  int far() const { return far_; }
  std::size_t size() const { return markers_.size(); }
  void reserve(std::size_t count) { markers_.reserve(count), found_.reserve(count); }
  std::span<FacingMarker> markers() { return markers_; }
  std::span<const FacingMarker> markers() const { return markers_; }
  /// Speed at which a gap closed at the last search, at most, about.
  double closing() const { return closing_; }

  Vector3 shift = Vector3::Zero(), drift = Vector3::Zero();  ///< drift: rate of the shift

 private:
  int near_, far_;
  Vector3 signs_;
  double closing_ = 0;
  std::vector<FacingMarker> markers_, found_;  // ascending
};

/// Markers nearer than this share of the smaller radius are looked at between searches.
inline constexpr double candidate_share = 0.08;

/// Steps from a search to the next, before which no marker beyond `margin` arrives.
int steps_between_searches(double margin, double closing, double dt);

/// Two spheres that meet at their lowest points, each in its own frame, that of the second mirrored in z.
/// Rows are those of the body with the finer cells.
class TwoSpheres : public Side
{
 public:
  /// `apart`: of the origins of both frames, along z.
  TwoSpheres(std::span<const Body> bodies, const std::array<double, 2>& radii, double apart, double friction);
  int add_rows(std::span<Body> bodies, const RowNodes* nodes, double kick, double dt, double recovery,
               ContactRow* rows) override;
  std::size_t most_rows() const override { return most_; }
  double finish(std::span<const Body> bodies, std::span<const ContactRow> rows, double dt) override;
  /// Radius of the disc with the second moment of the patches that push: others between them bear nothing.
  double edge_radius(std::span<const Body> bodies) const override;
  void visit_state(StateArchive& archive) override;

 private:
  std::array<Ball, 2> balls_;
  std::array<Outline, 2> outlines_;
  Touching touching_;
  double friction_, margin_;
  std::size_t most_;
  int until_search_ = 0;
  std::vector<double> far_weights_;
};

}  // namespace granulaw
