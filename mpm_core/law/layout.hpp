#pragma once

#include "law/law.hpp"

/// Every name, unit and legend of a law file and where it is kept in memory, once: reader, writer and range
/// check go through these tables (layout: docs/reference/law-format.md).
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
inline constexpr int major = 6;                      ///< counts up where an old reader would misread the file
/// Read as well. Files before 6 have no `unloading_radius`, those before 5 no bounds, which follow from their certificates.
inline constexpr int oldest_major = 4;
inline constexpr int minor = 1;                      ///< counts up where something is only added
inline constexpr int first_minor_with_checksum = 1;  ///< files of other writers may say 0 and have none

inline constexpr const char* command = "command";  ///< attribute of provenance: what made the file

// Attributes of every dataset.
inline constexpr const char* unit = "unit";
inline constexpr const char* legend = "legend";

// Groups and the one text dataset.
inline constexpr const char* provenance = "provenance";    ///< group; string attributes
inline constexpr const char* pairs = "pairs";              ///< dataset of "a:b" and "a:wall"
inline constexpr const char* bodies = "bodies";            ///< group; one subgroup for each material
inline constexpr const char* material = "material";        ///< bodies/<name>/material, scalars
inline constexpr const char* curve = "curve";              ///< bodies/<name>/curve, nodes
inline constexpr const char* certificate = "certificate";  ///< bodies/<name>/certificate, scalars
inline constexpr const char* origin =
    "origin";  ///< string attribute of certificate: "runs", "atlas" or "composed"
inline constexpr const char* body = "body";                    ///< string attribute of bodies/<name>
inline constexpr const char* velocity_axis = "velocity_axis";  ///< bodies/<name>/velocity_axis, if it has one
inline constexpr const char* orientations =
    "orientations";                            ///< bodies/<name>/orientations, if it has a shape
inline constexpr const char* shape = "shape";  ///< string attribute of it: the body's definition
inline constexpr const char* kind = "kind";    ///< string attribute of it
inline constexpr const char* kind_inertia = "inertia";
inline constexpr const char* kind_rate = "logarithmic rate";

// Laws of pairs of their own, if there are any
inline constexpr const char* pair_laws = "pair_laws";  ///< group; one subgroup "a:b" for each, as in `pairs`
/// Ratios of a pair; with several, each law stands in a subgroup "1", "2", ...; absent: against a deformable
/// wall.
inline constexpr Field radius_ratio_of_runs{"radius_ratio_of_runs", "1",
                                            "partner's radius over the yielding body's"};

/// Of files of major version 4: in their checksum, of no other use.
inline constexpr Field older_pair_fields[] = {{"pair_reduction_error_force", "1", ""}, {"pair_reduction_error_restitution", "1", ""}};

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
// since minor version 2
inline constexpr Field flow_strain{"flow_strain", "1",
                                   "equivalent plastic strain, ascending from 0; absent: hardens linearly"};
inline constexpr Field flow_stress{"flow_stress", "Pa", "flow stress at flow_strain; linear between, constant beyond"};

// bodies/<name>/curve
inline constexpr Field onset{"onset", "1", "x at the onset of yield; absent: never"};
inline constexpr Field end{"end", "1", "x = overlap/(lambda R*) up to which the law holds"};
inline constexpr Field octaves{
    "octaves", "1",
    "from the first node to the onset (elastic: to 1); 8 nodes an octave, node 8 k + "
    "j at (1 + j/8) 2^(k - octaves) onset"};

/// A column: its values have this name, its slopes this and "_slope".
template <class Table>
struct ColumnField
{
  Field values, slopes;
  HermiteColumn Table::*column;
};
inline constexpr ColumnField<CurveTable> curve_columns[] = {
    {{"force", "1", "loading force over 4/3 E* lambda R*^2"},
     {"force_slope", "1", "d(force)/dx"},
     &CurveTable::force},
    {{"radius", "1", "contact radius over sqrt(lambda) R*"},
     {"radius_slope", "1", "d(radius)/dx"},
     &CurveTable::radius},
    {{"kept", "1", "work returned over work of loading, of a reversal at x; from the onset on"},
     {"kept_slope", "1", "d(kept)/dx"},
     &CurveTable::kept},
    {{"span", "1", "1 - residual overlap over largest overlap x; from the onset on"},
     {"span_slope", "1", "d(span)/dx"},
     &CurveTable::span},
    {{"hertz_share", "1", "A of the unloading F_m (A u^1.5 + B u^2 + C u^2.5); from the onset on"},
     {"hertz_share_slope", "1", "d(hertz_share)/dx"},
     &CurveTable::hertz_share}};

/// Beside the columns, without slopes: linear between nodes.
inline constexpr Field unloading_radius{
    "unloading_radius", "1",
    "contact radius below a reversal at x over that at x times sqrt(u), at sqrt(u) = 0, 1/3, 2/3, node after node; from the onset on"};

// bodies/<name>/velocity_axis
struct AxisNumber
{
  Field field;
  double AxisTable::*value;
  bool of_rate;  ///< absent where the axis is one of inertia
};
inline constexpr AxisNumber axis_numbers[] = {
    {{"reference_radius", "m", "R_ref of v; absent: kind inertia"}, &AxisTable::reference_radius, true},
    {{"speed_begin", "1", "v of the first level, the slowest impact stored; absent: kind inertia"},
     &AxisTable::speed_begin,
     true},
    {{"speed_end", "1", "v at the last node of reach; nodes even in v from 0"}, &AxisTable::speed_end, false},
    {{"share_end", "1", "x/X at the last node of force; nodes even in x/X from 0"},
     &AxisTable::share_end,
     false}};
