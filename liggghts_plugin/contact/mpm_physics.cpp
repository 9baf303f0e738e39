#include "liggghts_plugin/contact/mpm_physics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "law/contact_step.hpp"
#include "liggghts_plugin/deck/loaded_law.hpp"
#include "liggghts_plugin/deck/session.hpp"
#include "liggghts_plugin/engine/liggghts.hpp"

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
                           "has {:.6g}: the force law does not depend on it, its limit of velocity does{}",
                           setup.where, t, types.density_low[t], types.density_high[t], material.name,
                           setup.law->path, material.density,
                           lmp->domain->dimension == 2
                               ? ". Under 'dimension 2' LIGGGHTS gives a sphere the mass of a disk one unit of length thick"
                               : "")
                   .c_str());
}

/// Hertz's law itself, for `elastic` types: F = F_Hertz, a = a_Hertz, no yield.
const BodyLaw& hertz_body()
{
  static const BodyLaw hertz = [] {
    CurveTable table(std::numeric_limits<double>::infinity(), 1.0);
    for (const double x : table.nodes()) {
      const double root = std::sqrt(x);
      table.force.add(x * root, 1.5 * root), table.radius.add(root, 0.5 / root);
    }
    BodyLaw body;
    body.material.name = elastic_name;
    body.curve = Curve(table);
    return body;
  }();
  return hertz;
}

/// Overlap/(lambda R*) beyond which no law of one contact holds: on a rigid wall a tenth of the radius.
constexpr double deep_flattening = 0.1;

/// Names end where the next keyword begins, so a misspelt keyword looks like one more material.
std::string misspelt_keyword(const std::vector<std::string>& materials, std::size_t types, bool is_wall)
{
  const auto words = keyword_names(model_info<MpmPhysics>, is_wall);
  for (std::size_t k = types; k < materials.size(); ++k)
    if (const std::string word = nearest(materials[k], words); !word.empty())
      return fmt::format("; '{}' is no keyword, did you mean '{}'?", materials[k], word);
  return {};
}

}  // namespace

void MpmPhysics::read_keywords(LAMMPS_NS::LAMMPS* lmp, Setup& setup)
{
  const auto& law = setup.own.own_words("law");
  if (setup.wall && law.empty()) {
    if (!setup.session->pair_law)
      fail(setup.where,
           "'law FILE' is missing, and no pair_style gran model mpm stands before it to take it from: put the wall "
           "behind its pair_style");
    setup.law = setup.session->pair_law;
  } else {
    if (law.empty()) fail(setup.where, "'law FILE' is missing");
    setup.law = load_law(lmp, law[0], setup.where);
  }
  if (setup.options.own_words("materials").empty())
    fail(setup.where, "'materials' is missing: one name for each atom type");
}

void MpmPhysics::prepare(LAMMPS_NS::LAMMPS* lmp, PropertyRegistry&, const Setup& setup, const Types& types)
{
  setup_ = &setup;
  setup.session->one_size.erase(setup_);
  units_ = types.units;
  e_star_.assign(static_cast<std::size_t>(types.count + 1), 0.0);
  for (int t = 1; t <= types.count; ++t)
    e_star_[static_cast<std::size_t>(t)] =
        plane_strain_modulus(types.youngs_modulus[t], types.poisson_ratio[t]);
  const auto& materials = setup.options.own_words("materials");
  const auto count = static_cast<std::size_t>(types.count);
  if (materials.size() != count)
    fail(setup.where, fmt::format("'materials' needs one name for each of the {} atom types, found {}: {}{}",
                                  count, materials.size(), fmt::join(materials, " "),
                                  misspelt_keyword(materials, count, setup.wall != nullptr)));
  const Law& law = setup.law->law;
  for (int t = 1; t <= types.count; ++t) {
    const std::string& name = materials[static_cast<std::size_t>(t - 1)];
    const auto found = law.bodies.find(name);
    if (found == law.bodies.end() || std::isnan(types.youngs_modulus[t])) continue;
    check_material(lmp, setup, types, t, found->second.material);
  }
}

const std::string& MpmPhysics::material(int t) const
{
  return setup_->options.own_words("materials")[static_cast<std::size_t>(t - 1)];
}

const BodyLaw* MpmPhysics::body(int t) const
{
  const auto found = setup_->law->law.bodies.find(material(t));
  return found == setup_->law->law.bodies.end() ? nullptr : &found->second;
}

