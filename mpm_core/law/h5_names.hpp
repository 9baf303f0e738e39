#pragma once

/// Every name, unit and legend of a law file, shared by writer and reader (layout:
/// docs/reference/law-format.md).
namespace granulaw::h5 {

/// A dataset: its name, and what its attributes `unit` and `legend` say. Unit "1": a pure number.
struct Field
{
  const char* name;
  const char* unit;
  const char* legend;
};

// Attributes of the root group.
inline constexpr const char* format = "format";
inline constexpr const char* format_value = "granulaw-law";
inline constexpr const char* version_major = "version_major";
inline constexpr const char* version_minor = "version_minor";
inline constexpr int major = 3;                      ///< counts up where an old reader would misread the file
inline constexpr int minor = 2;                      ///< counts up where something is only added
inline constexpr int first_minor_with_checksum = 2;  ///< older files of this major version have none

// Attributes of every dataset.
inline constexpr const char* unit = "unit";
inline constexpr const char* legend = "legend";

// Groups and the one text dataset.
inline constexpr const char* provenance = "provenance";       ///< group; string attributes
inline constexpr const char* pairs = "pairs";                 ///< dataset of "a:b" and "a:wall"
inline constexpr const char* bodies = "bodies";               ///< group; one subgroup for each material
inline constexpr const char* material = "material";           ///< bodies/<name>/material, scalars
inline constexpr const char* curve = "curve";                 ///< bodies/<name>/curve, nodes
inline constexpr const char* certificate = "certificate";     ///< bodies/<name>/certificate, scalars
inline constexpr const char* support = "support";             ///< string attribute of certificate
inline constexpr const char* origin = "origin";               ///< the same: "runs", "atlas" or "composed"
inline constexpr const char* body = "body";                   ///< string attribute of bodies/<name>
inline constexpr const char* velocity_axis = "inertia_axis";  ///< bodies/<name>/inertia_axis, if it has one
inline constexpr const char* orientations =
    "orientations";                            ///< bodies/<name>/orientations, if it has a shape
inline constexpr const char* shape = "shape";  ///< string attribute of it: the body's definition
inline constexpr const char* kind = "kind";    ///< string attribute of it
inline constexpr const char* kind_inertia = "inertia";
inline constexpr const char* kind_rate = "logarithmic rate";

// Laws of pairs of their own, if there are any
inline constexpr const char* pair_laws = "pair_laws";  ///< group; one subgroup "a:b" for each, as in `pairs`
/// Of a pair with several ratios each stands in a subgroup "1", "2", ...; absent: against a thick wall.
inline constexpr Field radius_ratio_of_runs{"radius_ratio_of_runs", "1",
                                            "partner's radius over the yielding body's"};

// Beside `pairs`, in its order.
inline constexpr Field pair_reduction_error_force{
    "pair_reduction_error_force", "1", "relative error of F_max by the pair rule, for each of pairs"};
inline constexpr Field pair_reduction_error_restitution{
    "pair_reduction_error_restitution", "1", "relative error of e by the pair rule, for each of pairs"};

// bodies/<name>
inline constexpr Field pole_radius{"pole_radius", "m",
                                   "radius of curvature at the pole, as computed; 0: any (spheres)"};
inline constexpr Field mass_ratio{"mass_ratio", "1", "mass over density 4/3 pi R^3, R at the pole"};

// bodies/<name>/material
inline constexpr Field density{"density", "kg/m^3", "mass density"};
inline constexpr Field youngs_modulus{"youngs_modulus", "Pa", "Young's modulus E"};
inline constexpr Field poisson_ratio{"poisson_ratio", "1", "Poisson's ratio nu"};
inline constexpr Field yield_stress{"yield_stress", "Pa", "uniaxial yield stress Y; absent: elastic"};
inline constexpr Field hardening_modulus{"hardening_modulus", "Pa",
                                         "linear hardening d(yield stress)/d(equivalent plastic strain)"};

// bodies/<name>/curve
inline constexpr Field s_end{"s_end", "1",
                             "s = x^(1/4) at the last node, x = overlap/(lambda R*); nodes uniform in s"};
inline constexpr Field onset{"onset", "1", "x at the onset of yield; absent: never"};
inline constexpr Field force_ratio{"force_ratio", "1", "loading force over Hertz's 4/3 E* R^2 x^1.5"};
inline constexpr Field force_ratio_slope{"force_ratio_slope", "1", "d(force_ratio)/ds"};
inline constexpr Field residual_ratio{"residual_ratio", "1", "residual overlap over largest overlap x"};
inline constexpr Field residual_ratio_slope{"residual_ratio_slope", "1", "d(residual_ratio)/ds"};
inline constexpr Field exponent{"exponent", "1",
                                "n = d ln F/d ln u at the reversal, of the unloading F = F_m phi(u)"};
inline constexpr Field exponent_slope{"exponent_slope", "1", "d(exponent)/ds"};
inline constexpr Field hertz_share{"foot", "1", "A of phi = A u^1.5 + B u^2 + C u^2.5"};
inline constexpr Field hertz_share_slope{"foot_slope", "1", "d(hertz_share)/ds"};
inline constexpr Field radius_ratio{"radius_ratio", "1", "contact radius over Hertz's R sqrt(x)"};
inline constexpr Field radius_ratio_slope{"radius_ratio_slope", "1", "d(radius_ratio)/ds"};

// bodies/<name>/inertia_axis
inline constexpr Field reference_radius{"reference_radius", "m", "R_ref of v; absent: kind inertia"};
inline constexpr Field speed_begin{"speed_begin", "1",
                                   "v of level 1, the slowest impact known; absent: kind inertia"};
inline constexpr Field speed_end{"speed_end", "1",
                                 "v at the last node of impact_overlap; nodes uniform in v"};
inline constexpr Field impact_overlap{"impact_overlap", "1",
                                      "X = overlap/(lambda R*) at which an impact at v reverses"};
inline constexpr Field impact_overlap_slope{"impact_overlap_slope", "1", "d(impact_overlap)/dv"};
inline constexpr Field levels{"slices", "1", "number K of levels; where they lie in X: law-format.md"};
inline constexpr Field first_levels{"first_slices", "1", "how many of them divide the first spacing evenly"};
inline constexpr Field ratio_end{"ratio_end", "1", "xi = x/X at the last node; nodes uniform in xi"};
inline constexpr Field force_correction{
    "force_correction", "1", "A: loading force over the curve's, less 1; impact level after impact level"};
inline constexpr Field force_correction_slope{"force_correction_slope", "1", "dA/dxi"};
inline constexpr Field residual_correction{"residual_correction", "1", "B: added to residual_ratio"};
inline constexpr Field residual_correction_slope{"residual_correction_slope", "1", "dB/dxi"};
inline constexpr Field exponent_correction{"exponent_correction", "1", "N: added to exponent"};
inline constexpr Field exponent_correction_slope{"exponent_correction_slope", "1", "dN/dxi"};

// bodies/<name>/certificate
inline constexpr Field solver_error_force{"solver_error_force", "1", "relative, of F, by two resolutions"};
inline constexpr Field solver_error_restitution{"solver_error_restitution", "1",
                                                "relative, of e, by two resolutions"};
inline constexpr Field interpolation_error{"interpolation_error", "1",
                                           "relative, table against the fitted curve it was made from"};
inline constexpr Field held_out_error{"held_out_error", "1",
                                      "largest relative error of e at a press depth left out of the fit"};
inline constexpr Field residual_scatter{"residual_scatter", "1", "relative rms of the runs about the fit"};
inline constexpr Field reload_loop_area{"reload_loop_area", "1",
                                        "largest area of an unload/reload loop over the loading work there"};
inline constexpr Field slow_press_force{
    "slow_press_force", "1", "force of a slow press over the impact's at its overlap, less 1; signed"};
inline constexpr Field slow_press_restitution{
    "slow_press_restitution", "1", "e of a slow press over the impact's at its overlap, less 1; signed"};
inline constexpr Field verification_error_force{"verification_error_force", "1",
                                                "largest relative error of F_max, replay against impacts"};
inline constexpr Field verification_error_restitution{"verification_error_restitution", "1",
                                                      "largest relative error of e, replay against impacts"};
inline constexpr Field verification_impacts{"verification_impacts", "1",
                                            "number of impacts compared; 0: none"};
inline constexpr Field damage_number_max{"max_inertia", "1", "I = rho V^2/Y up to which the law holds"};
inline constexpr Field axis_cost_force{
    "axis_cost_force", "1", "F_max without the velocity axis over F_max with it, less 1, at its end; signed"};
inline constexpr Field axis_cost_restitution{
    "axis_cost_restitution", "1", "e without the velocity axis over e with it, less 1, at its end; signed"};
inline constexpr Field atlas_error_force{"atlas_error_force", "1",
                                         "relative, of an interpolated law; 0: computed by runs"};
inline constexpr Field atlas_error_restitution{"atlas_error_restitution", "1",
                                               "absolute in e, of an interpolated law; 0: computed by runs"};

// bodies/<name>/orientations: lists of equal length, one entry for each impact
inline constexpr Field shape_volume{"volume", "m^3", "volume of the body"};
inline constexpr Field orientations_solver_error{"solver_error", "1",
                                                 "relative, of F_max and e: four impacts by two resolutions"};
inline constexpr Field mirrors{"mirrors", "1",
                               "1: the plane x = 0 (y, z) is a mirror of the body; entries lie on one side"};
inline constexpr Field contact_kind{
    "contact", "1", "0: curved, the law answers; 1: edge; 2: flat or hollow; 3: beyond the law's table"};
inline constexpr Field direction_x{"direction_x", "1",
                                   "unit vector in the body's frame that points at the wall"};
inline constexpr Field direction_y{"direction_y", "1", "the same"};
inline constexpr Field direction_z{"direction_z", "1", "the same"};
inline constexpr Field velocity{"velocity", "m/s", "of the impact on the rigid wall, without friction"};
inline constexpr Field sharper_radius{"sharper_radius", "m",
                                      "R', smaller principal radius of curvature that touches; 0: an edge"};
inline constexpr Field flatter_radius{"flatter_radius", "m", "R'', the larger one; infinity: flat"};
inline constexpr Field effective_mass{"effective_mass", "1", "mass that resists there over the body's"};
inline constexpr Field solver_force_max{"force_max", "N", "largest force, by the solver"};
inline constexpr Field solver_restitution{"restitution", "1", "e = sqrt(W_u/W_l), by the solver"};
inline constexpr Field law_force_max{"law_force_max", "N",
                                     "by the law of a sphere of radius sqrt(R' R''); 0: no answer"};
inline constexpr Field law_restitution{"law_restitution", "1", "the same of e"};

}  // namespace granulaw::h5
