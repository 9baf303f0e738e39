#include "liggghts_plugin/mpm_physics.hpp"

#include <fmt/ranges.h>

#include "base/scales.hpp"

namespace granulaw::plugin {

namespace {

/// The law was computed for the material's moduli and the tangential force takes the deck's: they must be
/// one. 1e-3 lets a deck round its numbers to four figures.
constexpr double modulus_tolerance = 1e-3;

bool agree(double found, double expected)
{
  return std::abs(found - expected) <= modulus_tolerance * std::abs(expected);
}

void check_material(LAMMPS_NS::LAMMPS* lmp, const Setup& setup, const Types& types, int t,
                    const LawMaterial& material)
{
  const double found_e = types.youngs_modulus[t], found_nu = types.poisson_ratio[t];
  if (!agree(found_e, material.youngs_modulus))
    fail(setup.where,
         fmt::format("youngsModulus of type {} is {:.6g} Pa in the deck and {:.6g} Pa for '{}' in {}", t,
                     found_e, material.youngs_modulus, material.name, setup.law->path));
  // a Poisson's ratio may be 0: compare to 1e-3 of one
  if (std::abs(found_nu - material.poisson_ratio) > modulus_tolerance)
    fail(setup.where, fmt::format("poissonsRatio of type {} is {:.6g} in the deck and {:.6g} for '{}' in {}",
                                  t, found_nu, material.poisson_ratio, material.name, setup.law->path));
  const bool density_differs =
      types.density_low[t] <= types.density_high[t] &&
      !(agree(types.density_low[t], material.density) && agree(types.density_high[t], material.density));
  if (density_differs && setup.session->first_time(fmt::format("density {}", t)) && lmp->comm->me == 0)
    lmp->error->warning(
        FLERR, fmt::format("{}: particles of type {} have density {:.6g} to {:.6g} kg/m^3, '{}' in {} "
                           "has {:.6g}: the force law does not depend on it, its limit of velocity does",
                           setup.where, t, types.density_low[t], types.density_high[t], material.name,
                           setup.law->path, material.density)
                   .c_str());
}

/// Hertz's law itself, for `elastic` types: F = F_Hertz, a = a_Hertz, no yield.
struct HertzBody
{
  BodyLaw body;
  FastCurve curve;

  static const HertzBody& instance()
  {
    static const HertzBody hertz;
    return hertz;
  }

