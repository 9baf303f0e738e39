#include "solver/particle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <queue>

#include "base/error.hpp"

namespace granulaw {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Profile = std::vector<ProfilePoint>;

std::size_t widest_point(const Profile& profile)
{
  const auto less = [](const ProfilePoint& a, const ProfilePoint& b) { return a.r < b.r; };
  return std::max_element(profile.begin(), profile.end(), less) - profile.begin();
}

}  // namespace

/// Bounding boxes over runs of consecutive segments of a profile, a binary heap: the distance to a polyline
/// of some thousand points in a few hundred nanoseconds.
class ProfileTree
{
 public:
  explicit ProfileTree(const Profile& profile) : key_(key_of(profile)), widest_(widest_point(profile))
  {
    for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
      const ProfilePoint a = profile[k], b = profile[k + 1];
      const double dr = b.r - a.r, dz = b.z - a.z;
      segments_.push_back({a.r, a.z, dr, dz, 1 / (dr * dr + dz * dz)});
      rising_ = rising_ && (k >= widest_ || dr >= 0);
    }
    const std::size_t runs = (segments_.size() + run_length - 1) / run_length;
    while (leaves_ < runs) leaves_ *= 2;
    boxes_.resize(2 * leaves_);
    for (std::size_t k = 0; k < segments_.size(); ++k) {
      Box& box = boxes_[leaves_ + k / run_length];
      box.add(profile[k]);
      box.add(profile[k + 1]);
    }
    for (std::size_t n = leaves_ - 1; n >= 1; --n) {
      boxes_[n] = boxes_[2 * n];
      boxes_[n].add(boxes_[2 * n + 1]);
    }
  }

  bool is_of(const Profile& profile) const { return key_ == key_of(profile); }
  std::size_t widest() const { return widest_; }
  /// r never falls between the pole and the widest point.
  bool rising() const { return rising_; }

  /// Signed distance of (r >= 0, z), positive on the left of the curve: inside.
  double depth(double r, double z) const
  {
    double best = infinity, best_t = 0;
    std::size_t nearest_segment = 0;
    struct Visit
    {
      std::size_t node;
      double least;
    } stack[64];
    int top = 0;
    stack[top++] = {1, 0};
    while (top > 0) {
      const Visit visit = stack[--top];
      if (visit.least >= best) continue;
      if (visit.node >= leaves_) {
        const std::size_t first = (visit.node - leaves_) * run_length;
        const std::size_t last = std::min(first + run_length, segments_.size());
        for (std::size_t k = first; k < last; ++k) {
          const Segment& s = segments_[k];
          const double t = std::clamp(((r - s.r) * s.dr + (z - s.z) * s.dz) * s.inverse_length2, 0.0, 1.0);
          const double er = r - s.r - t * s.dr, ez = z - s.z - t * s.dz, d = er * er + ez * ez;
          if (d < best) best = d, best_t = t, nearest_segment = k;
        }
        continue;
      }
      Visit near{2 * visit.node, boxes_[2 * visit.node].distance2(r, z)};
      Visit far{near.node + 1, boxes_[near.node + 1].distance2(r, z)};
      if (far.least < near.least) std::swap(near, far);
      stack[top++] = far;
      stack[top++] = near;
    }
    const Segment& s = segments_[nearest_segment];
    // At a corner neither neighbour alone tells the side; the sum of their unit normals does.
    double nr = -s.dz, nz = s.dr;
    if (best_t == 0)
      corner_normal(nearest_segment, nr, nz);
    else if (best_t == 1)
      corner_normal(nearest_segment + 1, nr, nz);
    const double er = r - s.r - best_t * s.dr, ez = z - s.z - best_t * s.dz;
    return std::copysign(std::sqrt(best), nr * er + nz * ez);
  }

 private:
  static constexpr std::size_t run_length = 8;

  struct Segment
  {
    double r, z, dr, dz, inverse_length2;
  };
  struct Box
  {
    double r0 = infinity, r1 = -infinity, z0 = infinity, z1 = -infinity;
    void add(const ProfilePoint& p)
    {
      r0 = std::min(r0, p.r), r1 = std::max(r1, p.r), z0 = std::min(z0, p.z), z1 = std::max(z1, p.z);
    }
    void add(const Box& b)
    {
      r0 = std::min(r0, b.r0), r1 = std::max(r1, b.r1), z0 = std::min(z0, b.z0), z1 = std::max(z1, b.z1);
    }
    /// Squared distance; infinite from an empty box.
    double distance2(double r, double z) const
    {
      const double dr = std::max({r0 - r, r - r1, 0.0}), dz = std::max({z0 - z, z - z1, 0.0});
      return dr * dr + dz * dz;
    }
  };
  /// What tells a profile from another that may lie at the same place in memory.
  struct Key
  {
    const ProfilePoint* data;
    std::size_t size;
    double values[6];
    bool operator==(const Key&) const = default;
  };
  static Key key_of(const Profile& p)
  {
    const std::size_t n = p.size();
    return {p.data(), n, {p[n / 4].r, p[n / 4].z, p[n / 2].r, p[n / 2].z, p[3 * n / 4].r, p[n - 1].z}};
  }
  /// Into the body, at point k; on the axis the neighbour is the mirror image.
  void corner_normal(std::size_t k, double& nr, double& nz) const
  {
    nr = nz = 0;
    if (k == 0) return void(nz = 1);
    if (k == segments_.size()) return void(nz = -1);
    for (const Segment& s : {segments_[k - 1], segments_[k]}) {
      const double scale = std::sqrt(s.inverse_length2);
      nr -= scale * s.dz;
      nz += scale * s.dr;
    }
  }

  Key key_;
  std::size_t widest_ = 0, leaves_ = 1;
  bool rising_ = true;
  std::vector<Segment> segments_;
  std::vector<Box> boxes_;  // [1]: all; [n]'s halves: [2n], [2n + 1]; from [leaves_] on: runs

  friend class ProfileCache;
  /// Trees of earlier profiles live on: another thread may still be looking at one.
  std::unique_ptr<const ProfileTree> earlier_;
};

