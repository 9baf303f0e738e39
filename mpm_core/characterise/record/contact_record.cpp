#include "characterise/record/contact_record.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <span>

#include "contact/unloading.hpp"
#include "linear/linear.hpp"

namespace granulaw {

namespace {

constexpr double force_scale = 4.0 / 3.0;  // Hertz's force at x = 1

/// Mean force of the loading samples within 1 % below the reversal at trace[reversal].
double force_before(const std::vector<TraceSample>& trace, std::size_t reversal)
{
  double sum = 0;
  int count = 0;
  for (std::size_t k = reversal + 1; k-- > 0 && trace[k].delta >= 0.99 * trace[reversal].delta;) {
    if (trace[k].branch != Branch::load) break;
    // the law rises by about F ~ x there: brought to the reversal
    sum += trace[k].force * trace[reversal].delta / trace[k].delta;
    ++count;
  }
  return count ? sum / count / force_scale : 0;
}

/// int_0^1 du/sqrt(1 - W(u)/W(1)): duration of an unloading over (x_m - r)/(speed of rebound).
double duration_factor(const UnloadingShape& shape)
{
  // u = 1 - v^2: the integrand is smooth at the reversal
  const double all = shape.work();
  return boost::math::quadrature::gauss<double, 30>::integrate(
      [&](double v) { return 2 * v / std::sqrt(1 - shape.work(1 - v * v) / all); }, 0.0, 1.0);
}

/// A path's work, duration and force by overlap.
class Unloaded
{
 public:
  Unloaded(const UnloadingPath& path, double reversal_force) : path_(path), reversal_force_(reversal_force)
  {
    // v^2 is as the work given back so far: int dx/sqrt(W), exact over an interval of constant force
    for (std::size_t k = 1; k < path.size(); ++k) {
      const double step = path[k - 1].x - path[k].x, before = work_;
      work_ += 0.5 * (path[k - 1].force + path[k].force) * step;
      if (work_ > 0) duration_ += 2 * step / (std::sqrt(before) + std::sqrt(work_));
    }
  }

  /// `hertz_share_of(span)`: of an unloading that ends `span` below the reversal.
  template <class HertzShareOf>
  UnloadingFit fit(const HertzShareOf& hertz_share_of) const
  {
    const double top = path_.front().x, span = top - path_.back().x;
    const auto shape = [&](double s) {
      const double hertz_share = hertz_share_of(s);
      return UnloadingShape{UnloadingShape::exponent_of(work_ / (reversal_force_ * s), hertz_share),
                            hertz_share};
    };
    const auto told = [&](double s) { return s / std::sqrt(work_) * duration_factor(shape(s)); };
    // the shorter the span the softer: below a half of Hertz's exponent no sphere unloads
    const auto too_short = [&](double s) { return shape(s).exponent < 0.75; };
    if (!(work_ > 0) || too_short(span)) return {path_.back().x, UnloadingShape{}.hertz_share};
    // the longer the span, the longer it takes; a fifth: no unloading of a sphere is further from the shape
    double low = 0.8 * span, high = 1.2 * span;
    for (int k = 0; k < 50; ++k) {
      const double middle = 0.5 * (low + high);
      (too_short(middle) || told(middle) < duration_ ? low : high) = middle;
    }
    return {top - high, hertz_share_of(high)};
  }

  /// The Hertz coefficient that comes nearest to the path where it ends `span` below the reversal: phi =
  /// phi_0 + A psi with the work kept, so one linear unknown.
  double nearest_hertz_share(double span) const
  {
    const double work = work_ / (reversal_force_ * span), end = path_.front().x - span;
    constexpr int points = 200;
    double product = 0, square = 0;
    std::size_t next = 0;  // first path point below the overlap
    for (int k = points; k > 0; --k) {
      const double u = static_cast<double>(k) / points, x = end + u * span;
      while (next < path_.size() && path_[next].x >= x) ++next;
      const double force = next == 0              ? path_.front().force
                           : next == path_.size() ? 0.0
                                                  : between(path_[next - 1], path_[next], x);
      const auto at = [&](double hertz_share) {
        return UnloadingShape{UnloadingShape::exponent_of(work, hertz_share), hertz_share}.at(u).value;
      };
      const double base = at(0), direction = at(1) - base;
      product += direction * (force / reversal_force_ - base);
      square += direction * direction;
    }
    return std::clamp(product / square, 0.0, UnloadingShape::largest_hertz_share);
  }

 private:
  static double between(const PathPoint& above, const PathPoint& below, double x)
  {
    return below.force + (above.force - below.force) * (x - below.x) / (above.x - below.x);
  }