inline constexpr ColumnField<AxisTable> axis_columns[] = {
    {{"reach", "1", "X = overlap/(lambda R*) at which an impact at v reverses"},
     {"reach_slope", "1", "d(reach)/dv"},
     &AxisTable::reach},
    {{"force", "1", "A: loading force over the curve's, less 1; level after level"},
     {"force_slope", "1", "dA/d(x/X)"},
     &AxisTable::force}};
struct ListField
{
  Field field;
  std::vector<double> AxisTable::*values;
};
inline constexpr ListField axis_lists[] = {
    {{"level", "1", "X of each level"}, &AxisTable::level},
    {{"kept", "1", "work returned over work of loading, of an impact that reverses at the level"},
     &AxisTable::kept},
    {{"span", "1", "1 - residual overlap over largest overlap of such an impact"}, &AxisTable::span}};

// bodies/<name>/certificate
struct CertificateField
{
  Field field;
  double Certificate::*value;
  bool is_signed = false;
};
inline constexpr CertificateField certificate_fields[] = {
    {{"solver_error_force", "1", "relative, of F, by two resolutions"}, &Certificate::solver_error_force},
    {{"solver_error_restitution", "1", "relative, of e, by two resolutions"},
     &Certificate::solver_error_restitution},
    {{"interpolation_error", "1", "relative, table against the fitted curve it was made from"},
     &Certificate::interpolation_error},
    {{"held_out_error", "1", "largest relative error of e at a press depth left out of the fit"},
     &Certificate::held_out_error},
    {{"residual_scatter", "1", "relative rms of the runs about the fit"}, &Certificate::residual_scatter},
    {{"reload_loop_area", "1", "largest area of an unload/reload loop over the loading work there"},
     &Certificate::reload_loop_area},
    {{"verification_error_force", "1", "largest relative error of F_max, replay against impacts"},
     &Certificate::verification_error_force},
    {{"verification_error_restitution", "1", "largest relative error of e, replay against impacts"},
     &Certificate::verification_error_restitution},
    {{"verification_impacts", "1", "number of impacts compared; 0: none"},
     &Certificate::verification_impacts},
    {{"max_inertia", "1", "I = rho V^2/Y up to which the law holds"}, &Certificate::damage_number_max},
    {{"axis_cost_force", "1",
      "F_max without the velocity axis over F_max with it, less 1, at its end; signed"},
     &Certificate::axis_cost_force,
     true},
    {{"axis_cost_restitution", "1", "e without the velocity axis over e with it, less 1, at its end; signed"},
     &Certificate::axis_cost_restitution,
     true},
    {{"atlas_error_force", "1", "relative, of an interpolated law; 0: computed by runs"},
     &Certificate::atlas_error_force},
    {{"atlas_error_restitution", "1", "absolute in e, of an interpolated law; 0: computed by runs"},
     &Certificate::atlas_error_restitution}};
/// The final bound, beside the certificate; absent in files of major version 4.
struct BoundField
{
  Field field;
  double ErrorBound::*value;
};
inline constexpr BoundField bound_fields[] = {
    {{"bound_force", "1", "error bound of F_max, relative: 95 % of impacts lie within"}, &ErrorBound::force},
    {{"bound_restitution", "1", "the same of e, absolute"}, &ErrorBound::restitution},
    {{"bound_relative_restitution", "1", "the same of e, relative; the squares of both add"}, &ErrorBound::relative_restitution},
    {{"bound_swing_force", "1", "further error of F_max of an elastic sphere, over V/c*"}, &ErrorBound::swing_force},
    {{"bound_swing_restitution", "1", "the same of e"}, &ErrorBound::swing_restitution},
    {{"bound_size_force", "1", "further error of F_max over a distance of 0.025 and more in R_s/(R_s + R_h); infinity: not stated"}, &ErrorBound::size_force},
    {{"bound_size_restitution", "1", "the same of e"}, &ErrorBound::size_restitution},
    {{"bound_confined_force", "1", "further error of F of a particle pressed from all sides; infinity: not stated"}, &ErrorBound::confined_force}};
/// Lists of ErrorBound::omitted_axis: all or none, of equal length, ascending in the first.
struct AxisCostField
{
  Field field;
  double AxisCost::*value;
};
inline constexpr AxisCostField axis_cost_fields[] = {
    {{"omitted_axis_speed", "1", "v = sqrt(I) of the velocity axis that was left out; absent: none was"}, &AxisCost::speed},
    {{"omitted_axis_force", "1", "F_max without it over F_max with it, less 1, at these speeds; signed"},
     &AxisCost::force},
    {{"omitted_axis_restitution", "1", "e without it over e with it, less 1, at these speeds; signed"},
     &AxisCost::restitution}};
inline constexpr const char* origins[] = {"runs", "atlas", composed_origin};

// bodies/<name>/orientations: lists of equal length, one entry for each impact
inline constexpr Field shape_volume{"volume", "m^3", "volume of the body"};
inline constexpr Field orientations_solver_error{"solver_error", "1",
                                                 "relative, of F_max and e: four impacts by two resolutions"};
inline constexpr Field mirrors{"mirrors", "1",
                               "1: the plane x = 0 (y, z) is a mirror of the body; entries lie on one side"};
inline constexpr Field contact_kind{
    "contact", "1", "0: curved, the law applies; 1: edge; 2: flat or hollow; 3: beyond the law's table"};
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
inline constexpr Field height{"height", "m", "of the centre of mass over the contact; absent: not stated"};
inline constexpr Field body_force_max{"body_force_max", "N",
                                      "by the law with the body behind the contact; 0: no answer"};
inline constexpr Field body_restitution{"body_restitution", "1", "the same of e"};

}  // namespace granulaw::h5