 private:
  HertzBody()
  {
    const std::vector<double> zeros(33, 0.0), ones(33, 1.0), three_halves(33, UnloadingShape{}.exponent);
    ContactCurve::Table table;
    table.s_end = 1.0;
    table.onset = std::numeric_limits<double>::infinity();
    table.force_ratio = table.radius_ratio = table.hertz_share = ones;
    table.exponent = three_halves;
    table.residual_ratio = zeros;
    table.force_ratio_slope = table.radius_ratio_slope = table.exponent_slope = table.hertz_share_slope =
        table.residual_ratio_slope = zeros;
    body.material.name = elastic_name;
    body.curve = ContactCurve(table, elastic_name);
    curve = FastCurve(body.curve);
  }
};

}  // namespace

void MpmPhysics::prepare(LAMMPS_NS::LAMMPS* lmp, PropertyRegistry&, const Setup& setup, const Types& types)
{
  setup_ = &setup;
  units_ = types.units;
  e_star_.assign(static_cast<std::size_t>(types.count + 1), 0.0);
  for (int t = 1; t <= types.count; ++t)
    e_star_[static_cast<std::size_t>(t)] =
        plane_strain_modulus(types.youngs_modulus[t], types.poisson_ratio[t]);
  const auto& materials = setup.options.materials;
  if (materials.size() != static_cast<std::size_t>(types.count)) {
    // names end where the next keyword begins, so a misspelt keyword looks like one more material
    std::string hint;
    const auto words = keywords(Model::mpm, setup.wall != nullptr);
    for (std::size_t k = static_cast<std::size_t>(types.count); k < materials.size() && hint.empty(); ++k)
      if (const std::string word = nearest(materials[k], words); !word.empty())
        hint = fmt::format("; '{}' is no keyword, did you mean '{}'?", materials[k], word);
    fail(setup.where, fmt::format("'materials' needs one name for each of the {} atom types, found {}: {}{}",
                                  types.count, materials.size(), fmt::join(materials, " "), hint));
  }
  double& limit = setup.session->damage_number_limit;
  const auto lower_limit = [&](const Certificate& certificate) {
    const double own = certificate.damage_number_max;
    if (own > 0 && (limit == 0 || own < limit)) limit = own;
  };
  const Law& law = setup.law->law;
  for (int t = 1; t <= types.count; ++t) {
    const std::string& name = materials[static_cast<std::size_t>(t - 1)];
    const auto found = law.bodies.find(name);
    if (found == law.bodies.end() || std::isnan(types.youngs_modulus[t])) continue;
    check_material(lmp, setup, types, t, found->second.material);
    lower_limit(found->second.certificate);
    for (int other = 1; other < t; ++other)
      if (const TwoBodyLaw* own = law.find_pair_law(name, materials[static_cast<std::size_t>(other - 1)]))
        lower_limit(own->law.certificate);
  }
}

const BodyLaw* MpmPhysics::body(int t) const
{
  const auto found = setup_->law->law.bodies.find(setup_->options.materials[static_cast<std::size_t>(t - 1)]);
  return found == setup_->law->law.bodies.end() ? nullptr : &found->second;
}

void MpmPhysics::check_sizes(int i, int j, bool is_wall, const Contact& contact,
                             const ParticleSizes& sizes) const
{
  for (const int t : {i, is_wall ? i : j}) {
    const auto at = static_cast<std::size_t>(t);
    if (setup_->options.materials[at - 1] != contact.law.yielding->material.name) continue;
    for (const double radius : {sizes.radius[at], sizes.largest_radius[at]})
      if (radius > 0 && std::isfinite(radius))
        check_size(contact.law, radius * units_.length,
                   fmt::format("{}: type {}, law file {}", setup_->where, t, setup_->law->path));
  }
}

MpmContact MpmPhysics::resolve(int i, int j, bool rigid, const std::string& where) const
{
  const std::string& a = setup_->options.materials[static_cast<std::size_t>(i - 1)];
  const std::string& b = setup_->options.materials[static_cast<std::size_t>(j - 1)];
  const double stretch = setup_->options.stretch.value_or(1.0);
  const double e_star_i = e_star_[static_cast<std::size_t>(i)],
               e_star_j = e_star_[static_cast<std::size_t>(j)];
  // a law that has a material of this name means that one
  const bool i_elastic = a == elastic_name && !body(i), j_elastic = b == elastic_name && !body(j);
  const HertzBody& hertz = HertzBody::instance();
  if (i_elastic && (rigid || j_elastic)) {
    const PairMapping mapping =
        rigid ? PairMapping::rigid_partner(e_star_i) : PairMapping::deformable_partner(e_star_i, e_star_j);
    return {PairLaw{&hertz.body.curve, mapping, &hertz.body}, hertz.curve, stretch, units_};
  }
  const std::string here = fmt::format("{}: types {} ({}) and {} ({}{}), law file {}", where, i, a, j,
                                       rigid ? "rigid wall, " : "", b, setup_->law->path);
  PairLaw law;
  if (const BodyLaw* yielding = i_elastic ? body(j) : j_elastic && !rigid ? body(i) : nullptr) {
    check_partners(*yielding, hertz.body, here);
    law = {&yielding->curve,
           PairMapping::deformable_partner(yielding->material.e_star(), i_elastic ? e_star_i : e_star_j),
           yielding};
  } else
    law = resolve_pair(setup_->law->law, a, rigid ? wall_name : b, here);
  return {law, setup_->law->curves.at(law.curve), stretch, units_};
}

}  // namespace granulaw::plugin