ProfileCache& ProfileCache::operator=(const ProfileCache&)
{
  delete newest_.exchange(nullptr);
  return *this;
}

ProfileCache::~ProfileCache()
{
  delete newest_.load();
}

const ProfileTree& ProfileCache::tree(const Profile& profile) const
{
  const ProfileTree* newest = newest_.load(std::memory_order_acquire);
  if (newest && newest->is_of(profile)) return *newest;
  auto made = std::make_unique<ProfileTree>(profile);
  for (;;) {
    if (newest && newest->is_of(profile)) return *newest;  // another thread was faster
    if (newest_.compare_exchange_weak(newest, made.get(), std::memory_order_acq_rel)) {
      made->earlier_.reset(newest);
      return *made.release();
    }
  }
}

double Particle::height() const
{
  return is_sphere() ? 2 * radius : profile.back().z;
}

double Particle::depth(double r, double z) const
{
  if (is_sphere()) return radius - std::hypot(r, z - radius);
  return cache.tree(profile).depth(std::abs(r), z);
}

int Particle::material_at(double r, double z) const
{
  r = std::abs(r);
  const double below = depth(r, z);
  if (!(below >= 0)) return -1;
  for (auto i = inclusions.rbegin(); i != inclusions.rend(); ++i) {
    const double dr = r - i->r, dz = z - i->z;
    if (dr * dr + dz * dz <= i->radius * i->radius) return i->material;
  }
  double inner = 0;
  for (const Layer& layer : layers) {
    inner += layer.thickness;
    if (below < inner) return layer.material;
  }
  return 0;
}

