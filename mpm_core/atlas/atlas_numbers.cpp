#include "atlas/atlas_numbers.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/error.hpp"

namespace granulaw {

namespace {

constexpr double version = 1;

/// Appends the members of a type, or takes them off: one order for both.
class Writer
{
 public:
  void number(double& value) { numbers.push_back(value); }
  template <class T>
  std::size_t length(std::vector<T>& list)
  {
    numbers.push_back(static_cast<double>(list.size()));
    return list.size();
  }
  std::vector<double> numbers;
};

class Reader
{
 public:
  explicit Reader(std::span<const double> numbers) : rest_(numbers) {}
  void number(double& value)
  {
    if (rest_.empty()) fail("atlas", "its array ends early");
    value = rest_.front();
    rest_ = rest_.subspan(1);
    if (!std::isfinite(value)) fail("atlas", "its array holds a number that is not finite");
  }
  template <class T>
  std::size_t length(std::vector<T>& list)
  {
    double size = 0;
    number(size);
    // every element has a number
    if (!(size >= 0 && size <= static_cast<double>(rest_.size()) && size == std::floor(size)))
      fail("atlas", "its array has an unusable length of a list", fmt::format("{:g}", size),
           fmt::format("0 to {}", rest_.size()));
    list.resize(static_cast<std::size_t>(size));
    return list.size();
  }
  bool is_at_end() const { return rest_.empty(); }

 private:
  std::span<const double> rest_;
};

template <class Archive>
void pass(Archive& a, double& value)
{
  a.number(value);
}

template <class Archive, class T>
void pass(Archive& a, std::vector<T>& list);

template <class Archive, class... T>
void all(Archive& a, T&... members)
{
  (pass(a, members), ...);
}

template <class Archive>
void pass(Archive& a, MaterialRatios& m)
{
  all(a, m.stiffness, m.poisson_ratio, m.hardening);
}

template <class Archive>
void pass(Archive& a, ElasticCorrection& e)
{
  all(a, e.c1, e.c2, e.d1, e.c3);
}

template <class Archive>
void pass(Archive& a, LawShape::VelocityEffect& e)
{
  all(a, e.speed, e.log_overlap, e.dissipation, e.residual, e.force);
}

template <class Archive>
void pass(Archive& a, LawShape& s)
{
  pass(a, s.elastic);
  for (const auto member : LawShape::functions) pass(a, s.*member);
  pass(a, s.velocity_effects);
}

template <class Archive>
void pass(Archive& a, Atlas::Node& n)
{
  all(a, n.material, n.shape);
}

template <class Archive>
void pass(Archive& a, ElasticSphere& e)
{
  all(a, e.poisson_ratio, e.fit.correction, e.fit.error, e.solver_error);
}

template <class Archive>
void pass(Archive& a, AtlasCheck& c)
{
  all(a, c.material, c.speed, c.error_force, c.error_restitution, c.solver_estimate);
}

template <class Archive>
void pass(Archive& a, MidplaneShapes::Node& n)
{
  all(a, n.material, n.onset, n.change);
}

template <class Archive>
void pass(Archive& a, MidplaneCheck& c)
{
  all(a, c.material, c.depth, c.error_force, c.error_restitution, c.error_recovery);
}

template <class Archive, class T>
void pass(Archive& a, std::vector<T>& list)
{
  a.length(list);
  for (T& element : list) pass(a, element);
}

template <class Archive>
void pass(Archive& a, AtlasGrid& g)
{
  all(a, g.main_poisson_ratio, g.stiffnesses, g.hardenings, g.block_stiffnesses, g.block_hardenings,
      g.block_poisson_ratios);
}

template <class Archive>
void pass(Archive& a, MidplaneGrid& g)
{
  all(a, g.main_poisson_ratio, g.stiffnesses, g.hardenings, g.block_stiffnesses, g.block_hardenings,
      g.block_poisson_ratios);
}

/// An atlas taken apart.
struct Parts
{
  double version = granulaw::version;
  AtlasGrid grid;
  std::vector<Atlas::Node> nodes;
  std::vector<ElasticSphere> elastic;
  std::vector<AtlasCheck> checks;
  MidplaneGrid midplane;
  std::vector<ElasticCorrection> midplane_elastic;
  std::vector<MidplaneShapes::Node> midplane_nodes;
  std::vector<MidplaneCheck> midplane_checks;
};

template <class Archive>
void pass(Archive& a, Parts& p)
{
  all(a, p.version, p.grid, p.nodes, p.elastic, p.checks, p.midplane, p.midplane_elastic, p.midplane_nodes,
      p.midplane_checks);
}

void check_shape(const LawShape& shape)
{
  for (const auto member : LawShape::functions)
    if ((shape.*member).size() != LawShape::nodes)
      fail("atlas", "a shape of its array has the wrong number of nodes",
           std::to_string((shape.*member).size()), std::to_string(LawShape::nodes));
  const LawShape expected = LawShape::zero();
  if (shape.velocity_effects.size() != expected.velocity_effects.size())
    fail("atlas", "a shape of its array has the wrong number of speeds");
  for (std::size_t k = 0; k < expected.velocity_effects.size(); ++k)
    if (shape.velocity_effects[k].force.size() != LawShape::VelocityEffect::shares)
      fail("atlas", "a shape of its array has the wrong number of values");
}

}  // namespace

std::vector<double> numbers_of(const Atlas& atlas)
{
  const MidplaneShapes& midplane = atlas.midplane();
  Parts parts{version,         atlas.grid(),    atlas.nodes(),
              atlas.elastic_spheres(), atlas.checks(), midplane.grid(),
              midplane.elastic_corrections(), midplane.nodes(), midplane.checks()};
  Writer writer;
  pass(writer, parts);
  return std::move(writer.numbers);
}

Atlas atlas_of(std::span<const double> numbers)
{
  if (numbers.empty() || numbers.front() != version)
    fail("atlas", "its array is of another version",
         numbers.empty() ? std::string("no number") : fmt::format("{:g}", numbers.front()),
         fmt::format("{:g}", version));
  Parts p;
  Reader reader(numbers);
  pass(reader, p);
  if (!reader.is_at_end()) fail("atlas", "its array is longer than an atlas");
  for (const Atlas::Node& node : p.nodes) check_shape(node.shape);
  for (const MidplaneShapes::Node& node : p.midplane_nodes) check_shape(node.change);
  MidplaneShapes midplane;
  if (!p.midplane_nodes.empty())
    midplane = {std::move(p.midplane), std::move(p.midplane_elastic), std::move(p.midplane_nodes),
                std::move(p.midplane_checks)};
  return {std::move(p.grid), std::move(p.nodes), std::move(p.elastic), std::move(p.checks), std::move(midplane)};
}

}  // namespace granulaw