  const UnloadingPath& path_;
  double reversal_force_, work_ = 0, duration_ = 0;
};

}  // namespace

UnloadingFit fit_unloading(const UnloadingPath& path, double reversal_force)
{
  const Unloaded unloaded(path, reversal_force);
  return unloaded.fit([&](double span) { return unloaded.nearest_hertz_share(span); });
}

double residual_as_long(const UnloadingPath& path, double reversal_force, double hertz_share)
{
  return Unloaded(path, reversal_force).fit([&](double) { return hertz_share; }).residual;
}

namespace {

/// k of an unloading from `depth` to `residual`: least squares of the relative radius over sqrt(u), from `least` on, below
/// which the contact spans too few cells. Grid noise of the contact edge shows in the cubic term first: it is damped.
UnloadingRadius fit_radius(std::span<const TraceSample> unloading, double depth, double residual)
{
  constexpr double least = 0.2, damping = 0.005;
  constexpr Eigen::Index terms = 3;  // k = 1 + (1 - v)(b_0 + b_1 v + b_2 v^2)
  const double widest = unloading.front().contact_radius;
  std::vector<std::array<double, 3>> samples;  // v, k, weight
  double last = 1;
  for (const TraceSample& s : unloading) {
    const double v = std::sqrt(std::max(0.0, (s.delta - residual) / (depth - residual)));
    if (!(v < last) || !(s.contact_radius > 0)) continue;
    if (v < least) break;
    const double k = s.contact_radius / (widest * v);
    samples.push_back({v, k, std::sqrt(last - v) / k});
    last = v;
  }
  if (samples.size() < 10) return {};
  const auto rows = static_cast<Eigen::Index>(samples.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows + 1, terms);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(rows + 1);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const auto [v, k, weight] = samples[static_cast<std::size_t>(row)];
    for (Eigen::Index term = 0; term < terms; ++term)
      a(row, term) = weight * (1 - v) * std::pow(v, static_cast<double>(term));
    b(row) = weight * (k - 1);
  }
  a(rows, terms - 1) = damping;
  const Eigen::VectorXd c = least_squares(a, b);
  UnloadingRadius fit;
  for (std::size_t j = 0; j < fit.k.size(); ++j) {
    const double v = static_cast<double>(j) / 3;
    fit.k[j] = std::clamp(1 + (1 - v) * (c(0) + v * (c(1) + v * c(2))), UnloadingRadius::least, UnloadingRadius::most);
  }
  return fit;
}

/// Residual, Hertz coefficient, radius and path of an unloading whose force ended at the overlap `touched`.
void set_unloading(ContactRecord& press, std::span<const TraceSample> unloading, double touched)
{
  press.residual = std::max(0.0, touched);
  if (press.reversal_force <= 0) return;
  UnloadingPath& path = press.unloading = {{press.depth, press.reversal_force}};
  for (const TraceSample& s : unloading)
    if (s.delta < path.back().x && s.delta > touched) path.push_back({s.delta, s.force / force_scale});
  path.push_back({touched, 0});
  const UnloadingFit fit = fit_unloading(path, press.reversal_force);
  press.residual = std::max(0.0, fit.residual);
  press.hertz_share = fit.hertz_share;
  press.radius = fit_radius(unloading, press.depth, press.residual);
}

}  // namespace

ContactRecord contact_record_of(const RunResult& result)
{
  ContactRecord press;
  press.depth = result.summary.delta_max;
  press.peak = result.summary.force_max / force_scale;
  press.work_ratio = result.summary.work_unload / result.summary.work_load;
  const auto& t = result.trace;
  for (std::size_t k = 0; k < t.size(); ++k) {
    if (t[k].branch != Branch::load) continue;
    if (t[k].delta > (press.loading.empty() ? 0.0 : press.loading.back().x))
      press.loading.push_back({t[k].delta, t[k].force / force_scale, t[k].contact_radius});
    if (k + 1 < t.size() && t[k + 1].branch == Branch::unload) press.reversal_force = force_before(t, k);
  }
  const auto begins = std::find_if(t.rbegin(), t.rend(), [](const TraceSample& sample) {
                        return sample.branch != Branch::unload;
                      }).base();
  set_unloading(press, {begins, t.end()}, result.summary.delta_residual);
  return press;
}

std::vector<ContactRecord> partial_unloadings(const RunResult& result, double& loop)
{
  std::vector<ContactRecord> reversals;
  const auto& t = result.trace;
  double put_in = 0, area = 0;
  std::size_t begins = 0;
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double piece = 0.5 * (t[k].force + t[k - 1].force) * (t[k].delta - t[k - 1].delta);
    if (t[k].branch == Branch::load) {
      if (t[k - 1].branch == Branch::reload && put_in > 0) loop = std::max(loop, std::abs(area) / put_in);
      put_in += piece;
      area = 0;
      continue;
    }
    area += piece;
    if (t[k].branch == Branch::unload) {
      if (t[k - 1].branch != Branch::unload) {
        ContactRecord reversal;
        reversal.depth = reversal.residual = t[k - 1].delta;
        reversal.reversal_force = force_before(t, k - 1);
        reversals.push_back(std::move(reversal));
        begins = k;
      }
      ContactRecord& reversal = reversals.back();
      reversal.work_ratio -= piece / put_in;
      if (t[k].force > 0) reversal.residual = t[k].delta;
      if (k + 1 < t.size() && t[k + 1].branch != Branch::unload)
        set_unloading(reversal, std::span(t).subspan(begins, k + 1 - begins), reversal.residual);
    }
  }
  if (!reversals.empty()) reversals.pop_back();  // its summary gives the last one better
  return reversals;
}

}  // namespace granulaw