double Particle::largest_depth() const
{
  if (is_sphere()) return radius;
  // Squares of half width h with depth d at their centre: no depth in one exceeds d + sqrt(2) h. The most
  // promising is split until it promises nothing more.
  struct Square
  {
    double r, z, h, d;
    double most() const { return d + std::numbers::sqrt2 * h; }
    bool operator<(const Square& other) const { return most() < other.most(); }
  };
  double best = 0;
  std::priority_queue<Square> squares;
  const auto push = [&](double r, double z, double h) {
    const Square square{r, z, h, depth(r, z)};
    best = std::max(best, square.d);
    if (square.most() > best) squares.push(square);
  };
  const double h = std::min(radius, height()) / 2;
  for (double r = h; r - h < radius; r += 2 * h)
    for (double z = h; z - h < height(); z += 2 * h) push(r, z, h);
  while (!squares.empty() && squares.top().most() > best * (1 + 1e-3)) {
    const Square s = squares.top();
    squares.pop();
    for (const double r : {s.r - s.h / 2, s.r + s.h / 2})
      for (const double z : {s.z - s.h / 2, s.z + s.h / 2}) push(r, z, s.h / 2);
  }
  return best;
}

double Particle::volume() const
{
  if (is_sphere()) return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  double sum = 0;
  for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
    const ProfilePoint a = profile[k], b = profile[k + 1];
    sum += (b.z - a.z) * (a.r * a.r + a.r * b.r + b.r * b.r);
  }
  return std::numbers::pi / 3 * sum;
}

double Particle::surface_z(double r) const
{
  r = std::abs(r);
  if (is_sphere()) {
    if (r >= radius) return radius;
    return r * r / (radius + std::sqrt(radius * radius - r * r));  // no difference of near numbers
  }
  const ProfileTree& tree = cache.tree(profile);
  const auto first = profile.begin(), widest = first + static_cast<std::ptrdiff_t>(tree.widest());
  if (r >= widest->r) return widest->z;
  double lowest = infinity;
  auto b = first + 1;
  if (tree.rising())
    b = std::max(b,
                 std::lower_bound(first, widest, r, [](const ProfilePoint& p, double x) { return p.r < x; }));
  for (; b <= widest; ++b) {
    const ProfilePoint p = b[-1], q = *b;
    if (std::min(p.r, q.r) > r) {
      if (tree.rising()) break;
      continue;
    }
    if (std::max(p.r, q.r) < r) continue;
    lowest = std::min(lowest, p.r == q.r ? std::min(p.z, q.z) : p.z + (q.z - p.z) * (r - p.r) / (q.r - p.r));
  }
  return lowest;
}

namespace {

/// z = r^2/(2 R) + c r^4 by least squares through the points after the pole with r up to `reach`.
struct PoleFit
{
  int points;
  double radius;  ///< R
  double misfit;  ///< largest error of z over the highest z
};

PoleFit fit_pole(const Profile& profile, double reach)
{
  double s4 = 0, s6 = 0, s8 = 0, t2 = 0, t4 = 0;  // sums of powers of x = r/reach, without and with z
  const auto x2 = [&](std::size_t k) { return profile[k].r * profile[k].r / (reach * reach); };
  std::size_t end = 1;
  for (; end < profile.size() && profile[end].r <= reach && profile[end].r > profile[end - 1].r; ++end) {
    const double x = x2(end), z = profile[end].z;
    s4 += x * x, s6 += x * x * x, s8 += x * x * x * x;
    t2 += x * z, t4 += x * x * z;
  }
  const double determinant = s4 * s8 - s6 * s6;
  const double a = (t2 * s8 - t4 * s6) / determinant, b = (t4 * s4 - t2 * s6) / determinant;
  double worst = 0, highest = 0;
  for (std::size_t k = 1; k < end; ++k) {
    worst = std::max(worst, std::abs(a * x2(k) + b * x2(k) * x2(k) - profile[k].z));
    highest = std::max(highest, profile[k].z);
  }
  return {static_cast<int>(end) - 1, reach * reach / (2 * a), worst / highest};
}

}  // namespace

double Particle::pole_curvature_radius() const
{
  if (is_sphere()) return radius;
  const ProfilePoint first = profile[1];
  if (first.z == 0) return infinity;
  // Clean curves meet the first limit on misfit; measured outlines may need a later one.
  for (const double misfit : {1e-4, 1e-3, 1e-2, 1e-1})
    for (double reach = 0.1 * radius;; reach *= 0.8) {
      const PoleFit fit = fit_pole(profile, reach);
      if (fit.points < 3) break;
      if (fit.misfit <= misfit && fit.radius > 0) return fit.radius;
    }
  return (first.r * first.r + first.z * first.z) / (2 * first.z);
}

