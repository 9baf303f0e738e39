#include "solver/contact/planes.hpp"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/state_archive.hpp"
#include "solver/contact/edge.hpp"
#include "solver/contact/scene.hpp"

namespace granulaw {

namespace {

/// Markers nearer to a plane than this many of the finest edges are looked at in every step.
constexpr double candidate_edges = 2;
/// Share of the gap three patches outside a contact below which a marker is in it: markers inside that push
/// in turns are open by 1 % of that gap at most.
constexpr double in_contact = 0.02;

std::array<double, 3> as_array(const Vector3& v)
{
  return {v[0], v[1], v[2]};
}

/// The same impulse on the mirrored bodies: components along the mirrors cancel where the plane crosses them.
void add_mirrored(const Body& body, const Plane& plane, PlaneTally& tally)
{
  for (int d = 0; d < 3; ++d)
    if (body.reference().mirrored[d] && std::abs(plane.normal[d]) < 1e-9) {
      tally.impulse[d] = 0, tally.centre[d] = 0;
      for (int e = 0; e < 3; ++e)
        if (e != d) tally.torque[e] = 0;
    }
  tally.impulse *= plane.copies, tally.torque *= plane.copies, tally.centre *= plane.copies;
}

/// A marker about a contact.
struct NearMarker
{
  double gap, area;
  Vector3 place;
};

/// Half axes of the ellipse with the second moments of the markers' patches, larger first.
std::array<double, 2> ellipse_of(const Body& body, const Plane& plane, std::span<const NearMarker> markers)
{
  double area = 0;
  Vector3 centre = Vector3::Zero();
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (const NearMarker& m : markers) {
    area += m.area, centre += m.area * m.place, moment += m.area * m.place * m.place.transpose();
  }
  if (!(area > 0)) return {0, 0};
  centre /= area, moment /= area;
  for (int d = 0; d < 3; ++d)
    if (body.reference().mirrored[d] && std::abs(plane.normal[d]) < 1e-9) {
      centre[d] = 0;
      for (int e = 0; e < 3; ++e)
        if (e != d) moment(d, e) = moment(e, d) = 0;
    }
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - plane.normal * plane.normal.transpose();
  moment = across * (moment - centre * centre.transpose()) * across;
  const Vector3 values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moment).eigenvalues();
  // of an ellipse the second moment along an axis is a quarter of its square
  return {2 * std::sqrt(std::max(0.0, values[2])), 2 * std::sqrt(std::max(0.0, values[1]))};
}

}  // namespace

Planes::Planes(const Body& body, const Vector3& centre, std::vector<Plane> planes)
    : planes_(std::move(planes)),
      centre_(centre),
      markers_(body.reference().surface.count),
      candidates_(planes_.size()),
      impulse_(4 * planes_.size() * static_cast<std::size_t>(markers_), 0.0),
      pushing_(planes_.size(), 0),
      acting_(planes_.size(), 0),
      in_this_step_(planes_.size(), 0),
      tallies_(planes_.size())
{
  for (int k = 0; k < cell_nodes; ++k) offsets_[k] = 4 * body.reference().surface.offset[k];
  for (std::vector<int>& list : candidates_) list.reserve(static_cast<std::size_t>(markers_));
}

Vector3 Planes::place(const Body& body, int marker) const
{
  const Markers& surface = body.reference().surface;
  const std::array<double, 3>& start = surface.place[marker];
  double u[4];
  row_kernels(body).carry(
      {}, body.u_i.values.data(),
      {0, cell_nodes, 4 * surface.lowest[marker], offsets_.data(), surface.weights(marker)}, u);
  return Vector3(start[0], start[1], start[2]) + vector_in(u);
}

void Planes::choose_candidates(const Body& body)
{
  room_ = candidate_edges * body.reference().surface.finest;
  for (std::vector<int>& list : candidates_) list.clear();
  for (int m = 0; m < markers_; ++m) {
    const Vector3 x = place(body, m);
    for (std::size_t k = 0; k < planes_.size(); ++k)
      if (planes_[k].normal.dot(x) - planes_[k].position < wider_ + room_) candidates_[k].push_back(m);
  }
}

int Planes::add_rows(std::span<Body> bodies, const RowNodes* nodes, double kick, double dt, double recovery,
                     ContactRow* rows)
{
  const Body& body = bodies.front();
  const RowKernels& kernels = row_kernels(body);
  double closing =
      std::sqrt(3.0) * kernels.largest(body.v_i.values.data(), static_cast<int>(body.v_i.values.size()));
  for (const Plane& plane : planes_) closing += std::abs(plane.velocity);
  room_ -= dt * closing;
  if (room_ < 0) choose_candidates(body), room_ -= dt * closing;
  const Markers& surface = body.reference().surface;
  int made = 0;
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    const Plane& plane = planes_[k];
    const RowPlane against{{plane.normal[0], plane.normal[1], plane.normal[2], 0.0},
                           plane.position,
                           plane.velocity,
                           plane.friction,
                           static_cast<int>(k),
                           surface.place.data(),
                           surface.lowest.data(),
                           offsets_.data(),
                           surface.weight.data(),
                           impulse(k, 0)};
    made += kernels.make(nodes, against, candidates_[k].data(), static_cast<int>(candidates_[k].size()), kick,
                         dt, recovery, rows + made);
  }
  return made;
}

