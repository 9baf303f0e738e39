#include "solver/body/spline_axis.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace granulaw {

SplineAxis::SplineAxis(std::vector<double> lines) : lines_(std::move(lines))
{
  assert(lines_.size() >= 2);
  const int n = cells();
  nodes_.push_back(lines_.front());
  for (int c = 0; c < n; ++c) nodes_.push_back(0.5 * (lines_[c] + lines_[c + 1]));
  nodes_.push_back(lines_.back());
  const int buckets = 4 * n;
  per_bucket_ = buckets / (lines_.back() - lines_.front());
  for (int b = 0; b < buckets; ++b) {
    const double x = lines_.front() + b / per_bucket_;
    const auto above = std::upper_bound(lines_.begin(), lines_.end(), x);
    lookup_.push_back(std::clamp(static_cast<int>(above - lines_.begin()) - 1, 0, n - 1));
  }
}

int SplineAxis::cell(double x) const
{
  const int bucket = std::clamp(static_cast<int>((x - lines_.front()) * per_bucket_), 0,
                                static_cast<int>(lookup_.size()) - 1);
  int c = lookup_[bucket];
  while (c + 1 < cells() && x >= lines_[c + 1]) ++c;
  while (c > 0 && x < lines_[c]) --c;
  return c;
}

SplineAxis::Values SplineAxis::at(double x) const
{
  const int c = cell(x), n = cells();
  x = std::clamp(x, lines_.front(), lines_.back());
  // knots around cell c: t0 <= t1 = line c < t2 = line c + 1 <= t3; ends repeat
  const double t1 = lines_[c], t2 = lines_[c + 1];
  const double t0 = c > 0 ? lines_[c - 1] : t1, t3 = c + 1 < n ? lines_[c + 2] : t2;
  const double h = t2 - t1, left = t2 - t0, right = t3 - t1;
  const double up = x - t1, down = t2 - x;
  Values v;
  v.first = c;
  v.n[0] = down * down / (h * left);
  v.n[2] = up * up / (h * right);
  v.n[1] = 1 - v.n[0] - v.n[2];
  v.dn[0] = -2 * down / (h * left);
  v.dn[2] = 2 * up / (h * right);
  v.dn[1] = -v.dn[0] - v.dn[2];
  return v;
}

std::vector<double> graded_lines(double from, double until, double end, double fine, double growth,
                                 double coarsest, double shift)
{
  std::vector<double> lines{from};
  double at = from + (1 - shift) * fine;
  const double last_fine = std::min(until, end) - 1e-9 * fine;
  for (; at < last_fine; at += fine) lines.push_back(at);
  lines.push_back(at);
  const std::size_t graded_from = lines.size() - 1;
  double step = fine;
  while (lines.back() < end - 1e-9 * fine) {
    step = std::min(step * growth, coarsest);
    lines.push_back(lines.back() + step);
  }
  const double start = lines[graded_from], span = lines.back() - start;
  if (span > 0)
    for (std::size_t k = graded_from; k < lines.size(); ++k)
      lines[k] = start + (lines[k] - start) * (end - start) / span;
  return lines;
}

}  // namespace granulaw
