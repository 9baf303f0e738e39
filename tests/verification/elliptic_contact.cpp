#include "elliptic_contact.hpp"

#include <cmath>
#include <numbers>

namespace granulaw {

namespace {

using std::numbers::pi;

/// Complete elliptic integrals of an ellipse of axis ratio b/a, and its eccentricity squared.
struct Ellipse
{
  double ratio, e2, k, e;

  explicit Ellipse(double b_over_a) : ratio(b_over_a), e2((1 - b_over_a) * (1 + b_over_a))
  {
    const double eccentricity = std::sqrt(e2);
    k = std::comp_ellint_1(eccentricity);
    e = std::comp_ellint_2(eccentricity);
  }
  double flat_part() const { return e / (ratio * ratio) - k; }
  double sharp_part() const { return k - e; }
};

/// b/a of the contact whose radii have the ratio R'/R'' = B/A: eq. 4.28, whose right side falls as b/a rises.
double axis_ratio_of(double ratio_of_radii)
{
  double low = 1e-7, high = 1;
  for (int step = 0; step < 60; ++step) {
    const double middle = std::sqrt(low * high);
    const Ellipse ellipse(middle);
    (ellipse.flat_part() / ellipse.sharp_part() > ratio_of_radii ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

}  // namespace

ContactRadii relative_radii(const ContactRadii& first, const ContactRadii& second, double angle)
{
  const double sum = 1 / first.flatter + 1 / first.sharper + 1 / second.flatter + 1 / second.sharper;
  const double d1 = 1 / first.sharper - 1 / first.flatter, d2 = 1 / second.sharper - 1 / second.flatter;
  const double difference = std::sqrt(d1 * d1 + d2 * d2 + 2 * d1 * d2 * std::cos(2 * angle));
  return {2 / (sum - difference), 2 / (sum + difference)};  // A = (sum - difference)/4 = 1/(2 R')
}

EllipticContact::EllipticContact(const ContactRadii& relative, double e_star)
    : radius_(std::sqrt(relative.flatter * relative.sharper)), e_star_(e_star)
{
  // Nearer to a circle K - E loses its digits, and F1 and F2 differ from 1 by the square of this.
  const double ratio = relative.flatter / relative.sharper;
  if (ratio < 1 + 1e-6) return;
  ratio_ = axis_ratio_of(ratio);
  const Ellipse ellipse(ratio_);
  widening_ = std::cbrt(4 / (pi * ellipse.e2) * std::pow(ratio_, 1.5) *
                        std::sqrt(ellipse.flat_part() * ellipse.sharp_part()));
  approach_ = 2 / pi * std::sqrt(ratio_) * ellipse.k / widening_;
}

double EllipticContact::force(double overlap) const
{
  return 4.0 / 3.0 * e_star_ * std::sqrt(radius_) * std::pow(overlap / approach_, 1.5);
}

double EllipticContact::overlap(double force) const
{
  return approach_ * std::cbrt(9 * force * force / (16 * e_star_ * e_star_ * radius_));
}

double EllipticContact::semi_major(double force) const
{
  return widening_ * std::cbrt(3 * force * radius_ / (4 * e_star_)) / std::sqrt(ratio_);
}

double EllipticContact::semi_minor(double force) const
{
  return semi_major(force) * ratio_;
}

double EllipticContact::peak_pressure(double force) const
{
  return 1.5 * force / (pi * semi_major(force) * semi_minor(force));
}

double EllipticContact::equivalent_radius() const
{
  return radius_ / (approach_ * approach_ * approach_);
}

}  // namespace granulaw