double Planes::finish(std::span<const Body> bodies, std::span<const ContactRow> rows, double dt)
{
  std::fill(pushing_.begin(), pushing_.end(), 0);
  double first = 0;
  for (const ContactRow& row : rows) {
    const Plane& plane = planes_[row.plane];
    const Vector3 p = vector_in(row.impulse);
    const double normal = plane.normal.dot(p);
    if (normal <= 0) continue;
    pushing_[row.plane] = 1;
    if (row.plane == 0) first += plane.copies * normal;
    tally(row.plane, p, place(bodies.front(), row.marker));
  }
  std::swap(acting_, in_this_step_);
  std::fill(in_this_step_.begin(), in_this_step_.end(), 0);
  for (Plane& plane : planes_) plane.position += dt * plane.velocity;
  return first;
}

void Planes::tally(int plane, const Vector3& impulse, const Vector3& place)
{
  PlaneTally& tally = tallies_[plane];
  tally.impulse += impulse, tally.torque += place.cross(impulse), tally.centre += planes_[plane].normal.dot(impulse) * place;
  in_this_step_[plane] = 1;
}

void Planes::widen(const Body& body, double more)
{
  wider_ = more;
  choose_candidates(body);
}

std::array<double, 2> Planes::contact_axes(const Body& body, int k) const
{
  if (!pushing_[k]) return {0, 0};
  std::vector<NearMarker> near;
  double closed = 0;
  for (const int m : candidates_[k]) {
    const Vector3 x = place(body, m);
    const bool pushed =
        planes_[k].normal.dot(vector_in(impulse_.data() + 4 * (std::size_t(k) * markers_ + m))) > 0;
    near.push_back({pushed ? 0.0 : std::max(0.0, planes_[k].normal.dot(x) - planes_[k].position),
                    body.reference().surface.area[m], x});
    if (pushed) closed += body.reference().surface.area[m];
  }
  std::sort(near.begin(), near.end(), [](const NearMarker& a, const NearMarker& b) { return a.gap < b.gap; });
  const auto upto = [&](double area) {
    std::size_t count = 0;
    for (double sum = 0; count < near.size() && sum < area; ++count) sum += near[count].area;
    return count;
  };
  // width of a patch over the radius of the contact
  const double patch = std::sqrt(closed / static_cast<double>(upto(closed)));
  const double ring = patch / std::sqrt(closed * planes_[k].copies / M_PI);
  const auto wider = [&](double rings) { return upto(closed * (1 + rings * ring) * (1 + rings * ring)); };
  // markers that do not push just now, but are far nearer than those outside, are in contact
  const double outside = near[std::min(wider(3), near.size()) - 1].gap;
  closed = 0;
  for (const NearMarker& m : near)
    if (m.gap <= in_contact * outside) closed += m.area;
  const std::size_t first = wider(1), second = wider(2);
  const std::array<double, 2> inner = ellipse_of(body, planes_[k], {near.data(), upto(closed)});
  if (second >= near.size() || first == 0) return inner;
  const std::array<double, 2> next = ellipse_of(body, planes_[k], {near.data(), first}),
                              outer = ellipse_of(body, planes_[k], {near.data(), second});
  std::array<double, 2> axes{};
  for (int d = 0; d < 2; ++d)
    axes[d] = edge_between(inner[d], {next[d], near[first - 1].gap}, {outer[d], near[second - 1].gap});
  return axes;
}

double Planes::edge_radius(std::span<const Body> bodies) const
{
  const std::array<double, 2> axes = contact_axes(bodies.front(), 0);
  return std::sqrt(axes[0] * axes[1]);
}

void Planes::visit_state(StateArchive& a)
{
  a.value(room_);
  const auto visit = [&](Vector3& v) {
    for (int d = 0; d < 3; ++d) a.value(v[d]);
  };
  for (Plane& plane : planes_) a.value(plane.position), a.value(plane.velocity);
  a.values(impulse_);
  for (PlaneTally& t : tallies_) visit(t.impulse), visit(t.torque), visit(t.centre);
  for (std::vector<int>& list : candidates_) a.growing(list);
}

void Planes::end_sample(std::span<const Body> bodies, double time, std::vector<PlaneTrace>& traces)
{
  const Body& body = bodies.front();
  const Vector3 now = centre_ + travel_of(body);
  std::vector<PlaneTally> tallies(planes_.size());
  std::swap(tallies, tallies_);
  traces.resize(tallies.size());
  for (std::size_t k = 0; k < tallies.size(); ++k) {
    const Plane& plane = planes_[k];
    PlaneTally& tally = tallies[k];
    add_mirrored(body, plane, tally);
    const double push = plane.normal.dot(tally.impulse);
    const Vector3 torque = tally.torque - now.cross(tally.impulse);
    const Vector3 arm = push > 0 ? Vector3(tally.centre / push - now) : Vector3(Vector3::Zero());
    traces[k].normal = as_array(plane.normal);
    traces[k].samples.push_back({plane.position - plane.start, push / time, as_array(tally.impulse / time),
                                 as_array(torque / time), as_array(arm),
                                 contact_axes(body, static_cast<int>(k))});
  }
}

void Scene::meet(std::unique_ptr<Side> side, std::unique_ptr<Pull> pull)
{
  contact = std::make_unique<RowContact>(std::move(side), sweeps_in_three_dimensions, std::move(pull));
}

void Scene::meet(std::unique_ptr<Planes> side, std::unique_ptr<Pull> pull)
{
  planes = side.get();
  meet(std::unique_ptr<Side>(std::move(side)), std::move(pull));
}

}  // namespace granulaw
