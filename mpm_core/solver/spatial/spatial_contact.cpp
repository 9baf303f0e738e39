#include "solver/spatial/spatial_contact.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "solver/output/state_archive.hpp"

namespace granulaw {

namespace {

/// Most sweeps of a step, and the change (as a share of the largest impulse) that ends them sooner.
constexpr int most_sweeps = 15;
constexpr double small_change = 1e-6;
/// Sweeps that end early leave markers a little behind a plane. They come back by this share of the way in a
/// step: the whole way at once would feed energy (e of a plastic impact 0.5 % too small, elastic vibration
/// growing); by a twentieth e is that of 300 sweeps to 2e-4.
constexpr double recovery = 0.05;
/// Markers nearer to a plane than this many of the finest edges are looked at in every step.
constexpr double candidate_edges = 2;
/// Share of the gap three patches outside a contact below which a marker is in it: markers inside that push
/// in turns are open by 1 % of that gap at most.
constexpr double in_contact = 0.02;

double fastest_node(const SpatialBody& body)
{
  double most = 0;
  for (const double v : body.v_i) most = std::max(most, std::abs(v));
  return std::sqrt(3.0) * most;
}

/// A marker about a contact.
struct NearMarker
{
  double gap, area;
  Vector3 place;
};

/// Half axes of the ellipse with the second moments of the markers' patches, larger first.
std::array<double, 2> ellipse_of(const SpatialBody& body, const Plane& plane,
                                 std::span<const NearMarker> markers)
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
    if (body.mirrored[d] && std::abs(plane.normal[d]) < 1e-9) {
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

SpatialContact::SpatialContact(const SpatialBody& body, std::vector<Plane> planes)
    : planes_(std::move(planes)),
      markers_(body.surface.count),
      candidates_(planes_.size()),
      impulse_(planes_.size() * static_cast<std::size_t>(markers_), Vector3::Zero()),
      pushing_(planes_.size(), 0),
      tallies_(planes_.size())
{
  const std::array<int, 3> stride = body.strides();
  for (int k = 0; k < cell_nodes; ++k) offsets_[k] = 4 * (k / 9 + k / 3 % 3 * stride[1] + k % 3 * stride[2]);
  for (std::vector<int>& list : candidates_) list.reserve(static_cast<std::size_t>(markers_));
  rows_.reserve(impulse_.size());  // all that there can be, so that no step allocates
}

Vector3 SpatialContact::velocity(const SpatialBody& body, int marker) const
{
  const double* at = body.v_i.data() + 4 * body.surface.node[marker];
  const double* weight = body.surface.weight.data() + std::size_t(cell_nodes) * marker;
  double sum[4]{};
  for (int k = 0; k < cell_nodes; ++k)
    for (int c = 0; c < 4; ++c) sum[c] += weight[k] * at[offsets_[k] + c];
  return {sum[0], sum[1], sum[2]};
}

Vector3 SpatialContact::place(const SpatialBody& body, int marker) const
{
  const double* at = body.u_i.data() + 4 * body.surface.node[marker];
  const double* weight = body.surface.weight.data() + std::size_t(cell_nodes) * marker;
  const std::array<double, 3>& start = body.surface.place[marker];
  double sum[4]{start[0], start[1], start[2], 0};
  for (int k = 0; k < cell_nodes; ++k)
    for (int c = 0; c < 4; ++c) sum[c] += weight[k] * at[offsets_[k] + c];
  return {sum[0], sum[1], sum[2]};
}

void SpatialContact::push(SpatialBody& body, int marker, const Vector3& p) const
{
  double* at = body.v_i.data() + 4 * body.surface.node[marker];
  const double* inverse_mass = body.inverse_mass_i.data() + 4 * body.surface.node[marker];
  const double* weight = body.surface.weight.data() + std::size_t(cell_nodes) * marker;
  const double impulse[4] = {p[0], p[1], p[2], 0};
  for (int k = 0; k < cell_nodes; ++k)
    for (int c = 0; c < 4; ++c) at[offsets_[k] + c] += weight[k] * inverse_mass[offsets_[k] + c] * impulse[c];
}

void SpatialContact::choose_candidates(const SpatialBody& body)
{
  room_ = candidate_edges * body.surface.finest;
  for (std::vector<int>& list : candidates_) list.clear();
  for (int m = 0; m < markers_; ++m) {
    const Vector3 x = place(body, m);
    for (std::size_t k = 0; k < planes_.size(); ++k)
      if (planes_[k].normal.dot(x) - planes_[k].position < room_) candidates_[k].push_back(m);
  }
}

void SpatialContact::make_rows(const SpatialBody& body, double kick, double dt)
{
  rows_.clear();
  for (int k = 0; k < static_cast<int>(planes_.size()); ++k) {
    const Plane& plane = planes_[k];
    for (const int m : candidates_[k]) {
      const double gap = plane.normal.dot(place(body, m)) - plane.position;
      const double approach = plane.normal.dot(velocity(body, m)) - plane.velocity;
      // a row for each marker that would pass, or might once its neighbours are pushed back
      const bool pushed = impulse_[std::size_t(k) * markers_ + m] != Vector3::Zero();
      if (gap + dt * approach > 0 && !pushed && gap > 4 * dt * std::abs(approach)) continue;
      Row row{
          m, k, plane.velocity - (gap < 0 ? recovery : 1) * gap / dt, 0, 0, plane.velocity, Vector3::Zero()};
      Vector3 response = Vector3::Zero();
      const int lowest = 4 * body.surface.node[m];
      for (int n = 0; n < cell_nodes; ++n) {
        const double w = body.surface.weight[std::size_t(cell_nodes) * m + n];
        for (int c = 0; c < 3; ++c) {
          const int at = lowest + offsets_[n] + c;
          response[c] += w * w * body.inverse_mass_i[at];
          row.before[c] += w * (body.v_i[at] - kick * body.inverse_mass_i[at] * body.f_i[at]);
        }
      }
      row.response = plane.normal.cwiseAbs2().dot(response);
      row.tangent_response = response.maxCoeff();
      if (row.response > 0) rows_.push_back(row);
    }
  }
}

/// One sweep; the largest change of an impulse over the largest impulse.
double SpatialContact::sweep(SpatialBody& body)
{
  double change = 0, largest = 0;
  for (const Row& row : rows_) {
    const Plane& plane = planes_[row.plane];
    const Vector3 v = velocity(body, row.marker);
    Vector3& p = impulse(row);
    const double normal_velocity = plane.normal.dot(v), normal = plane.normal.dot(p);
    const double wanted = std::max(0.0, normal + (row.needed - normal_velocity) / row.response);
    Vector3 next = wanted * plane.normal;
    if (plane.friction > 0 && wanted > 0) {
      const Vector3 sliding = v - normal_velocity * plane.normal;
      Vector3 tangential = p - normal * plane.normal - sliding / row.tangent_response;
      const double most = plane.friction * wanted, size = tangential.norm();
      next += size > most ? Vector3(most / size * tangential) : tangential;
    }
    const Vector3 step = next - p;
    if (step != Vector3::Zero()) push(body, row.marker, step);
    p = next;
    change = std::max(change, step.lpNorm<Eigen::Infinity>()), largest = std::max(largest, wanted);
  }
  return largest > 0 ? change / largest : 0;
}

double SpatialContact::correct(std::span<SpatialBody> bodies, double kick, double dt)
{
  SpatialBody& body = bodies.front();
  double closing = fastest_node(body);
  for (const Plane& plane : planes_) closing += std::abs(plane.velocity);
  room_ -= dt * closing;
  if (room_ < 0) choose_candidates(body), room_ -= dt * closing;
  make_rows(body, kick, dt);
  for (const Row& row : rows_)
    if (impulse(row) != Vector3::Zero()) push(body, row.marker, impulse(row));
  for (int n = 0; n < most_sweeps && sweep(body) > small_change; ++n) {
  }
  std::fill(pushing_.begin(), pushing_.end(), 0);
  double first = 0;
  for (const Row& row : rows_) {
    const Plane& plane = planes_[row.plane];
    const Vector3& p = impulse(row);
    const double normal = plane.normal.dot(p);
    if (normal <= 0) continue;
    pushing_[row.plane] = 1;
    if (row.plane == 0) first += plane.copies * normal;
    const Vector3 x = place(body, row.marker);
    PlaneTally& tally = tallies_[row.plane];
    tally.impulse += p, tally.torque += x.cross(p), tally.centre += normal * x;
  }
  for (Plane& plane : planes_) plane.position += dt * plane.velocity;
  return first;
}

void SpatialContact::account(std::span<const SpatialBody> bodies)
{
  for (const Row& row : rows_) {
    const Vector3& p = impulse(row);
    if (p == Vector3::Zero()) continue;
    const double by_plane = row.speed * planes_[row.plane].normal.dot(p);
    dissipated_ += by_plane - 0.5 * p.dot(row.before + velocity(bodies.front(), row.marker));
    work_ += by_plane;
  }
}

bool SpatialContact::pushes() const
{
  return std::any_of(pushing_.begin(), pushing_.end(), [](char p) { return p != 0; });
}

std::vector<PlaneTally> SpatialContact::take_tallies()
{
  std::vector<PlaneTally> taken(planes_.size());
  std::swap(taken, tallies_);
  return taken;
}

std::array<double, 2> SpatialContact::contact_axes(const SpatialBody& body, int k) const
{
  if (!pushing_[k]) return {0, 0};
  std::vector<NearMarker> near;
  double closed = 0;
  for (const int m : candidates_[k]) {
    const Vector3 x = place(body, m);
    const bool pushed = planes_[k].normal.dot(impulse_[std::size_t(k) * markers_ + m]) > 0;
    near.push_back({pushed ? 0.0 : std::max(0.0, planes_[k].normal.dot(x) - planes_[k].position),
                    body.surface.area[m], x});
    if (pushed) closed += body.surface.area[m];
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

double SpatialContact::edge_radius(std::span<const SpatialBody> bodies) const
{
  const std::array<double, 2> axes = contact_axes(bodies.front(), 0);
  return std::sqrt(axes[0] * axes[1]);
}

void SpatialContact::visit_state(StateArchive& a)
{
  a.value(dissipated_), a.value(work_), a.value(room_);
  const auto visit = [&](Vector3& v) {
    for (int d = 0; d < 3; ++d) a.value(v[d]);
  };
  for (Plane& plane : planes_) a.value(plane.position), a.value(plane.velocity);
  for (Vector3& p : impulse_) visit(p);
  for (PlaneTally& t : tallies_) visit(t.impulse), visit(t.torque), visit(t.centre);
  for (std::vector<int>& list : candidates_) a.growing(list);
}

}  // namespace granulaw