Particle Particle::scaled(double factor) const
{
  Particle p = *this;
  p.radius *= factor;
  for (ProfilePoint& point : p.profile) point.r *= factor, point.z *= factor;
  for (Layer& layer : p.layers) layer.thickness *= factor;
  for (Inclusion& i : p.inclusions) i.r *= factor, i.z *= factor, i.radius *= factor;
  return p;
}

Particle Particle::from(const Sphere& sphere)
{
  Particle p;
  p.radius = sphere.radius;
  p.materials = {sphere.material};
  return p;
}

namespace {

std::string text(const ProfilePoint& p)
{
  return fmt::format("({:g}, {:g}) m", p.r, p.z);
}

/// Twice the area of the triangle abc: positive if c lies on the left of ab.
double turn(const ProfilePoint& a, const ProfilePoint& b, const ProfilePoint& c)
{
  return (b.r - a.r) * (c.z - a.z) - (b.z - a.z) * (c.r - a.r);
}

/// c, known to lie on the line ab, lies between a and b.
bool between(const ProfilePoint& a, const ProfilePoint& b, const ProfilePoint& c)
{
  return std::min(a.r, b.r) <= c.r && c.r <= std::max(a.r, b.r) && std::min(a.z, b.z) <= c.z &&
         c.z <= std::max(a.z, b.z);
}

bool cross(const ProfilePoint& a, const ProfilePoint& b, const ProfilePoint& c, const ProfilePoint& d)
{
  const double c_side = turn(a, b, c), d_side = turn(a, b, d), a_side = turn(c, d, a), b_side = turn(c, d, b);
  if (c_side == 0 && between(a, b, c)) return true;
  if (d_side == 0 && between(a, b, d)) return true;
  if (a_side == 0 && between(c, d, a)) return true;
  if (b_side == 0 && between(c, d, b)) return true;
  return (c_side > 0) != (d_side > 0) && (a_side > 0) != (b_side > 0) && c_side != 0 && d_side != 0 &&
         a_side != 0 && b_side != 0;
}

/// Sweeps upwards: a segment is compared with those that begin below its upper end.
void check_simple(const Profile& profile, const std::string& where)
{
  std::vector<std::size_t> order(profile.size() - 1);
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  const auto low = [&](std::size_t k) { return std::min(profile[k].z, profile[k + 1].z); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return low(a) < low(b); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double upper = std::max(profile[order[i]].z, profile[order[i] + 1].z);
    for (std::size_t j = i + 1; j < order.size() && low(order[j]) <= upper; ++j) {
      const std::size_t a = std::min(order[i], order[j]), b = std::max(order[i], order[j]);
      const bool meet = b == a + 1  // neighbours share a point; only a fold lays one on the other
                            ? turn(profile[a], profile[b], profile[b + 1]) == 0 &&
                                  (between(profile[a], profile[b], profile[b + 1]) ||
                                   between(profile[b], profile[b + 1], profile[a]))
                            : cross(profile[a], profile[a + 1], profile[b], profile[b + 1]);
      if (meet)
        fail(where, "the profile crosses or touches itself",
             fmt::format("the segments after points {} {} and {} {}", a + 1, text(profile[a]), b + 1,
                         text(profile[b])));
    }
  }
}

void check_profile(const Particle& p, const std::string& where)
{
  const Profile& profile = p.profile;
  if (profile.size() < 3)
    fail(where, "the profile encloses no body", fmt::format("{} points", profile.size()), "3 or more");
  for (std::size_t k = 0; k < profile.size(); ++k) {
    const ProfilePoint point = profile[k];
    const std::string name = fmt::format("point {} of the profile", k + 1);
    if (!std::isfinite(point.r) || !std::isfinite(point.z)) fail(where, name + " is not finite", text(point));
    if (point.r < 0) fail(where, name + " lies on the other side of the axis", text(point), "r of 0 or more");
    if (point.z < 0)
      fail(where, name + " lies below the contact pole, which must be the lowest", text(point),
           "z of 0 or more");
    if (k > 0 && std::hypot(point.r - profile[k - 1].r, point.z - profile[k - 1].z) <= 1e-10 * p.radius)
      fail(where, name + " repeats the one before", text(point));
    if (k > 0 && k + 1 < profile.size() && point.r == 0)
      fail(where, name + " lies on the axis, which only the two ends may", text(point), "r over 0");
  }
  if (profile.front().r != 0 || profile.front().z != 0)
    fail(where, "the profile must start at the contact pole", text(profile.front()), "(0, 0)");
  if (profile.back().r != 0)
    fail(where, "the profile must end on the axis, at the far pole", text(profile.back()), "r = 0");
  check_simple(profile, where);
  if (!(p.height() >= 0.01 * p.radius && p.height() <= 100 * p.radius))
    fail(where, "the body is too flat or too slender: its height", fmt::format("{:g} m", p.height()),
         fmt::format("{:g} to {:g} m, 0.01 to 100 times its radius", 0.01 * p.radius, 100 * p.radius));
  const double widest = profile[widest_point(profile)].r;
  if (!(std::abs(p.radius / widest - 1) <= 1e-6))
    fail(where, "'radius' is not the profile's largest distance from the axis",
         fmt::format("{:g} m", p.radius), fmt::format("{:g} m", widest));
}

void check_material(const Particle& p, int material, bool pore_allowed, const std::string& name,
                    const std::string& where)
{
  if (material < (pore_allowed ? -1 : 0) || material >= static_cast<int>(p.materials.size()))
    fail(where, fmt::format("{} has a material that the particle does not", name),
         fmt::format("{}", material),
         fmt::format("{}0 to {}", pore_allowed ? "-1 (a pore), " : "", p.materials.size() - 1));
}

}  // namespace

