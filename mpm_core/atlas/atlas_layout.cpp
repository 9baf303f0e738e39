#include "atlas/atlas_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"

namespace granulaw {

namespace {

using Numbers = std::vector<double*>;
using Presence = AtlasDataset::Presence;
using Form = AtlasDataset::Form;
using Effect = LawShape::VelocityEffect;

void add(Numbers& all, std::vector<double>& list)
{
  for (double& value : list) all.push_back(&value);
}

/// A list of the grid. `grid`, `list`: members.
template <auto grid, auto list>
AtlasDataset of_grid(const char* name, const char* legend, Presence presence)
{
  return {{name, "1", legend},
          [](AtlasParts& p) {
            Numbers all;
            add(all, (p.*grid).*list);
            return all;
          },
          [](AtlasParts& p, std::size_t count) { ((p.*grid).*list).resize(count); },
          presence};
}

/// Equally many numbers of each element of a list. `add(all, element)`: those of one.
template <auto list, auto add>
Numbers of_each(AtlasParts& p)
{
  Numbers all;
  for (auto& element : p.*list) add(all, element);
  return all;
}

/// As many elements as rows of `columns` numbers; a count that is no multiple leaves a wrong length.
template <auto list, std::size_t columns>
void rows(AtlasParts& p, std::size_t count)
{
  (p.*list).resize(count / columns);
}
/// No more than the grid has: the wrong length is noticed then.
template <auto grid, auto list>
void shapes(AtlasParts& p, std::size_t count)
{
  (p.*list).assign(std::min(count, (p.*grid).materials().size()), {{}, LawShape::zero()});
}

void add_material(Numbers& all, MaterialRatios& m)
{
  all.insert(all.end(), {&m.stiffness, &m.poisson_ratio, &m.hardening});
}
void add_terms(Numbers& all, ElasticCorrection& e)
{
  all.insert(all.end(), {&e.c1, &e.c2, &e.d1});
}

template <auto number>
AtlasDataset of_materials(const char* name, const char* legend, bool first = false)
{
  return {{name, "1", legend},
          of_each<&AtlasParts::nodes, [](Numbers& all, LatticeNode& n) { all.push_back(&(n.material.*number)); }>,
          first ? shapes<&AtlasParts::grid, &AtlasParts::nodes> : nullptr,
          Presence::always};
}

template <auto function>
AtlasDataset of_shapes(const char* name, const char* legend, Presence presence = Presence::always)
{
  return {{name, "1", legend},
          of_each<&AtlasParts::nodes, [](Numbers& all, LatticeNode& n) { add(all, n.shape.*function); }>,
          nullptr,
          presence,
          Form::rounded_list};
}

template <auto number>
AtlasDataset of_impacts(const char* name, const char* legend)
{
  return {{name, "1", legend},
          of_each<&AtlasParts::nodes,
                  [](Numbers& all, LatticeNode& n) {
                    for (Effect& e : n.shape.velocity_effects) all.push_back(&(e.*number));
                  }>,
          nullptr,
          Presence::always,
          Form::rounded_list};
}

template <auto grid>
std::vector<AtlasDataset> lists_of_grid(const char* (&names)[5], const char* (&legends)[5], Presence presence)
{
  return {of_grid<grid, &Lattice::stiffnesses>(names[0], legends[0], presence),
          of_grid<grid, &Lattice::hardenings>(names[1], legends[1], presence),
          of_grid<grid, &Lattice::block_stiffnesses>(names[2], legends[2], presence),
          of_grid<grid, &Lattice::block_hardenings>(names[3], legends[3], presence),
          of_grid<grid, &Lattice::block_poisson_ratios>(names[4], legends[4], presence)};
}

std::vector<AtlasDataset> make_datasets()
{
  const char* names[] = {"stiffnesses", "hardenings", "block_stiffnesses", "block_hardenings",
                         "block_poisson_ratios"};
  const char* legends[] = {"E*/Y at the main Poisson's ratio",
                           "H/E at the main Poisson's ratio; weak ones are left out at low E*/Y",
                           "E*/Y of the block", "H/E of the block", "Poisson's ratios of the block"};
  const char* midplane_names[] = {"midplane_stiffnesses", "midplane_hardenings", "midplane_block_stiffnesses",
                                  "midplane_block_hardenings", "midplane_block_poisson_ratios"};
  const char* midplane_legends[] = {"E*/Y of the midplane presses", "H/E of the midplane presses",
                                    "E*/Y of those at other Poisson's ratios",
                                    "H/E of those at other Poisson's ratios", "the other Poisson's ratios"};
  std::vector<AtlasDataset> all = lists_of_grid<&AtlasParts::grid>(names, legends, Presence::always);
  const auto append = [&](std::vector<AtlasDataset> more) { all.insert(all.end(), more.begin(), more.end()); };
  append({
      {{"main_poisson_ratio", "1", "main Poisson's ratio"},
       [](AtlasParts& p) { return Numbers{&p.grid.main_poisson_ratio}; },
       nullptr,
       Presence::always,
       Form::scalar},
      of_materials<&MaterialRatios::stiffness>("stiffness", "E*/Y of each material", true),
      of_materials<&MaterialRatios::poisson_ratio>("poisson_ratio", "Poisson's ratio of each material"),
      of_materials<&MaterialRatios::hardening>("hardening", "H/E of each material"),
      {{"elastic", "1", "c1, c2, d1 of each material"},
       of_each<&AtlasParts::nodes, [](Numbers& n, LatticeNode& node) { add_terms(n, node.shape.elastic); }>,
       nullptr,
       Presence::always},
      of_shapes<&LawShape::force_reduction>("softening", "-ln(F/F_elastic) at the nodes of each material"),
      of_shapes<&LawShape::widening>("widening", "ln(a/a_elastic) at the nodes of each material"),
      of_shapes<&LawShape::residual>("residual", "-ln(1 - delta_r/delta_m) at the nodes of each material"),
      of_shapes<&LawShape::dissipation>("dissipation", "-ln(W_u/W_L) at the nodes of each material"),
      of_shapes<&LawShape::hertz_share>("foot", "A - A_elastic of the unloading at the nodes of each material"),
      of_shapes<&LawShape::radius_0>("radius_0", "k - k_elastic of a = a_m sqrt(u) k at u = 0, at the nodes of each material", Presence::radii),
      of_shapes<&LawShape::radius_1>("radius_1", "the same at sqrt(u) = 1/3", Presence::radii),
      of_shapes<&LawShape::radius_2>("radius_2", "the same at sqrt(u) = 2/3", Presence::radii),
      of_impacts<&Effect::log_overlap>("impact_reach", "ln(X/v) at the speeds of each material"),
      of_impacts<&Effect::dissipation>("impact_dissipation", "dissipation less the slow press's"),
      of_impacts<&Effect::residual>("impact_residual", "residual less the slow press's"),
      {{"impact_force", "1", "ln(F/F_press) at even places up to X, at the speeds of each material"},
       of_each<&AtlasParts::nodes,
               [](Numbers& n, LatticeNode& node) {
                 for (Effect& e : node.shape.velocity_effects) add(n, e.force);
               }>,
       nullptr,
       Presence::always,
       Form::rounded_list},
      {{"elastic_spheres", "1",
        "without yield, to 0.2 R: rows of Poisson's ratio, c1, c2, c3, d1, largest misfit of F, the solver's error"},
       of_each<&AtlasParts::elastic,
               [](Numbers& n, ElasticSphere& e) {
                 ElasticCorrection& c = e.fit.correction;
                 n.insert(n.end(), {&e.poisson_ratio, &c.c1, &c.c2, &c.c3, &c.d1, &e.fit.error, &e.solver_error});
               }>,
       rows<&AtlasParts::elastic, 7>,
       Presence::always},
      {{"checks", "1",
        "rows of E*/Y, nu, H/E, sqrt(I), relative error of F_max, error of e, the impact's own estimate"},
       of_each<&AtlasParts::checks,
               [](Numbers& n, AtlasCheck& c) {
                 add_material(n, c.material);
                 n.insert(n.end(), {&c.speed, &c.error_force, &c.error_restitution, &c.solver_estimate});
               }>,
       rows<&AtlasParts::checks, 7>,
       Presence::checks},
  });
  append(lists_of_grid<&AtlasParts::midplane_grid>(midplane_names, midplane_legends, Presence::midplane));
  append({
      {{"midplane_elastic", "1", "rows of c1, c2, d1 by Poisson's ratio"},
       of_each<&AtlasParts::midplane_elastic, add_terms>,
       rows<&AtlasParts::midplane_elastic, 3>,
       Presence::midplane},
      {{"midplane_onset", "1", "delta/R of the onset of yield of each material"},
       of_each<&AtlasParts::midplane_nodes, [](Numbers& n, LatticeNode& node) { n.push_back(&node.shape.onset); }>,
       shapes<&AtlasParts::midplane_grid, &AtlasParts::midplane_nodes>,
       Presence::midplane},
      {{"midplane_change", "1",
        "softening, widening, residual, dissipation, foot of each material: the press's less those of the free sphere "
        "with a series compliance"},
       of_each<&AtlasParts::midplane_nodes,
               [](Numbers& n, LatticeNode& node) {
                 for (std::size_t f = 0; f < LawShape::first_radius; ++f) add(n, node.shape.*LawShape::functions[f]);
               }>,
       nullptr,
       Presence::midplane,
       Form::rounded_list},
      {{"midplane_press_checks", "1",
        "rows of E*/Y, nu, H/E, delta/R, rms relative error of F, error of e, relative error of delta_m - delta_r"},
       of_each<&AtlasParts::midplane_checks,
               [](Numbers& n, MidplaneCheck& c) {
                 add_material(n, c.material);
                 n.insert(n.end(), {&c.depth, &c.error_force, &c.error_restitution, &c.error_recovery});
               }>,
       rows<&AtlasParts::midplane_checks, 7>,
       Presence::midplane_checks},
  });
  return all;
}

}  // namespace

const std::vector<AtlasDataset>& atlas_datasets()
{
  static const std::vector<AtlasDataset> all = make_datasets();
  return all;
}

void fill(AtlasParts& parts, const AtlasDataset& dataset, const std::vector<double>& values, const std::string& where)
{
  if (dataset.make_room) dataset.make_room(parts, values.size());
  const Numbers numbers = dataset.numbers(parts);
  if (numbers.size() != values.size())
    fail(where, fmt::format("'{}' has the wrong length", dataset.field.name), std::to_string(values.size()),
         std::to_string(numbers.size()));
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!std::isfinite(values[k]))
      fail(where, fmt::format("'{}' holds a number that is not finite", dataset.field.name));
    *numbers[k] = values[k];
  }
}

AtlasParts parts_of(const Atlas& atlas)
{
  const MidplaneShapes& m = atlas.midplane();
  return {atlas.grid(), atlas.nodes(),           atlas.elastic_spheres(), atlas.checks(),
          m.grid(),     m.elastic_corrections(), m.nodes(),               m.checks()};
}

Atlas atlas_of(AtlasParts p)
{
  p.midplane_grid.main_poisson_ratio = p.grid.main_poisson_ratio;
  const std::vector<MaterialRatios> materials = p.midplane_grid.materials();
  for (std::size_t k = 0; k < std::min(materials.size(), p.midplane_nodes.size()); ++k)
    p.midplane_nodes[k].material = materials[k], p.midplane_nodes[k].shape.end = Atlas::depth;
  MidplaneShapes midplane;
  if (!p.midplane_nodes.empty())
    midplane = {std::move(p.midplane_grid), std::move(p.midplane_elastic), std::move(p.midplane_nodes),
                std::move(p.midplane_checks)};
  return {std::move(p.grid), std::move(p.nodes), std::move(p.elastic), std::move(p.checks), std::move(midplane)};
}

}  // namespace granulaw
