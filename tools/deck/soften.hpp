#pragma once

#include <string>
#include <vector>

#include "deck/plan.hpp"

namespace granulaw::deck {

/// Limits on the error of a stretched law F(delta/s)/s (docs/guide/plan.md).
struct SoftenLimits
{
  double overlap = 0.2;         ///< largest s delta_max/R*
  double time_fraction = 0.1;   ///< longest s t_contact over the flow's own time
  double static_load = 1.0;     ///< largest s P_static/F_y; above 1 the bed takes an extra plastic set
  double fill_height = 0;       ///< m, of the bed; 0: estimated from the particles and the walls
  double solid_fraction = 0.6;  ///< of the bed
};

/// Stretch that one pair allows.
struct PairStretch
{
  const PairPlan* pair = nullptr;
  double by_overlap = 0, by_time = 0, by_static = 0;  ///< largest s by each limit; infinity: no bound
  double slow_speed = 0;                              ///< m/s: of the slowest impact that counts, a fall through one diameter
  double contact_time = 0;                            ///< s, Hertz's, at that speed
  double static_load = 0;                             ///< N on a contact at the bed's bottom
  double yield_load = 0;                              ///< F_y, N, of the smallest particles; infinity: elastic
};

struct Softening
{
  std::vector<PairStretch> pairs;
  double stretch = 1;       ///< the largest s within all limits, at least 1; rounded down to two digits
  std::string bound;        ///< which limit binds, and where
  double flow_time = 0;     ///< s: the fall through one radius, or the walls' time over a diameter
  double fill_height = 0;   ///< m
  double time_step = 0;     ///< s, the plan's under this stretch
  double static_ratio = 0;  ///< largest s P_static/F_y
  double extra_set = 0;     ///< its plastic overlap over R*, by Thornton's p_y = 1.6 Y; 0: below yield
  double overlap = 0;       ///< s delta_max/R*
  /// The naive way to the same time step: Young's modulus over s^2.5.
  struct Naive
  {
    std::string pair, basis;  ///< basis: "law" or "Thornton"
    double speed = 0, e = 1, e_naive = 1;
  };
  double modulus_factor = 1;
  std::vector<Naive> naive;
};

Softening soften(const Scene& scene, const Plan& plan, const PlanOptions& options, const SoftenLimits& limits);

}  // namespace granulaw::deck
