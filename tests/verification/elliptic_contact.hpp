#pragma once

namespace granulaw {

/// Two radii of curvature at a contact, m, in planes at right angles; flatter >= sharper.
struct ContactRadii
{
  double flatter, sharper;
};

/// Relative radii R' and R'' of two bodies' principal radii: 1/(2 R') = A, 1/(2 R'') = B, where the gap
/// between the bodies is A x^2 + B y^2. `angle`, radians, lies between the planes of the two flatter radii.
/// (Johnson 1985, Contact Mechanics, eqs 4.3 to 4.5.) Infinite radii are flats.
ContactRadii relative_radii(const ContactRadii& first, const ContactRadii& second, double angle);

/// Hertz's contact over an ellipse, elastic (Johnson 1985, section 4.2(c), eqs 4.24 to 4.28), SI. With
/// R_e = sqrt(R' R''), E* = 1/((1 - nu1^2)/E1 + (1 - nu2^2)/E2) and the ellipse's eccentricity e:
///
///     c = sqrt(a b) = (3 P R_e/(4 E*))^(1/3) F1(e)        delta = (9 P^2/(16 E*^2 R_e))^(1/3) F2(e)
///
/// On a rigid wall the bodies' radii are the relative ones.
class EllipticContact
{
 public:
  /// Radii over 0 and finite, m; e_star in Pa. Where flatter is infinite the contact is a line, which Hertz's
  /// theory gives no overlap for.
  EllipticContact(const ContactRadii& relative, double e_star);

  double force(double overlap) const;           ///< N
  double overlap(double force) const;           ///< m
  double semi_major(double force) const;        ///< m, a, in the plane of the flatter radius
  double semi_minor(double force) const;        ///< m, b
  double peak_pressure(double force) const;     ///< Pa, 3 P/(2 pi a b)
  double axis_ratio() const { return ratio_; }  ///< b/a
  /// Radius of the sphere with the same force over overlap on a rigid wall: R_e/F2^3, m.
  double equivalent_radius() const;

 private:
  double radius_, e_star_;  // R_e
  double ratio_ = 1;        // b/a
  double widening_ = 1;     // F1
  double approach_ = 1;     // F2
};

}  // namespace granulaw
