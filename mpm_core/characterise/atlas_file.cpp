#include "characterise/atlas_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "law/h5.hpp"
#include "law/h5_checksum.hpp"
#include "law/layout.hpp"

namespace granulaw {

namespace {

constexpr const char* format_value = "granulaw-atlas";
constexpr int major = 3, minor = 1;
constexpr int first_minor_with_checksum = 1;  // files without the attribute version_minor are of minor 0
constexpr std::size_t most = 1u << 20;        // numbers in one dataset

using h5::Field;
constexpr Field main_poisson_ratio{"main_poisson_ratio", "1", "Poisson's ratio of the reference set"};
constexpr Field stiffnesses{"stiffnesses", "1", "E*/Y of the reference set"};
constexpr Field hardenings{"hardenings", "1", "H/E of the reference set; weak ones are left out at low E*/Y"};
constexpr Field block_stiffnesses{"block_stiffnesses", "1", "E*/Y of the block"};
constexpr Field block_hardenings{"block_hardenings", "1", "H/E of the block"};
constexpr Field block_poisson_ratios{"block_poisson_ratios", "1", "Poisson's ratios of the block"};

constexpr Field stiffness{"stiffness", "1", "E*/Y of each material"};
constexpr Field poisson_ratio{"poisson_ratio", "1", "Poisson's ratio of each material"};
constexpr Field hardening{"hardening", "1", "H/E of each material"};
constexpr Field elastic{"elastic", "1", "c1, c2, d1 of each material"};
constexpr Field elastic_spheres{"elastic_spheres", "1",
                                "without yield, to 0.2 R: rows of Poisson's ratio, c1, c2, c3, d1, largest "
                                "misfit of F, the solver's error"};
constexpr Field force_reduction{"softening", "1", "-ln(F/F_elastic) at the nodes of each material"};
constexpr Field widening{"widening", "1", "ln(a/a_elastic) at the nodes of each material"};
constexpr Field residual{"residual", "1", "-ln(1 - delta_r/delta_m) at the nodes of each material"};
constexpr Field dissipation{"dissipation", "1", "-ln(W_u/W_L) at the nodes of each material"};
constexpr Field hertz_share{"foot", "1", "A - A_elastic of the unloading at the nodes of each material"};
constexpr Field impact_overlap{"impact_reach", "1", "ln(X/v) at the speeds of each material"};
constexpr Field impact_dissipation{"impact_dissipation", "1", "dissipation less the slow press's"};
constexpr Field impact_residual{"impact_residual", "1", "residual less the slow press's"};
constexpr Field impact_force{"impact_force", "1",
                             "ln(F/F_press) at shares of X, at the speeds of each material"};

constexpr Field checks{
    "checks", "1",
    "rows of E*/Y, nu, H/E, sqrt(I), relative error of F_max, error of e, the impact's own estimate"};

// Spheres held at their midplane; a file without them has none of these.
constexpr Field midplane_stiffnesses{"midplane_stiffnesses", "1", "E*/Y of the midplane presses"};
constexpr Field midplane_hardenings{"midplane_hardenings", "1", "H/E of the midplane presses"};
constexpr Field midplane_block_stiffnesses{"midplane_block_stiffnesses", "1",
                                           "E*/Y of those at other Poisson's ratios"};
constexpr Field midplane_block_hardenings{"midplane_block_hardenings", "1",
                                          "H/E of those at other Poisson's ratios"};
constexpr Field midplane_block_poisson_ratios{"midplane_block_poisson_ratios", "1",
                                              "the other Poisson's ratios"};
constexpr Field midplane_elastic{"midplane_elastic", "1", "rows of c1, c2, d1 by Poisson's ratio"};
constexpr Field midplane_onset{"midplane_onset", "1", "delta/R of the onset of yield of each material"};
constexpr Field midplane_change{"midplane_change", "1",
                                "softening, widening, residual, dissipation, foot of each material: the "
                                "press's less those of the free sphere "
                                "with a series compliance"};
constexpr Field midplane_checks{
    "midplane_press_checks", "1",
    "rows of E*/Y, nu, H/E, delta/R, rms relative error of F, error of e, relative error "
    "of delta_m - delta_r"};

struct ShapeField
{
  const Field& field;
  std::vector<double> LawShape::*values;
};
constexpr ShapeField curves[] = {{force_reduction, &LawShape::force_reduction},
                            {widening, &LawShape::widening},
                            {residual, &LawShape::residual},
                            {dissipation, &LawShape::dissipation},
                            {hertz_share, &LawShape::hertz_share}};
struct ImpactNumber
{
  const Field& field;
  double LawShape::VelocityEffect::*value;
};
constexpr ImpactNumber impact_numbers[] = {{impact_overlap, &LawShape::VelocityEffect::log_overlap},
                                           {impact_dissipation, &LawShape::VelocityEffect::dissipation},
                                           {impact_residual, &LawShape::VelocityEffect::residual}};

/// A dataset of exactly `count` finite numbers.
std::vector<double> read_numbers(hid_t group, const Field& field, std::size_t count, const std::string& path)
{
  std::vector<double> values = h5::read_vector(group, field, most, path);
  if (values.size() != count)
    fail(path, fmt::format("'{}' has the wrong length", field.name), std::to_string(values.size()),
         std::to_string(count));
  for (const double v : values)
    if (!std::isfinite(v)) fail(path, fmt::format("'{}' holds a number that is not finite", field.name));
  return values;
}

void write_midplane(hid_t file, const MidplaneShapes& midplane, const std::string& path)
{
  const MidplaneGrid& grid = midplane.grid();
  h5::write_vector(file, midplane_stiffnesses, grid.stiffnesses, path);
  h5::write_vector(file, midplane_hardenings, grid.hardenings, path);
  h5::write_vector(file, midplane_block_stiffnesses, grid.block_stiffnesses, path);
  h5::write_vector(file, midplane_block_hardenings, grid.block_hardenings, path);
  h5::write_vector(file, midplane_block_poisson_ratios, grid.block_poisson_ratios, path);
  std::vector<double> elastic_terms, onsets, changes, rows;
  for (const ElasticCorrection& e : midplane.elastic_corrections())
    elastic_terms.insert(elastic_terms.end(), {e.c1, e.c2, e.d1});
  for (const MidplaneShapes::Node& node : midplane.nodes()) {
    onsets.push_back(node.onset);
    for (const auto member : LawShape::functions)
      changes.insert(changes.end(), (node.change.*member).begin(), (node.change.*member).end());
  }
  for (const MidplaneCheck& c : midplane.checks())
    rows.insert(rows.end(), {c.material.stiffness, c.material.poisson_ratio, c.material.hardening, c.depth,
                             c.error_force, c.error_restitution, c.error_recovery});
  h5::write_vector(file, midplane_elastic, elastic_terms, path);
  h5::write_vector(file, midplane_onset, onsets, path);
  h5::write_vector(file, midplane_change, changes, path);
  if (!rows.empty()) h5::write_vector(file, midplane_checks, rows, path);
}

MidplaneShapes read_midplane(hid_t file, double main_ratio, const std::string& path)
{
  if (!h5::has_link(file, midplane_stiffnesses.name)) return {};
  MidplaneGrid grid;
  grid.main_poisson_ratio = main_ratio;
  grid.stiffnesses = h5::read_vector(file, midplane_stiffnesses, most, path);
  grid.hardenings = h5::read_vector(file, midplane_hardenings, most, path);
  grid.block_stiffnesses = h5::read_vector(file, midplane_block_stiffnesses, most, path);
  grid.block_hardenings = h5::read_vector(file, midplane_block_hardenings, most, path);
  grid.block_poisson_ratios = h5::read_vector(file, midplane_block_poisson_ratios, most, path);
  const std::vector<MaterialRatios> materials = grid.materials();
  const std::size_t functions = LawShape::functions.size(), ratios = grid.poisson_ratios().size();
  const std::vector<double> terms = read_numbers(file, midplane_elastic, 3 * ratios, path),
                            onsets = read_numbers(file, midplane_onset, materials.size(), path),
                            changes = read_numbers(file, midplane_change,
                                                   materials.size() * functions * LawShape::nodes, path);
  std::vector<ElasticCorrection> elastic_terms;
  for (std::size_t i = 0; i < terms.size(); i += 3)
    elastic_terms.push_back({terms[i], terms[i + 1], terms[i + 2]});
  std::vector<MidplaneShapes::Node> nodes;
  auto from = changes.begin();
  for (std::size_t i = 0; i < materials.size(); ++i) {
    nodes.push_back({materials[i], onsets[i], LawShape::zero()});
    for (const auto member : LawShape::functions) {
      std::copy_n(from, LawShape::nodes, (nodes.back().change.*member).begin());
      from += LawShape::nodes;
    }
  }
  std::vector<MidplaneCheck> made;
  if (h5::has_link(file, midplane_checks.name)) {
    const std::vector<double> of = h5::read_vector(file, midplane_checks, most, path);
    for (std::size_t i = 0; i + 7 <= of.size(); i += 7)
      made.push_back({{of[i], of[i + 1], of[i + 2]}, of[i + 3], of[i + 4], of[i + 5], of[i + 6]});
  }
  return {std::move(grid), std::move(elastic_terms), std::move(nodes), std::move(made)};
}

Atlas read_open(hid_t file, const std::string& path)
{
  AtlasGrid grid;
  grid.main_poisson_ratio = h5::read_scalar(file, main_poisson_ratio, path);
  grid.stiffnesses = h5::read_vector(file, stiffnesses, most, path);
  grid.hardenings = h5::read_vector(file, hardenings, most, path);
  grid.block_stiffnesses = h5::read_vector(file, block_stiffnesses, most, path);
  grid.block_hardenings = h5::read_vector(file, block_hardenings, most, path);
  grid.block_poisson_ratios = h5::read_vector(file, block_poisson_ratios, most, path);

  const std::vector<double> k = h5::read_vector(file, stiffness, most, path);
  const std::size_t count = k.size(), speeds = std::size(impact_speeds);
  const std::vector<double> nu = read_numbers(file, poisson_ratio, count, path);
  const std::vector<double> h = read_numbers(file, hardening, count, path);
  const std::vector<double> e = read_numbers(file, elastic, 3 * count, path);
  std::vector<Atlas::Node> nodes;
  for (std::size_t i = 0; i < count; ++i) {
    nodes.push_back({{k[i], nu[i], h[i]}, LawShape::zero()});
    nodes[i].shape.elastic = {e[3 * i], e[3 * i + 1], e[3 * i + 2]};
  }
  for (const ShapeField& c : curves) {
    const std::vector<double> all = read_numbers(file, c.field, count * LawShape::nodes, path);
    for (std::size_t i = 0; i < all.size(); ++i)
      (nodes[i / LawShape::nodes].shape.*c.values)[i % LawShape::nodes] = all[i];
  }
  for (const ImpactNumber& n : impact_numbers) {
    const std::vector<double> all = read_numbers(file, n.field, count * speeds, path);
    for (std::size_t i = 0; i < all.size(); ++i)
      nodes[i / speeds].shape.velocity_effects[i % speeds].*n.value = all[i];
  }
  constexpr std::size_t shares = LawShape::VelocityEffect::shares;
  const std::vector<double> forces = read_numbers(file, impact_force, count * speeds * shares, path);
  for (std::size_t i = 0; i < forces.size(); ++i)
    nodes[i / (speeds * shares)].shape.velocity_effects[i / shares % speeds].force[i % shares] = forces[i];

  std::vector<ElasticSphere> spheres;
  const std::vector<double> rows =
      read_numbers(file, elastic_spheres, 7 * grid.poisson_ratios().size(), path);
  for (std::size_t i = 0; i < rows.size(); i += 7)
    spheres.push_back(
        {rows[i], {{rows[i + 1], rows[i + 2], rows[i + 4], rows[i + 3]}, rows[i + 5]}, rows[i + 6]});

  std::vector<AtlasCheck> made;
  if (h5::has_link(file, checks.name)) {
    const std::vector<double> of = h5::read_vector(file, checks, most, path);
    for (std::size_t i = 0; i + 7 <= of.size(); i += 7)
      made.push_back({{of[i], of[i + 1], of[i + 2]}, of[i + 3], of[i + 4], of[i + 5], of[i + 6]});
  }
  MidplaneShapes midplane = read_midplane(file, grid.main_poisson_ratio, path);
  return Atlas(std::move(grid), std::move(nodes), std::move(spheres), std::move(made), std::move(midplane));
}

}  // namespace

void write_atlas(const Atlas& atlas, const std::string& path)
{
  const h5::Silence silence;
  write_atomically(path, [&](const std::string& temporary) {
    h5::Handle file(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    if (!file.ok()) fail(path, "cannot write here (no such folder, or no permission)");
    h5::write_text_attribute(file, h5::format, format_value, path);
    h5::write_int_attribute(file, h5::version_major, major, path);
    h5::write_int_attribute(file, h5::version_minor, minor, path);
    const AtlasGrid& grid = atlas.grid();
    h5::write_scalar(file, main_poisson_ratio, grid.main_poisson_ratio, path);
    h5::write_vector(file, stiffnesses, grid.stiffnesses, path);
    h5::write_vector(file, hardenings, grid.hardenings, path);
    h5::write_vector(file, block_stiffnesses, grid.block_stiffnesses, path);
    h5::write_vector(file, block_hardenings, grid.block_hardenings, path);
    h5::write_vector(file, block_poisson_ratios, grid.block_poisson_ratios, path);

    const auto gather = [&](const Field& field, auto&& append) {
      std::vector<double> values;
      for (const Atlas::Node& node : atlas.nodes()) append(node, values);
      h5::write_vector(file, field, values, path);
    };
    gather(stiffness, [](const auto& node, auto& v) { v.push_back(node.material.stiffness); });
    gather(poisson_ratio, [](const auto& node, auto& v) { v.push_back(node.material.poisson_ratio); });
    gather(hardening, [](const auto& node, auto& v) { v.push_back(node.material.hardening); });
    gather(elastic, [](const auto& node, auto& v) {
      for (const double c : {node.shape.elastic.c1, node.shape.elastic.c2, node.shape.elastic.d1})
        v.push_back(c);
    });
    for (const ShapeField& c : curves)
      gather(c.field, [&](const auto& node, auto& v) {
        v.insert(v.end(), (node.shape.*c.values).begin(), (node.shape.*c.values).end());
      });
    for (const ImpactNumber& n : impact_numbers)
      gather(n.field, [&](const auto& node, auto& v) {
        for (const LawShape::VelocityEffect& i : node.shape.velocity_effects) v.push_back(i.*n.value);
      });
    gather(impact_force, [](const auto& node, auto& v) {
      for (const LawShape::VelocityEffect& i : node.shape.velocity_effects)
        v.insert(v.end(), i.force.begin(), i.force.end());
    });
    std::vector<double> spheres;
    for (const auto& [nu, fit, solver_error] : atlas.elastic_spheres())
      for (const double v : {nu, fit.correction.c1, fit.correction.c2, fit.correction.c3, fit.correction.d1,
                             fit.error, solver_error})
        spheres.push_back(v);
    h5::write_vector(file, elastic_spheres, spheres, path);
    std::vector<double> rows;
    for (const AtlasCheck& c : atlas.checks())
      for (const double v : {c.material.stiffness, c.material.poisson_ratio, c.material.hardening, c.speed,
                             c.error_force, c.error_restitution, c.solver_estimate})
        rows.push_back(v);
    if (!rows.empty()) h5::write_vector(file, checks, rows, path);
    if (!atlas.midplane().empty()) write_midplane(file, atlas.midplane(), path);
    h5::Checksum written;
    read_open(file, path);
    h5::write(file, written, path);
    if (H5Fflush(file, H5F_SCOPE_LOCAL) < 0) fail(path, "cannot write (disk full?)");
  });
}

Atlas read_atlas(const std::string& path)
{
  const h5::Silence silence;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) fail(path, "no such file");
  h5::Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  if (!file.ok()) fail(path, "is not an HDF5 file, so not an atlas (or it was cut off)");
  if (H5Aexists(file, h5::format) <= 0 || h5::read_text_attribute(file, h5::format, path) != format_value)
    fail(path, "is an HDF5 file but not an atlas of granulaw");
  if (const int found = h5::read_int_attribute(file, h5::version_major, path); found != major)
    fail(path, "the atlas's major version is not the one this program reads", std::to_string(found),
         std::to_string(major));
  const bool has_minor = H5Aexists(file, h5::version_minor) > 0;
  const int found_minor = has_minor ? h5::read_int_attribute(file, h5::version_minor, path) : 0;
  h5::Checksum found;
  Atlas atlas = read_open(file, path);
  h5::verify(file, found, found_minor >= first_minor_with_checksum, path);
  return atlas;
}

}  // namespace granulaw
