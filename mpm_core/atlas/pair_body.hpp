#pragma once

#include <array>
#include <vector>

#include "atlas/departure.hpp"
#include "atlas/stand_in.hpp"
#include "law/contact_law.hpp"
#include "law/law_material.hpp"

namespace granulaw {

/// Position of a contact's pressure between Hertz's (0) and uniform (1), and its consequences for an elastic
/// half-space under a mean pressure p over a circle of radius a (Johnson, Contact Mechanics, sect. 3.2
/// and 3.4).
struct PressureShape
{
  /// By the residual overlap over the recovered one. Measured: the recovered overlaps of the atlas's laws
  /// follow 1 - exp(-ratio/0.4) within 0.02 up to a ratio of 1.1, whatever E*/Y, nu and H.
  static double flatness_of(double residual_over_recovered);

  /// Displacement of the middle, over pi p a/E*: 3/4 to 2/pi.
  static double displacement(double flatness);
  /// Work given back, over F pi p a/E*: 0.3 to 8/(3 pi^2).
  static double work(double flatness);
  /// Height of the edge above the middle, over pi p a/E*: 3/8 to 2/pi - 4/pi^2.
  static double sag(double flatness);
  /// Mean pressure at which material under this shape yields as much as under Hertz's: 1 to 1.25. At first
  /// yield a uniform pressure's is 1.5 Y, Hertz's 1.07 Y; in full plasticity both are hardness. The mean of
  /// the two ends.
  static double strength(double flatness);
};

/// One sphere of a pair, pressed by a partner of any curvature.
///
/// A partner shows a sphere of radius R a surface that is not flat. Only the curvature 1/r between the two
/// counts for what happens near the contact, of radius a: kappa = a/r; and alpha = a/R for the sphere as a
/// whole. A sphere on a rigid flat has kappa = alpha. Strains go as kappa, the solution depends on kappa E*/Y
/// and alpha: so the sphere is as its equivalent sphere on a rigid flat, of the same Y, nu, H/E, of alpha' = a/R' and of
/// the stiffness E* kappa/alpha': with the same pressure, and overlaps kappa/alpha' times the equivalent
/// sphere's. The atlas holds the equivalent spheres.
///
/// alpha' is alpha, but for a surface that its partner hollows out (kappa > alpha). Yielding material flows out of a
/// hollow more easily than from under a flat, as it does from a contact that is wide against its sphere:
/// alpha' = alpha + (kappa - alpha)^2. A body on a flat or its like, and one that its partner wraps, has its own alpha.
class PairBody
{
 public:
  /// Throws Error where the atlas has no law of the material.
  PairBody(const Atlas& atlas, const LawMaterial& material);
  /// A homogeneous, rate-independent body of another flow law, with its `own` slow law on a rigid flat. Its
  /// equivalent spheres strain 1/q as much at the same stress (of_twin), and depart from the atlas's laws at the
  /// same overlap/onset as the body does from its own (Departure). Within its own law's overlap/onset.
  PairBody(const Atlas& atlas, const LawMaterial& material, FlowCurve flow, const Curve& own);

  /// At contact radius a.
  struct State
  {
    double pressure = 0;           ///< Pa, mean
    double residual = 0;           ///< residual overlap over a
    double recovered = 0;          ///< recovered overlap over a
    double returned = 0;           ///< work given back over F a
    double flatness = 0;           ///< of the pressure
    double log_yield_overlap = 0;  ///< ln(overlap/overlap at first yield); elastic: below 0
    bool known = true;             ///< within the range of the atlas, and of the own law
  };
  /// `curvature`: kappa > 0; `contact`: alpha, 0 for a deformable wall.
  State at(double curvature, double contact) const;

  /// Hertz's share of an unloading, and k - k_elastic of its radius (LawShape).
  using Unloading = std::array<double, 4>;
  /// That of the equivalent sphere whose residual overlap is this over the recovered one: dents of one shape are reloaded
  /// with one shape of the pressure.
  Unloading unloading(double curvature, double contact, double residual_over_recovered) const;

  /// The same sphere, if it never yielded.
  PairBody elastic() const;

  const LawMaterial& material() const { return material_; }
  const MaterialRatios& ratios() const { return ratios_; }
  /// Its own law, from which velocity effects are taken.
  LawShape own_shape(const Atlas& atlas) const { return shape(atlas, ratios_.stiffness); }
  bool yields() const { return !twins_.empty(); }
  /// k of the finite sphere: its centre comes nearer by k F/(E* R) less than its half-space's.
  double finite_body() const { return finite_body_; }
  /// The solver's error in its law, relative: as that of the atlas's (Atlas::bounds_near).
  double solver_error() const { return solver_error_; }

 private:
  /// Equivalent sphere of one stiffness, at equal steps of ln(overlap/overlap at first yield).
  struct Twin
  {
    double log_stiffness = 0, log_end = 0;  // ln(E*/Y); where the atlas ends
    std::vector<double> log_contact, log_pressure, log_overlap, log_lost, unloading_work;
    std::vector<Unloading> unloading;
  };
  /// The equivalent sphere of a stiffness between those kept.
  struct Mixed
  {
    double share;       // of its stiffness in the body's own
    std::size_t first;  // of the kept ones between which it lies
    std::array<double, 4> weights;
    double contact;   // alpha'
    bool is_clipped;  // nearest to one that the atlas does not know
  };
  void make_twins(const Atlas& atlas);
  static Twin tabulated(const ContactLaw& law, const ElasticCorrection& elastic, double stiffness,
                        double onset, double depth);
  Twin twin(const Atlas& atlas, double stiffness) const;
  LawShape shape(const Atlas& atlas, double stiffness) const;
  Mixed twin_at(double curvature, double contact) const;
  double value(const Mixed& twin, const std::vector<double> Twin::*member, int node) const;
  /// Node below which a rising function of the equivalent sphere is `wanted`, with its fraction.
  double place(const Mixed& twin, const std::vector<double> Twin::*member, double wanted) const;
  double value(const Mixed& twin, const std::vector<double> Twin::*member, double place) const;
  double elastic_overlap(double contact) const;
  State elastic_at(double curvature, double contact) const;

  LawMaterial material_;
  MaterialRatios ratios_;
  FlowCurve flow_;  ///< null: linear
  Departure departure_;
  ElasticCorrection elastic_;
  double finite_body_ = 0, solver_error_ = 0;
  std::vector<Twin> twins_;
  std::vector<double> log_stiffnesses_;
};

}  // namespace granulaw