void validate(const Particle& p, const std::string& where)
{
  if (!(p.radius > 0 && std::isfinite(p.radius)))
    fail(where, "'radius' is out of range", fmt::format("{:g} m", p.radius), "over 0");
  if (p.materials.empty()) fail(where, "the particle has no material");
  if (!p.is_sphere()) check_profile(p, where);

  double thickness = 0;
  for (std::size_t k = 0; k < p.layers.size(); ++k) {
    const std::string name = fmt::format("layer {}", k + 1);
    if (!(p.layers[k].thickness > 0 && std::isfinite(p.layers[k].thickness)))
      fail(where, fmt::format("'thickness' of {} is out of range", name),
           fmt::format("{:g} m", p.layers[k].thickness), "over 0");
    check_material(p, p.layers[k].material, false, name, where);
    thickness += p.layers[k].thickness;
  }
  if (!p.layers.empty()) {
    const double room = p.largest_depth();
    if (!(thickness < room))
      fail(where, "the layers leave no core: they are thicker than the body is deep",
           fmt::format("{:g} m", thickness), fmt::format("below {:g} m", room));
  }

  for (std::size_t k = 0; k < p.inclusions.size(); ++k) {
    const Particle::Inclusion& i = p.inclusions[k];
    const std::string name = fmt::format("inclusion {}", k + 1);
    if (!(i.radius > 0 && std::isfinite(i.radius)))
      fail(where, fmt::format("'radius' of {} is out of range", name), fmt::format("{:g} m", i.radius),
           "over 0");
    if (!(i.r >= 0 && std::isfinite(i.r) && std::isfinite(i.z)))
      fail(where, fmt::format("the centre of {} is out of range", name), text({i.r, i.z}), "r of 0 or more");
    if (i.r > 0 && i.r < i.radius)
      fail(where, fmt::format("the ring that is {} overlaps itself on the axis", name),
           fmt::format("r = {:g} m", i.r), fmt::format("0 (a ball), or {:g} m and more", i.radius));
    check_material(p, i.material, true, name, where);
    const double room = p.depth(i.r, i.z);
    if (!(room > 0)) fail(where, fmt::format("{} has its centre outside the body", name), text({i.r, i.z}));
    if (!(i.radius < room))
      fail(where, fmt::format("{} reaches the surface: its radius", name), fmt::format("{:g} m", i.radius),
           fmt::format("below {:g} m at {}", room, text({i.r, i.z})));
  }
}

}  // namespace granulaw
