#pragma once

#include "law/law_material.hpp"

namespace granulaw {

/// Energy that waves carry from a contact into its two bodies and that does not return in time.
///
/// A half-space radiates N/(rho c^3) (dF/dt)^2, W, of a slow force F(t) on its surface, c = sqrt(E*/rho), N the
/// radiation_number. A sphere of radius R gives back what returns while the contact lasts: there remains
/// G = 1/(1 + (c t/(4 R))^4) of it.
///
/// With dF/dt = K d(delta)/dt, K the contact's stiffness, it is a dashpot: F_waves = C K^2 d(delta)/dt, which
/// only dissipates. C is the sum of N G/(rho c^3) over both bodies.
inline constexpr double return_times = 4.0;
/// N of a Poisson's ratio from 0 to below 0.5: .605 at 0, .663 at .3, .819 at .49. Bulk and surface waves under a
/// point force, from Lamb's integral (Miller and Pursey, Proc. R. Soc. A 223, 1954; for impacts Hunter, J. Mech. Phys.
/// Solids 5, 1957). Six elastic impacts on deformable walls (nu = .3) by the solver: .658 to .706.
double radiation_number(double poisson_ratio);

/// G below which a body counts as giving everything back, so that like spheres cost nothing: 0.05 of what a
/// half-space takes is less than 0.002 of e at the fastest impact that a composed law was measured at (I =
/// 0.003).
inline constexpr double negligible_radiation = 0.05;

/// C of two solid spheres, s^3/kg; radius (m): infinity for a deformable wall. Only ratios of radii count.
///
/// The contact's duration t: that of a plastic contact, sqrt(m*/(R* Y)), which does not depend on the speed,
/// but no less than Hertz's at a twentieth of the softer one's wave speed: a soft partner lengthens it, and
/// the contact hardly yields. Of two elastic bodies Hertz's at a hundredth of that speed.
double radiation(const LawMaterial& a, double radius_a, const LawMaterial& b, double radius_b);

}  // namespace granulaw
