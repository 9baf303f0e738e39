#include "solver/contact/touching.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"

namespace granulaw {

namespace {

/// Gaps up to this share of a cell's edge make rows.
constexpr double open_share = 0.002;
/// Newton's steps of a search: from the rigid motion, and from a known image.
constexpr int steps_from_afar = 8, steps_from_near = 2;
/// An image is found if its last step began at less than this from the marker, in radii.
constexpr double found_within = 1e-2;
/// No marker gets deeper than this, in radii: the image is that of the far side.
constexpr double deepest = 0.6;
/// Steps between two searches, at most.
constexpr double longest_pause = 10;

Vector3 at_rest(const Markers& surface, int m)
{
  return {surface.place[m][0], surface.place[m][1], surface.place[m][2]};
}

}  // namespace

void Outline::draw(const Body& body, const Ball& ball)
{
  const Markers& surface = body.reference().surface;
  place.resize(std::size_t(surface.count));
  centre = ball.centre(body), velocity = mean_velocity(body);
  reach = own_speed = 0;
  const RowKernels& kernels = row_kernels(true);
  for (int m = 0; m < surface.count; ++m) {
    const Stencil marker{0, cell_nodes, 4 * surface.lowest[m], ball.grid().offset, surface.weights(m)};
    double u[4], v[4];
    kernels.carry({}, body.u_i.values.data(), marker, u);
    place[m] = at_rest(surface, m) + vector_in(u);
    reach = std::max(reach, (place[m] - centre).squaredNorm());
    if (m % 3) continue;  // about
    kernels.carry({}, body.v_i.values.data(), marker, v);
    own_speed = std::max(own_speed, (vector_in(v) - velocity).squaredNorm());
  }
  reach = std::sqrt(reach), own_speed = std::sqrt(own_speed);
}

int steps_between_searches(double margin, double closing, double dt)
{
  return static_cast<int>(std::clamp(margin / (1.5 * closing * dt + 1e-12), 1.0, longest_pause));
}

void Touching::search(Body& body, const Ball& ball, const Outline& near, const Outline& far, double margin)
{
  const RowKernels& kernels = row_kernels(true);
  const RowNodes nodes = nodes_of(body);
  const double around = (far.reach + margin) * (far.reach + margin), radius = ball.grid().radius;
  closing_ =
      (near.velocity + drift - signs_.cwiseProduct(far.velocity)).norm() + near.own_speed + far.own_speed;
  found_.clear();
  std::size_t known = 0;
  for (int m = 0; m < static_cast<int>(near.place.size()); ++m) {
    while (known < markers_.size() && markers_[known].marker < m) ++known;
    const Vector3 x = signs_.cwiseProduct(near.place[m] + shift);
    if ((x - far.centre).squaredNorm() > around) continue;
    const bool again = known < markers_.size() && markers_[known].marker == m;
    FacingMarker marker = again ? markers_[known] : FacingMarker{};
    if (!again) Eigen::Map<Vector3>(marker.image) = ball.turn.transpose() * (x - far.centre);
    marker.marker = m, marker.sleep = 0;
    alignas(32) const double place[4] = {x[0], x[1], x[2], 0};
    alignas(32) double normal[4], image[4];
    std::copy_n(marker.image, 4, image);
    double gap, left;
    const bool converges =
        kernels.invert(nodes, ball.grid(), place, again ? steps_from_near : steps_from_afar, 4 * margin,
                       image, normal, &gap, &left);
    const bool found = converges && (left < found_within * radius || gap > margin) && gap > -deepest * radius;
    if (found ? gap >= margin : !again) continue;
    if (found) {
      std::copy_n(image, 4, marker.image);
      for (int d = 0; d < 3; ++d) marker.normal[d] = signs_[d] * normal[d];
    }
    found_.push_back(marker);  // one that is known keeps its plane if its image is lost
  }
  markers_.swap(found_);
}

int Touching::add_rows(const Markers& surface, const Ball& near, const Ball& far, const RowNodes* nodes,
                       double friction, double kick, double dt, double recovery, ContactRow* rows,
                       double* far_weights)
{
  FacingSurface s{};
  for (int d = 0; d < 3; ++d) s.signs[d] = signs_[d], s.shift[d] = shift[d], s.drift[d] = drift[d];
  s.near_body = near_, s.far_body = far_;
  s.near = &near.grid(), s.far = &far.grid();
  s.place = surface.place.data(), s.node = surface.lowest.data(), s.weight = surface.weight.data();
  s.friction = friction, s.open = open_share * surface.finest, s.closing = closing_;
  return row_kernels(true).face(nodes, s, markers_.data(), static_cast<int>(size()), kick, dt, recovery, rows,
                                far_weights);
}

void Touching::visit_state(StateArchive& a)
{
  a.growing(markers_), a.value(closing_);
}

TwoSpheres::TwoSpheres(std::span<const Body> bodies, const std::array<double, 2>& radii, double apart,
                       double friction)
    : touching_(0, 1, {1, 1, -1}),
      friction_(friction),
      margin_(candidate_share * std::min(radii[0], radii[1]))
{
  for (int b = 0; b < 2; ++b)
    balls_[b].tables = std::make_shared<SphereGridTables>(bodies[b].reference(), radii[b]);
  const int finer = bodies[1].reference().surface.finest < bodies[0].reference().surface.finest ? 1 : 0;
  touching_ = Touching(finer, 1 - finer, {1, 1, -1});
  touching_.shift = {0, 0, apart};
  most_ = static_cast<std::size_t>(bodies[finer].reference().surface.count);
  touching_.reserve(most_);
  far_weights_.resize(cell_nodes * most_);
}

int TwoSpheres::add_rows(std::span<Body> bodies, const RowNodes* nodes, double kick, double dt,
                         double recovery, ContactRow* rows)
{
  if (until_search_-- <= 0) {
    for (int b = 0; b < 2; ++b) outlines_[b].draw(bodies[b], balls_[b]);
    const int near = touching_.near(), far = touching_.far();
    touching_.search(bodies[far], balls_[far], outlines_[near], outlines_[far], margin_);
    until_search_ = steps_between_searches(margin_, touching_.closing(), dt) - 1;
  }
  const int near = touching_.near();
  return touching_.add_rows(bodies[near].reference().surface, balls_[near], balls_[touching_.far()], nodes,
                            friction_, kick, dt, recovery, rows, far_weights_.data());
}

double TwoSpheres::finish(std::span<const Body> bodies, std::span<const ContactRow> rows, double)
{
  double total = 0;
  for (const ContactRow& row : rows) total += row.impulse[2];
  return bodies[0].reference().copies() * total;
}

double TwoSpheres::edge_radius(std::span<const Body> bodies) const
{
  const Reference& reference = bodies[touching_.near()].reference();
  double area = 0, along = 0, square = 0;
  for (const FacingMarker& marker : touching_.markers()) {
    if (!(marker.impulse[2] > 0)) continue;
    const double a = reference.surface.area[marker.marker];
    const Vector3 x = at_rest(reference.surface, marker.marker);
    area += a, along += a * x[0], square += a * (x[0] * x[0] + x[1] * x[1]);
  }
  if (!(area > 0)) return 0;
  const double middle = reference.mirrored[0] ? 0 : along / area;
  return std::sqrt(2 * (square / area - middle * middle));
}

void TwoSpheres::visit_state(StateArchive& a)
{
  touching_.visit_state(a), a.value(until_search_);
}

}  // namespace granulaw
