#include "law/fast_curve.hpp"

#include "base/gauss.hpp"

namespace granulaw {

namespace {

/// Coefficients in t of the cubic that is v[k] at t = width k/3.
void fit(const double (&v)[4], double width, double (&c)[4])
{
  c[0] = v[0];
  c[1] = 0.5 * (-11.0 * v[0] + 18.0 * v[1] - 9.0 * v[2] + 2.0 * v[3]);
  c[2] = 4.5 * (2.0 * v[0] - 5.0 * v[1] + 4.0 * v[2] - v[3]);
  c[3] = 4.5 * (-v[0] + 3.0 * v[1] - 3.0 * v[2] + v[3]);
  for (int power = 1; power < 4; ++power) c[power] /= std::pow(width, power);
}

}  // namespace

FastCurve::FastCurve(const ContactCurve& curve) : curve_(&curve), onset_(curve.onset())
{
  if (curve.axis()) {
    axis_ = FastAxis(*curve.axis());
    corrected_from_ = VelocityAxis::negligible;
  }
  const double x_end = curve.x_end();
  if (x_end < std::ldexp(1.0, lowest_exponent)) return;  // the curve answers alone
  places_ = place(x_end) + 1;
  const std::size_t count = index(x_end) + 1;
  intervals_.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double low = std::bit_cast<double>(first_bits + (static_cast<std::uint64_t>(k) << shift));
    const double high = std::bit_cast<double>(first_bits + (static_cast<std::uint64_t>(k + 1) << shift));
    // the last interval is sampled up to x_end only: beyond, the curve's residual ratio and exponent stand
    // still
    const double width = (x_end > low ? std::min(high, x_end) : high) - low;
    double radius[4], span[4], exponent[4], hertz_share[4], work[4];
    for (int p = 0; p < 4; ++p) {
      const double x = low + width * p / 3.0;
      const ContactCurve::Reversal reversal = curve.reversal(x);
      radius[p] = reversal.radius;
      span[p] = 1.0 - reversal.residual / x;
      exponent[p] = reversal.shape.exponent;
      hertz_share[p] = reversal.shape.hertz_share;
      work[p] = curve.work_loading(x) - curve.work_unloading(x);
    }
    double c[4];
    fit(radius, width, c);
    intervals_[k].loading.set(1, c);
    fit(span, width, c);
    intervals_[k].reversal.set(0, c);
    fit(exponent, width, c);
    intervals_[k].reversal.set(1, c);
    fit(hertz_share, width, c);
    intervals_[k].rest.set(0, c);
    fit(work, width, c);
    intervals_[k].rest.set(1, c);

    const ContactCurve::Loading begin = curve.loading(low), end = curve.loading(low + width);
    hermite(c, begin.force, end.force, width * begin.stiffness, width * end.stiffness);
    for (int power = 1; power < 4; ++power) c[power] /= std::pow(width, power);
    intervals_[k].loading.set(0, c);
  }
}

std::size_t FastCurve::bytes() const
{
  return intervals_.size() * sizeof(Interval) + axis_.bytes();
}

double FastCurve::loading_work(double x, double impact_overlap) const
{
  // over s, x s^4 the overlap: there the force is nearly s^6, from the elastic start to the end of the table
  const auto at = [&](double s) {
    const double s3 = s * s * s;
    return 4.0 * s3 * loading_force(x * s * s3, impact_overlap);
  };
  // the corrections are splines: short pieces
  double work = gauss<7>(0.0, 0.4, at);
  for (int k = 4; k < 10; ++k) work += gauss<7>(0.1 * k, 0.1 * (k + 1), at);
  return x * work;
}

double FastCurve::dissipated_fast(double from, double to, double impact_overlap) const
{
  if (to <= onset_) return 0.0;
  const Reversal after = reversal(to, impact_overlap);
  if (from <= onset_) return loading_work(to, impact_overlap) - after.work();
  const Reversal before = reversal(from, impact_overlap);
  const double put_in =
      to > 1.25 * from ? loading_work(to, impact_overlap) - loading_work(from, impact_overlap)
                       : (to - from) / 6.0 *
                             (before.force_at(from) + 4.0 * loading_force(0.5 * (from + to), impact_overlap) +
                              after.force_at(to));
  return put_in - (after.work() - before.work());
}

ContactCurve::Loading FastCurve::far_loading(double x, double impact_overlap) const
{
  return curve_->loading(x, impact_overlap);
}

FastCurve::Reversal FastCurve::far_turn(double x_max, double impact_overlap) const
{
  const ContactCurve::Reversal t = curve_->reversal(x_max, impact_overlap);
  return turn_of(x_max, t.force, x_max - t.residual, t.shape);
}

}  // namespace granulaw