void MpmPhysics::check_sizes(int i, int j, bool is_wall, const Contact& contact,
                             const ParticleSizes& sizes) const
{
  for (const int t : {i, is_wall ? i : j}) {
    const auto at = static_cast<std::size_t>(t);
    if (material(t) != contact.yielding->material.name || !(contact.law().only_radius() > 0)) continue;
    const auto check = [law = contact.law(), unit = units_.length,
                        where = fmt::format("{}: type {}, law file {}", setup_->where, t, setup_->law->path)](
                           double radius) { check_size(law, radius * unit, where); };
    for (const double radius : {sizes.radius[at], sizes.largest_radius[at]})
      if (radius > 0 && std::isfinite(radius)) check(radius);
    setup_->session->one_size[setup_][t] = check;
  }
}

void MpmPhysics::check_flow_stress(const Contact& contact) const
{
  if (const std::string why = unknown_flow_stress(setup_->law->law, contact.law()); !why.empty())
    fail(fmt::format("{}: law file {}", setup_->where, setup_->law->path), why);
}

SizeChoice MpmPhysics::laws_by_size(int i, int j) const
{
  return size_choice(setup_->law->law, material(i), material(j));
}

MpmContact MpmPhysics::resolve(int i, int j, bool rigid, const std::string& where, double radius_i,
                               double radius_j) const
{
  const std::string &a = material(i), &b = material(j);
  const double stretch = setup_->options.stretch.value_or(1.0);
  const double e_star_i = e_star_[static_cast<std::size_t>(i)],
               e_star_j = e_star_[static_cast<std::size_t>(j)];
  // a law that has a material of this name means that one
  const bool i_elastic = a == elastic_name && !body(i), j_elastic = b == elastic_name && !body(j);
  const BodyLaw& hertz = hertz_body();
  if (i_elastic && (rigid || j_elastic)) {
    const PairMapping mapping =
        rigid ? PairMapping::rigid_partner(e_star_i) : PairMapping::deformable_partner(e_star_i, e_star_j);
    return {PairLaw{{&hertz.curve, mapping}, &hertz}, stretch, units_};
  }
  const std::string here = fmt::format("{}: types {} ({}) and {} ({}{}), law file {}", where, i, a, j,
                                       rigid ? "rigid wall, " : "", b, setup_->law->path);
  PairLaw law;
  if (const BodyLaw* yielding = i_elastic ? body(j) : j_elastic && !rigid ? body(i) : nullptr) {
    check_partners(*yielding, hertz, here);
    law = {{&yielding->curve,
            PairMapping::deformable_partner(yielding->material.e_star(), i_elastic ? e_star_i : e_star_j)},
           yielding};
  } else
    law = resolve_pair(setup_->law->law, a, rigid ? wall_name : b, here, radius_i, radius_j);
  const auto& waves = setup_->options.own_words("waves");
  if (!waves.empty() && waves[0] == "off") law.radiation = 0.0;
  return {law, stretch, units_};
}

PairInfo MpmPhysics::describe(const Contact& contact, const PairKey& key) const
{
  PairInfo info;
  info.a = material(key.i);
  info.b = key.kind == PairKey::rigid_wall ? wall_name : material(key.j);
  info.law = fmt::format("mpm {}", setup_->law->path);
  const BodyLaw& body = *contact.yielding;
  const Law& law = setup_->law->law;
  const bool hertz = &body == &hertz_body();
  const bool elastic_partner = !law.find_pair(info.a, info.b);
  if (hertz || elastic_partner) {
    info.kind = hertz ? "Hertz" : name_of(LawKind::reduced);
    if (!hertz) info.note = "error bound not stated: one body is elastic by the deck";
    info.stated.damage_number_max = body.certificate.damage_number_max;
  } else {
    const double flat_partner = std::numeric_limits<double>::infinity();
    info.stated = statement_of(law, contact.law(), info.a, info.b);
    if (key.kind == PairKey::deformable_wall)
      info.stated =
          info.stated.at_distance(distance_in_size(law, contact.law(), info.a, info.b, 1.0, flat_partner));
    info.kind = name_of(info.stated.kind);
  }
  if (body.material.yields()) {
    info.stiffness_ratio = body.material.e_star() / body.material.yield_stress;
    info.deep_overlap = deep_flattening / contact.per_lambda;
  }
  info.overlap_limit = contact.largest_overlap();
  if (std::isfinite(info.stated.damage_number_max)) info.damage_number_limit = info.stated.damage_number_max;
  return info;
}

}  // namespace granulaw::plugin
