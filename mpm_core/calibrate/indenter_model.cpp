#include "calibrate/indenter_model.hpp"

#include <algorithm>
#include <cmath>

#include "calibrate/sphere_laws.hpp"
#include "law/pair.hpp"

namespace granulaw {

namespace {

/// Without an indenter's modulus only ratios of the specimen's stresses count.
std::vector<Parameter> lattice_axes(const Measurement& m, std::vector<Parameter> varied)
{
  if (m.indenter) return varied;
  std::vector<Parameter> axes;
  const auto varies = [&](Parameter p) { return std::find(varied.begin(), varied.end(), p) != varied.end(); };
  if (varies(Parameter::youngs_modulus) || varies(Parameter::yield_stress))
    axes.push_back(Parameter::youngs_modulus);
  if (varies(Parameter::hardening_modulus) || varies(Parameter::yield_stress))
    axes.push_back(Parameter::hardening_modulus);
  return axes;
}

}  // namespace

IndenterModel::IndenterModel(const Atlas& atlas, const Measurement& m, std::vector<Parameter> varied)
    : atlas_(&atlas),
      effective_radius_(m.effective_radius()),
      radius_ratio_(std::isfinite(m.radius) ? m.indenter_radius / m.radius : 0),
      indenter_(m.indenter),
      lattice_(lattice_axes(m, std::move(varied)))
{
  if (indenter_) PairBody(atlas, *indenter_);
}

LawMaterial IndenterModel::on_lattice(const LawMaterial& specimen) const
{
  if (indenter_) return specimen;
  LawMaterial m = specimen;
  m.youngs_modulus /= specimen.yield_stress, m.hardening_modulus /= specimen.yield_stress, m.yield_stress = 1;
  return m;
}

LawMaterial IndenterModel::indenter_on(const LawMaterial& specimen) const
{
  if (indenter_) return *indenter_;
  LawMaterial m;
  m.name = "rigid indenter";
  m.density = specimen.density, m.youngs_modulus = most_unlike * specimen.youngs_modulus,
  m.poisson_ratio = 0.3;
  return m;
}

IndenterModel::Shape IndenterModel::compose(const LawMaterial& asked) const
{
  const LawMaterial specimen = within_atlas(*atlas_, asked);
  BuildOptions options;
  options.depth = Atlas::depth, options.fastest = 0;
  const ComposedShape composed = compose_shape(
      *atlas_, PairBody(*atlas_, specimen), PairBody(*atlas_, indenter_on(specimen)), radius_ratio_, options);
  return {composed.shape, std::log(composed.body.onset), std::log(composed.end)};
}

const IndenterModel::Shape& IndenterModel::at(const MaterialLattice::Corner& corner) const
{
  const auto found = known_.find(corner.key);
  return found != known_.end() ? found->second
                               : known_.emplace(corner.key, compose(corner.material)).first->second;
}

IndenterModel::Law IndenterModel::make(const LawMaterial& specimen) const
{
  Shape mean{LawShape::zero(), 0, 0};
  for (const MaterialLattice::Corner& corner : lattice_.around(on_lattice(specimen))) {
    const Shape& here = at(corner);
    mean.shape.add(corner.weight, here.shape);
    mean.log_onset += corner.weight * here.log_onset, mean.log_end += corner.weight * here.log_end;
  }
  const double onset = std::exp(mean.log_onset), end = std::exp(mean.log_end);
  const LawMaterial indenter = indenter_on(specimen);
  const PairMapping mapping = PairMapping::deformable_partner(specimen.e_star(), indenter.e_star());
  constexpr double stated = 2;  // standard deviations: what 95 % lie within
  return {specimen, deepest_curve(mean.shape, onset, end, end), mapping.length(effective_radius_),
          mapping.force(effective_radius_),
          composed_error(indenter.e_star() / specimen.e_star()).force / stated};
}

const IndenterModel::Law& IndenterModel::law(const LawMaterial& asked) const
{
  const LawMaterial specimen = indenter_ ? within_reach(within_atlas(*atlas_, asked), *indenter_) : asked;
  constexpr std::size_t most = 32;
  const auto same = [&](const Law& l) {
    return l.specimen.youngs_modulus == specimen.youngs_modulus &&
           l.specimen.yield_stress == specimen.yield_stress &&
           l.specimen.hardening_modulus == specimen.hardening_modulus;
  };
  if (const auto found = std::find_if(laws_.begin(), laws_.end(), same); found != laws_.end()) {
    laws_.splice(laws_.begin(), laws_, found);
    return laws_.front();
  }
  laws_.push_front(make(specimen));
  if (laws_.size() > most) laws_.pop_back();
  return laws_.front();
}

}  // namespace granulaw
