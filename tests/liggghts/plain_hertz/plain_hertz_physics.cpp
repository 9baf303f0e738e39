#include "plain_hertz_physics.hpp"

#include "base/scales.hpp"
#include "liggghts_plugin/deck/session.hpp"

namespace granulaw::plugin {

void PlainHertzPhysics::prepare(LAMMPS_NS::LAMMPS*, PropertyRegistry&, const Setup& setup, const Types& types)
{
  const auto& words = setup.options.own_words("modulusFactor");
  const double factor = words.empty() ? 1.0 : std::stod(words[0]);
  per_stretch_ = 1.0 / setup.options.stretch.value_or(1.0);
  compliance_.assign(static_cast<std::size_t>(types.count + 1), 0.0);
  for (std::size_t t = 1; t < compliance_.size(); ++t)
    compliance_[t] = types.units.pressure() /
                     (factor * plane_strain_modulus(types.youngs_modulus[t], types.poisson_ratio[t]));
}

PlainHertzContact PlainHertzPhysics::resolve(int i, int j, bool rigid, const std::string&) const
{
  PlainHertzContact contact;
  contact.e_star = 1.0 / (compliance_[static_cast<std::size_t>(i)] +
                          (rigid ? 0.0 : compliance_[static_cast<std::size_t>(j)]));
  contact.per_stretch = per_stretch_;
  return contact;
}

PairInfo PlainHertzPhysics::describe(const Contact&, const PairKey&) const
{
  return {.a = "-", .b = "-", .law = name, .kind = "closed form", .note = "none: elastic"};
}

}  // namespace granulaw::plugin
