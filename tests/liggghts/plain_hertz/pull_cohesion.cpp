// A piece beside the laws for the model plain_hertz: `cohesion pull`. Particles that have touched pull at each other by
// `pullForce` (N, of the pair of types) times both their `charge`, until the gap is a tenth of R*.
#include "liggghts_plugin/loop/registration.hpp"
#include "plain_hertz_physics.hpp"

namespace granulaw::plugin {

struct Pull
{
  static constexpr std::array history_values{HistoryValue{"touched"}};
  static constexpr const char *property = "pullForce", *particle_values = "charge";
  static constexpr int particle_count = 2;  // the first counts

  double force = 0;  // N

  Pull() = default;
  Pull(const PlainHertzContact&, double of_types) : force(of_types) {}

  static double reach(double r_eff) { return 0.1 * r_eff; }
  static bool holds(const double* history) { return history[0] > 0.0; }
  double advance(const PlainHertzContact&, const ContactMotion& m, double, double*, double* history, Ledger&) const
  {
    if (m.advances && m.overlap > 0.0) history[0] = 1.0;
    return holds(history) ? -force * m.of_i[0] * (m.of_j ? m.of_j[0] : 1.0) : 0.0;
  }
};
static_assert(StandsBeside<Pull, PlainHertzContact>);

namespace {

[[maybe_unused]] const bool pull_registered = (add_beside<PlainHertzPhysics, Pull>("pull", 51), true);

}  // namespace

}  // namespace granulaw::plugin
