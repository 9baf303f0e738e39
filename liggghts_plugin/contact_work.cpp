#include "liggghts_plugin/contact_work.hpp"

#include <fmt/format.h>

#include "liggghts_plugin/mpm_physics.hpp"
#include "liggghts_plugin/thornton_physics.hpp"

namespace granulaw::plugin {

namespace {

/// Thornton's formula ends nowhere; its stiffness is quoted at this overlap/R*, deeper than impacts of grains
/// go.
constexpr double thornton_depth = 0.1;

double time_step(double stiffness, double m_eff)
{
  return dt_fraction * 2.0 * M_PI * std::sqrt(m_eff / stiffness);
}

std::string error_text(const Certificate& c)
{
  if (c.verification_impacts > 0)
    return fmt::format("F {:.2g} %, e {:.2g} %{}", 100 * c.verification_error_force,
                       100 * c.verification_error_restitution,
                       c.origin == "atlas" ? " (atlas)" : " against fresh impacts");
  if (c.origin == "atlas")
    return fmt::format("F {:.2g} %, e {:.2g} (atlas)", 100 * c.atlas_error_force, c.atlas_error_restitution);
  return "not stated";
}

}  // namespace

double stored_energy(const MpmContact& contact, double r_eff, double delta, double delta_max,
                     double impact_overlap)
{
  const double length = r_eff / contact.per_lambda;
  const double unit = contact.force_scale * r_eff * r_eff * length;
  const double x = delta / length, x_max = std::max(delta, delta_max) / length;
  const ContactCurve& curve = contact.curve->curve();
  if (x_max <= curve.onset()) return unit * curve.work_loading(x, impact_overlap);
  const ContactCurve::Reversal top = curve.reversal(x_max, impact_overlap);
  const double span = x_max - top.residual, u = (x - top.residual) / span;
  return u > 0.0 ? unit * top.force * span * top.shape.work(u) : 0.0;
}

// F(d/S)/S does the same work to S times the overlap, and is softer by S^2.
double stored_energy(const ThorntonContact& contact, double r_eff, double delta, double delta_max, double)
{
  return contact.law.stored_energy(r_eff, contact.per_stretch * delta, contact.per_stretch * delta_max);
}

double stiffness(const MpmContact& contact, double r_eff, double delta, double impact_overlap)
{
  const double length = r_eff / contact.per_lambda;
  const double unit = contact.force_scale * r_eff * r_eff / length;
  const ContactCurve& curve = contact.curve->curve();
  const double x = delta / length;
  if (x <= curve.onset()) return unit * curve.loading(x, impact_overlap).stiffness;
  const ContactCurve::Reversal top = curve.reversal(x, impact_overlap);
  return unit * std::max(top.stiffness, top.shape.exponent * top.force / (x - top.residual));
}

double stiffness(const ThorntonContact& contact, double r_eff, double delta, double)
{
  const double real = contact.per_stretch * delta;
  return contact.per_stretch * contact.per_stretch *
         std::max(contact.law.evaluate(r_eff, real, real).stiffness,
                  contact.law.unloading_stiffness(r_eff, real));
}

PairInfo describe(const MpmContact& contact, const Setup& setup, const PairKey& key, double r_eff,
                  double m_eff)
{
  const auto name = [&](int type) { return setup.options.materials[static_cast<std::size_t>(type - 1)]; };
  PairInfo info;
  info.a = name(key.i);
  info.b = key.kind == PairKey::rigid_wall ? wall_name : name(key.j);
  info.law = fmt::format("mpm {}", setup.law->path);
  const LawPair* pair = setup.law->law.find_pair(info.a, info.b);
  const bool exact = info.a == info.b || key.kind == PairKey::rigid_wall;
  const BodyLaw& body = *contact.law.yielding;
  const auto of_body = setup.law->law.bodies.find(body.material.name);
  const bool of_pair = of_body != setup.law->law.bodies.end() && contact.law.curve != &of_body->second.curve;
  info.rule = exact || of_pair ? "own"
              : pair && pair->reduction_error_restitution > 0
                  ? fmt::format("reduced (e {:.2g} %)", 100 * pair->reduction_error_restitution)
                  : "reduced";
  info.error = error_text(body.certificate);
  if (body.material.yields()) info.stiffness_ratio = body.material.e_star() / body.material.yield_stress;
  info.overlap_limit = contact.largest_overlap();
  info.damage_number_limit = body.certificate.damage_number_max;
  const double onset = contact.curve->curve().onset() / contact.per_lambda;  // over R*
  info.onset_speed = std::numeric_limits<double>::infinity();
  if (!(r_eff > 0)) return info;
  if (onset < info.overlap_limit)
    info.onset_speed =
        std::sqrt(2.0 * stored_energy(contact, r_eff, onset * r_eff, onset * r_eff, 0.0) / m_eff);
  double hardest = 0;
  constexpr int samples = 64;  // the stiffness varies slowly: it need not be largest at the end
  for (int k = 1; k <= samples; ++k)
    hardest = std::max(hardest, stiffness(contact, r_eff, info.overlap_limit * r_eff * k / samples, 0.0));
  info.dt_limit = time_step(hardest, m_eff);
  return info;
}

PairInfo describe(const ThorntonContact& contact, const Setup&, const PairKey& key, double r_eff,
                  double m_eff)
{
  PairInfo info{.a = "-",
                .b = key.kind == PairKey::rigid_wall ? wall_name : "-",
                .law = "thornton",
                .rule = "closed form",
                .error = fmt::format("time step at d/R* = {:.2g}", thornton_depth)};
  info.stiffness_ratio = 1.6 * contact.law.e_star / contact.law.yield_pressure;
  info.overlap_limit = std::numeric_limits<double>::infinity();
  info.onset_speed = std::numeric_limits<double>::infinity();
  if (!(r_eff > 0)) return info;
  const double onset = contact.yield_overlap() * r_eff;
  info.onset_speed = std::sqrt(2.0 * stored_energy(contact, r_eff, onset, onset, 0.0) / m_eff);
  info.dt_limit =
      time_step(stiffness(contact, r_eff, thornton_depth * r_eff / contact.per_stretch, 0.0), m_eff);
  return info;
}

}  // namespace granulaw::plugin
