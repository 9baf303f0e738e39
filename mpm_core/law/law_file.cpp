#include "law/law_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "law/h5.hpp"
#include "law/h5_checksum.hpp"
#include "law/h5_structure.hpp"
#include "law/layout.hpp"
#include "law/range.hpp"
#include "law/shape_certificate_file.hpp"

namespace granulaw {

namespace {

// A file may be hostile: it makes the reader allocate about four times its size. A node costs some 200 bytes (its
// values and its interval's coefficients), and 60 in the file.
constexpr std::size_t most_nodes = 65536, most_bodies = 256, most_pairs = 65536, most_notes = 2 * most_laws_of_file,
                      most_radius_ratios = 64, most_axis_costs = 256;
constexpr std::size_t most_nodes_together = 1024 * most_laws_of_file, most_note_bytes = 1u << 20;

/// Text of a file within a sentence: its beginning.
std::string shortened(const std::string& text)
{
  constexpr std::size_t most = 80;
  return text.size() <= most ? fmt::format("'{}'", text) : fmt::format("'{}...'", text.substr(0, most));
}

/// Nodes of the curve and of its axis: each costs about the same.
std::size_t node_count(const Curve& curve)
{
  const std::size_t own = curve.table().force.size();
  return curve.axis() ? own + curve.axis()->force.size() + curve.axis()->reach.size() : own;
}

/// Material constants in any units, but such that no product or ratio of them overflows.
void require_positive(double value, const std::string& where, const h5::Field& field)
{
  if (!(value >= 1e-20 && value <= 1e20))
    fail(where, fmt::format("'{}' is out of range", field.name), fmt::format("{:.6g} {}", value, field.unit),
         "1e-20 to 1e20");
}

/// Names become HDF5 links and parts of "a:b".
constexpr const char* name_rule = "letters, digits, '_', '-' and '.'";
bool usable_name(const std::string& name)
{
  return !name.empty() && name.size() <= 100 && name.find_first_not_of(".") != std::string::npos &&
         name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.") ==
             std::string::npos;
}

void check_name(const std::string& name, const std::string& where)
{
  if (!usable_name(name) || name == wall_name)
    fail(where, "unusable material name", shortened(name),
         fmt::format("{}, and not '{}'", name_rule, wall_name));
}

/// Nodes as FlowNodes has them.
void check_flow(const FlowNodes& flow, const std::string& where)
{
  constexpr std::size_t most = 4096;
  if (flow.strain.size() != flow.stress.size() || flow.strain.size() == 1 || flow.strain.size() > most)
    fail(where, fmt::format("'{}' and '{}' have the wrong lengths", h5::flow_strain.name, h5::flow_stress.name),
         fmt::format("{} and {}", flow.strain.size(), flow.stress.size()), fmt::format("alike, 2 to {}", most));
  for (std::size_t k = 0; k < flow.strain.size(); ++k) {
    if (k == 0 ? flow.strain[k] != 0 : !(flow.strain[k] > flow.strain[k - 1] && std::isfinite(flow.strain[k])))
      fail(where, fmt::format("'{}' is no ascending row from 0", h5::flow_strain.name), fmt::format("{:.6g}", flow.strain[k]));
    require_positive(flow.stress[k], where, h5::flow_stress);
  }
}

/// Speeds ascend from above 0; costs as those of the certificate.
void check_omitted_axis(const std::vector<AxisCost>& costs, const std::string& where)
{
  double before = 0;
  for (const AxisCost& cost : costs) {
    if (!(cost.speed > before && std::isfinite(cost.speed)))
      fail(where, fmt::format("'{}' is no ascending row above 0", h5::axis_cost_fields[0].field.name),
           fmt::format("{:.6g}", cost.speed));
    before = cost.speed;
    for (const double value : {cost.force, cost.restitution})
      if (!(value >= -1 && std::isfinite(value)))
        fail(where, "a cost of the omitted velocity axis is out of range", fmt::format("{:.6g}", value), "-1 or more");
  }
}

/// Conditions between the numbers of one body, beyond what Curve::fault() finds in its nodes.
void check_body(const BodyLaw& body, const std::string& where)
{
  const LawMaterial& m = body.material;
  require_positive(m.density, where, h5::density);
  require_positive(m.youngs_modulus, where, h5::youngs_modulus);
  if (!(m.poisson_ratio >= 0 && m.poisson_ratio < 0.5))
    fail(where, "'poisson_ratio' is out of range", fmt::format("{:.6g}", m.poisson_ratio), "0 to below 0.5");
  if (m.yields() || !(m.yield_stress > 0)) require_positive(m.yield_stress, where, h5::yield_stress);
  if (m.hardening_modulus != 0) require_positive(m.hardening_modulus, where, h5::hardening_modulus);
  check_flow(m.flow, where);
  if (m.yields() != std::isfinite(body.curve.onset()))
    fail(where, m.yields() ? "the material yields but its curve has no onset"
                           : "the material is elastic but its curve has an onset of yield");
  for (const h5::CertificateField& c : h5::certificate_fields)
    if (const double value = body.certificate.*c.value;
        !(value >= (c.is_signed ? -1.0 : 0.0)) ||
        (!std::isfinite(value) && c.value != &Certificate::damage_number_max))
      // NaN fails as well; damage_number_max alone may be infinite (elastic)
      fail(where, fmt::format("certificate '{}' is out of range", c.field.name), fmt::format("{:.6g}", value),
           c.is_signed ? "-1 or more" : "0 or more");
  if (m.yields() && std::isinf(body.certificate.damage_number_max))
    fail(where, "certificate 'max_inertia' of a body that yields is infinite");
  for (const h5::BoundField& b : h5::bound_fields)
    if (const double value = body.bound.*b.value; !(value >= 0) || (std::isinf(value) && &b < &h5::bound_fields[5]))
      fail(where, fmt::format("'{}' is out of range", b.field.name), fmt::format("{:.6g}", value), "0 or more");
  check_omitted_axis(body.bound.omitted_axis, where);
  if (std::find(std::begin(h5::origins), std::end(h5::origins), body.certificate.origin) ==
      std::end(h5::origins))
    fail(where, "unknown 'origin' of the certificate", shortened(body.certificate.origin),
         "runs, atlas, composed");
  if (body.curve.axis() && !m.yields())
    fail(where, "the material is elastic but its curve has a velocity axis");
  if (!usable_name(body.body)) fail(where, "unusable name of a body", shortened(body.body), name_rule);
  if (body.pole_radius != 0) require_positive(body.pole_radius, where, h5::pole_radius);
  require_positive(body.mass_ratio, where, h5::mass_ratio);
  if (body.is_sphere() && body.mass_ratio != 1)
    fail(where, "'mass_ratio' of a homogeneous sphere", fmt::format("{:.6g}", body.mass_ratio), "1");
  if (!body.is_sphere() && body.pole_radius == 0)
    fail(where, fmt::format("'pole_radius' of the body {} is missing", shortened(body.body)));
  if (body.shape) h5::check_shape_certificate(*body.shape, where);
}

void check_own_law(const std::string& name, const TwoBodyLaw& own, bool one_material,
                   const std::string& where)
{
  const bool composed = own.law.certificate.origin == composed_origin;
  if (!own.law.material.yields() && !composed)
    fail(where, "a pair's own law by runs needs a body that yields", shortened(name));
  if (!own.law.is_sphere()) fail(where, "a pair's own law is one of homogeneous spheres", shortened(name));
  const double least = one_material ? std::nextafter(1.0, 2.0) : 1 / most_unlike_sizes;
  const bool wall = composed && (std::isinf(own.radius_ratio) || (own.radius_ratio == 0 && !one_material));
  if (!wall && !(own.radius_ratio >= least && own.radius_ratio <= most_unlike_sizes))
    fail(where,
         fmt::format("'{}' of the pair {} is out of range", h5::radius_ratio_of_runs.name, shortened(name)),
         fmt::format("{:.6g}", own.radius_ratio), one_material ? "over 1, up to 100" : "0.01 to 100");
}

void check_pair_laws(const Law& law, const std::string& name, const std::vector<TwoBodyLaw>& laws,
                     const std::string& where)
{
  const auto pair = std::find_if(law.pairs.begin(), law.pairs.end(),
                                 [&](const LawPair& p) { return p.a + ':' + p.b == name; });
  if (pair == law.pairs.end())
    fail(where, fmt::format("holds a law for the pair {}, which is not among its pairs", shortened(name)));
  if (pair->b == wall_name || pair->a == wall_name)
    fail(where, "a pair with the rigid wall has no law of its own", shortened(name));
  if (pair->a != pair->b && law.pair_laws.contains(pair->b + ':' + pair->a))
    fail(where, "the pair has two laws of its own, one in each order", shortened(name));
  for (const std::string& body : {pair->a, pair->b})
    if (!law.bodies.at(body).is_sphere())
      fail(where, "a pair's own law is one of homogeneous spheres", shortened(name));
  if (laws.empty() || laws.size() > most_radius_ratios)
    fail(where, fmt::format("the pair {} has an unusable number of laws of its own", shortened(name)),
         std::to_string(laws.size()), fmt::format("1 to {}", most_radius_ratios));
  for (std::size_t k = 0; k < laws.size(); ++k) {
    check_own_law(name, laws[k], pair->a == pair->b, where);
    if (k > 0 && !(laws[k].radius_ratio > laws[k - 1].radius_ratio))
      fail(where, fmt::format("the laws of the pair {} do not ascend in '{}'", shortened(name),
                              h5::radius_ratio_of_runs.name));
  }
}

/// The material that yields in the pair "a:b" of the file.
const LawMaterial& yielding_of(const Law& law, const std::string& pair, const std::string& where)
{
  const auto colon = pair.find(':');
  const auto a = law.bodies.find(pair.substr(0, colon)),
             b = law.bodies.find(colon == std::string::npos ? std::string() : pair.substr(colon + 1));
  if (a == law.bodies.end() || b == law.bodies.end())
    fail(where, fmt::format("holds a law for the pair {}, which is not among its pairs", shortened(pair)));
  const LawMaterial &first = a->second.material, &second = b->second.material;
  return yields_first(first, second) ? first : second;
}

void check_pairs(const Law& law, const std::string& where)
{
  if (law.bodies.empty()) fail(where, "the law has no material");
  if (law.pairs.empty()) fail(where, "the law names no pair");
  for (const LawPair& pair : law.pairs) {
    const std::string text = shortened(pair.a + ':' + pair.b);
    if (pair.a == wall_name && pair.b == wall_name) fail(where, "unusable pair", text, "a:b or a:wall");
    for (const std::string& name : {pair.a, pair.b})
      if (name != wall_name && !law.bodies.contains(name))
        fail(where, fmt::format("the pair {} names a material that the file does not hold", text));
    if (pair.a != wall_name && pair.b != wall_name)
      check_partners(law.bodies.at(pair.a), law.bodies.at(pair.b), where);
  }
  for (const auto& [name, laws] : law.pair_laws) check_pair_laws(law, name, laws, where);
}

template <class Table>
void read_column(hid_t group, const h5::ColumnField<Table>& f, Table& table, const std::string& where)
{
  table.*f.column = {h5::read_vector(group, f.values, most_nodes, where),
                     h5::read_vector(group, f.slopes, most_nodes, where)};
}

template <class Table>
void write_column(hid_t group, const h5::ColumnField<Table>& f, const Table& table, const std::string& path)
{
  h5::write_vector(group, f.values, (table.*f.column).value, path);
  h5::write_vector(group, f.slopes, (table.*f.column).slope, path);
}

AxisTable read_axis(hid_t body, const std::string& where)
{
  const h5::Handle group = h5::open_group(body, h5::velocity_axis, where);
  AxisTable axis;
  const std::string kind = h5::read_text_attribute(group, h5::kind, where);
  if (kind != h5::kind_inertia && kind != h5::kind_rate)
    fail(where, "unknown 'kind' of the velocity axis", shortened(kind),
         fmt::format("{}, {}", h5::kind_inertia, h5::kind_rate));
  const bool rate = kind == h5::kind_rate;
  axis.by = rate ? AxisTable::By::rate : AxisTable::By::inertia;
  for (const h5::AxisNumber& n : h5::axis_numbers)
    if (rate || !n.of_rate) axis.*n.value = h5::read_scalar(group, n.field, where);
  for (const auto& f : h5::axis_columns) read_column(group, f, axis, where);
  for (const h5::ListField& f : h5::axis_lists)
    axis.*f.values = h5::read_vector(group, f.field, most_nodes, where);
  return axis;
}

void write_axis(hid_t body, const AxisTable& axis, const std::string& path)
{
  const h5::Handle group = h5::create_group(body, h5::velocity_axis, path);
  const bool rate = axis.by == AxisTable::By::rate;
  h5::write_text_attribute(group, h5::kind, rate ? h5::kind_rate : h5::kind_inertia, path);
  for (const h5::AxisNumber& n : h5::axis_numbers)
    if (rate || !n.of_rate) h5::write_scalar(group, n.field, axis.*n.value, path);
  for (const auto& f : h5::axis_columns) write_column(group, f, axis, path);
  for (const h5::ListField& f : h5::axis_lists) h5::write_vector(group, f.field, axis.*f.values, path);
}

Curve read_curve(hid_t group, const std::string& where)
{
  const h5::Handle c = h5::open_group(group, h5::curve, where);
  CurveTable table;
  if (h5::has_link(c, h5::onset.name)) table.onset = h5::read_scalar(c, h5::onset, where);
  table.end = h5::read_scalar(c, h5::end, where);
  const double octaves = h5::read_scalar(c, h5::octaves, where);
  if (!(octaves >= 0 && octaves <= 64 && octaves == std::floor(octaves)))
    fail(where, "'octaves' is out of range", fmt::format("{:.6g}", octaves), "a whole number from 0 to 64");
  table.octaves = static_cast<int>(octaves);
  for (const auto& f : h5::curve_columns) {
    const bool only_yielding = &f >= h5::curve_columns + 2;
    if (!only_yielding || table.yields()) read_column(c, f, table, where);
  }
  if (h5::has_link(c, h5::unloading_radius.name)) {
    const std::vector<double> values = h5::read_vector(c, h5::unloading_radius, 3 * most_nodes, where);
    if (values.size() % 3 != 0)
      fail(where, fmt::format("'{}' has the wrong length", h5::unloading_radius.name), std::to_string(values.size()),
           "a multiple of 3");
    for (std::size_t k = 0; k < values.size(); k += 3)
      table.unloading_radius.push_back({values[k], values[k + 1], values[k + 2]});
  }
  std::optional<AxisTable> axis;
  if (h5::has_link(group, h5::velocity_axis)) axis = read_axis(group, where);
  if (const Fault fault = Curve::fault(table, axis ? &*axis : nullptr))
    fail(where, fault.what, fault.found, fault.allowed);
  return Curve(std::move(table), std::move(axis));
}

void write_curve(hid_t group, const Curve& curve, const std::string& path)
{
  const CurveTable& table = curve.table();
  const h5::Handle c = h5::create_group(group, h5::curve, path);
  if (std::isfinite(table.onset)) h5::write_scalar(c, h5::onset, table.onset, path);
  h5::write_scalar(c, h5::end, table.end, path);
  h5::write_scalar(c, h5::octaves, table.octaves, path);
  for (const auto& f : h5::curve_columns)
    if ((table.*f.column).size() > 0) write_column(c, f, table, path);
  std::vector<double> radii;
  for (const auto& row : table.unloading_radius) radii.insert(radii.end(), row.begin(), row.end());
  if (!radii.empty()) h5::write_vector(c, h5::unloading_radius, radii, path);
  if (curve.axis()) write_axis(group, *curve.axis(), path);
}

/// Older files have the cost of an axis that was left out at its end alone.
void add_omitted_axis(BodyLaw& law)
{
  const Certificate& c = law.certificate;
  const bool costs = c.axis_cost_force != 0 || c.axis_cost_restitution != 0;
  if (!law.curve.axis() && costs && law.bound.omitted_axis.empty() && c.damage_number_max > 0)
    law.bound.omitted_axis = {{std::sqrt(c.damage_number_max), c.axis_cost_force, c.axis_cost_restitution}};
}

/// Certificate and bound of the law, whose curve is read.
void read_errors(hid_t group, BodyLaw& law, const std::string& where)
{
  const h5::Handle k = h5::open_group(group, h5::certificate, where);
  Certificate& certificate = law.certificate;
  for (const h5::CertificateField& f : h5::certificate_fields)
    certificate.*f.value = h5::read_scalar(k, f.field, where);
  if (h5::has_link(k, h5::axis_cost_fields[0].field.name))
    for (const h5::AxisCostField& f : h5::axis_cost_fields) {
      const std::vector<double> values = h5::read_vector(k, f.field, most_axis_costs, where);
      std::vector<AxisCost>& costs = law.bound.omitted_axis;
      if (&f == h5::axis_cost_fields) costs.resize(values.size());
      if (values.size() != costs.size() || values.empty())
        fail(where, fmt::format("'{}' has the wrong length", f.field.name), std::to_string(values.size()),
             std::to_string(costs.size()));
      for (std::size_t n = 0; n < values.size(); ++n) costs[n].*f.value = values[n];
    }
  certificate.origin = h5::read_text_attribute(k, h5::origin, where);
  if (h5::has_link(k, h5::bound_fields[0].field.name)) {
    for (const h5::BoundField& f : h5::bound_fields)
      if (f.value != &ErrorBound::confined_force || h5::has_link(k, f.field.name)) law.bound.*f.value = h5::read_scalar(k, f.field, where);
    return;
  }
  law.state();
  add_omitted_axis(law);
}

void write_errors(hid_t group, const BodyLaw& law, const std::string& path)
{
  const h5::Handle k = h5::create_group(group, h5::certificate, path);
  const Certificate& certificate = law.certificate;
  for (const h5::BoundField& f : h5::bound_fields) h5::write_scalar(k, f.field, law.bound.*f.value, path);
  for (const h5::CertificateField& f : h5::certificate_fields)
    h5::write_scalar(k, f.field, certificate.*f.value, path);
  for (const h5::AxisCostField& f : h5::axis_cost_fields) {
    std::vector<double> values;
    for (const AxisCost& cost : law.bound.omitted_axis) values.push_back(cost.*f.value);
    if (!values.empty()) h5::write_vector(k, f.field, values, path);
  }
  h5::write_text_attribute(k, h5::origin, certificate.origin, path);
}

BodyLaw read_body(hid_t group, const std::string& name, const std::string& path)
{
  const std::string where = fmt::format("{}, material '{}'", path, name);
  BodyLaw body;

  const h5::Handle m = h5::open_group(group, h5::material, where);
  body.material.name = name;
  body.material.density = h5::read_scalar(m, h5::density, where);
  body.material.youngs_modulus = h5::read_scalar(m, h5::youngs_modulus, where);
  body.material.poisson_ratio = h5::read_scalar(m, h5::poisson_ratio, where);
  if (h5::has_link(m, h5::yield_stress.name))
    body.material.yield_stress = h5::read_scalar(m, h5::yield_stress, where);
  body.material.hardening_modulus = h5::read_scalar(m, h5::hardening_modulus, where);
  if (h5::has_link(m, h5::flow_strain.name))
    body.material.flow = {h5::read_vector(m, h5::flow_strain, most_nodes, where),
                          h5::read_vector(m, h5::flow_stress, most_nodes, where)};

  body.curve = read_curve(group, where);
  read_errors(group, body, where);
  body.body = h5::read_text_attribute(group, h5::body, where);
  body.pole_radius = h5::read_scalar(group, h5::pole_radius, where);
  body.mass_ratio = h5::read_scalar(group, h5::mass_ratio, where);
  if (h5::has_link(group, h5::orientations)) body.shape = h5::read_shape_certificate(group, where);

  check_body(body, where);
  return body;
}

void write_body(hid_t group, const BodyLaw& body, const std::string& path)
{
  const h5::Handle m = h5::create_group(group, h5::material, path);
  h5::write_scalar(m, h5::density, body.material.density, path);
  h5::write_scalar(m, h5::youngs_modulus, body.material.youngs_modulus, path);
  h5::write_scalar(m, h5::poisson_ratio, body.material.poisson_ratio, path);
  if (body.material.yields()) h5::write_scalar(m, h5::yield_stress, body.material.yield_stress, path);
  h5::write_scalar(m, h5::hardening_modulus, body.material.hardening_modulus, path);
  if (!body.material.flow.strain.empty()) {
    h5::write_vector(m, h5::flow_strain, body.material.flow.strain, path);
    h5::write_vector(m, h5::flow_stress, body.material.flow.stress, path);
  }

  write_curve(group, body.curve, path);
  write_errors(group, body, path);
  h5::write_text_attribute(group, h5::body, body.body, path);
  h5::write_scalar(group, h5::pole_radius, body.pole_radius, path);
  h5::write_scalar(group, h5::mass_ratio, body.mass_ratio, path);
  if (body.shape) h5::write_shape_certificate(group, *body.shape, path);
}

TwoBodyLaw read_two_body_law(hid_t group, const LawMaterial& yielding, const std::string& where)
{
  TwoBodyLaw own;
  own.law.material = yielding;
  own.law.curve = read_curve(group, where);
  read_errors(group, own.law, where);
  own.radius_ratio = h5::has_link(group, h5::radius_ratio_of_runs.name)
                         ? h5::read_scalar(group, h5::radius_ratio_of_runs, where)
                         : std::numeric_limits<double>::infinity();
  check_body(own.law, where);
  return own;
}

void write_two_body_law(hid_t group, const TwoBodyLaw& own, const std::string& path)
{
  write_curve(group, own.law.curve, path);
  write_errors(group, own.law, path);
  if (std::isfinite(own.radius_ratio))
    h5::write_scalar(group, h5::radius_ratio_of_runs, own.radius_ratio, path);
}

/// Subgroups "1", "2", ...
std::vector<TwoBodyLaw> read_laws_of_ratios(hid_t group, const LawMaterial& yielding,
                                            const std::string& where)
{
  std::vector<TwoBodyLaw> laws;
  const std::size_t count = h5::link_names(group, most_radius_ratios, where).size();
  for (std::size_t k = 1; k <= count; ++k)
    laws.push_back(
        read_two_body_law(h5::open_group(group, std::to_string(k).c_str(), where), yielding, where));
  return laws;
}

void write_pair_laws(hid_t group, const std::vector<TwoBodyLaw>& laws, const std::string& path)
{
  if (laws.size() == 1 && std::isfinite(laws.front().radius_ratio))
    return write_two_body_law(group, laws.front(), path);
  for (std::size_t k = 0; k < laws.size(); ++k)
    write_two_body_law(h5::create_group(group, std::to_string(k + 1).c_str(), path), laws[k], path);
}

/// The command that made the file, as its provenance says.
std::string command_of(const h5::Handle& file, const std::string& path)
{
  constexpr const char* usual = "mpm table MATERIALS.toml";
  if (!h5::has_link(file, h5::provenance)) return usual;
  const h5::Handle notes = h5::open_group(file, h5::provenance, path);
  if (H5Aexists(notes, h5::command) <= 0) return usual;
  const std::string command = h5::read_text_attribute(notes, h5::command, path);
  return command.size() <= 300 ? command : usual;
}

/// Refuses what is not a law file of this major version, each case with its own sentence.
h5::Handle open_law(const std::string& path)
{
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) fail(path, "no such file");
  if (!std::filesystem::is_regular_file(path, ignored) || !std::ifstream(path).good())
    fail(path, "cannot be read as a file");
  if (H5Fis_hdf5(path.c_str()) <= 0)
    fail(path, "is not an HDF5 file, so not a contact law (or it was cut off)");
  h5::check_structure(path);
  h5::Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  if (!file.ok()) fail(path, "is damaged or cut off: build it again with `mpm table`");
  if (H5Aexists(file, h5::format) <= 0 || h5::read_text_attribute(file, h5::format, path) != h5::format_value)
    fail(path, "is an HDF5 file but not a contact law of granulaw");
  const int major = h5::read_int_attribute(file, h5::version_major, path);
  if (major < h5::oldest_major)
    fail(path, fmt::format("a law file of version {}, and this program reads {} to {}: make it anew with `{}`",
                           major, h5::oldest_major, h5::major, command_of(file, path)));
  if (major > h5::major)
    fail(path, "the law file's major version is not the one this program reads", std::to_string(major),
         std::to_string(h5::major));
  return file;
}

Law read_open(const h5::Handle& file, const std::string& path)
{
  Law law;

  const h5::Handle bodies = h5::open_group(file, h5::bodies, path);
  std::size_t nodes = 0, orientations = 0;
  std::size_t laws_so_far = 0;
  const auto count_nodes = [&](const Curve& curve) {
    if (++laws_so_far > most_laws_of_file) fail(path, "holds too many laws", {}, fmt::format("up to {}", most_laws_of_file));
    nodes += node_count(curve);
    if (nodes > most_nodes_together)
      fail(path, "the curves have too many nodes together", std::to_string(nodes),
           fmt::format("up to {}", most_nodes_together));
  };
  for (const std::string& name : h5::link_names(bodies, most_bodies, path)) {
    check_name(name, path);
    const BodyLaw& body =
        law.bodies.emplace(name, read_body(h5::open_group(bodies, name.c_str(), path), name, path))
            .first->second;
    count_nodes(body.curve);
    if (body.shape) orientations += body.shape->checks.size();
    if (orientations > h5::most_orientations)
      fail(path, "has too many orientations together", std::to_string(orientations),
           fmt::format("up to {}", h5::most_orientations));
  }

  for (const std::string& pair : h5::read_texts(file, h5::pairs, most_pairs, path)) {
    const auto colon = pair.find(':');
    if (colon == std::string::npos) fail(path, "unusable pair", shortened(pair), "a:b or a:wall");
    law.pairs.push_back({pair.substr(0, colon), pair.substr(colon + 1)});
  }
  for (const h5::Field& f : h5::older_pair_fields)
    if (h5::has_link(file, f.name)) h5::read_vector(file, f, most_pairs, path);

  if (h5::has_link(file, h5::pair_laws)) {
    const h5::Handle own_laws = h5::open_group(file, h5::pair_laws, path);
    for (const std::string& name : h5::link_names(own_laws, most_laws_of_file, path)) {
      const std::string where = fmt::format("{}, law of the pair {}", path, shortened(name));
      const h5::Handle group = h5::open_group(own_laws, name.c_str(), path);
      std::vector<TwoBodyLaw>& laws = law.pair_laws[name];
      const LawMaterial& material = yielding_of(law, name, path);
      if (h5::has_link(group, h5::curve))
        laws.push_back(read_two_body_law(group, material, where));
      else
        laws = read_laws_of_ratios(group, material, where);
      for (const TwoBodyLaw& own : laws) count_nodes(own.law.curve);
    }
  }

  const h5::Handle notes = h5::open_group(file, h5::provenance, path);
  std::size_t bytes = 0;
  for (const std::string& name : h5::attribute_names(notes, most_notes, path)) {
    const std::string& text = law.provenance[name] = h5::read_text_attribute(notes, name.c_str(), path);
    bytes += text.size();
    if (bytes > most_note_bytes)
      fail(path, "the provenance holds too much text", {}, fmt::format("up to {} bytes", most_note_bytes));
  }

  check_pairs(law, path);
  return law;
}

/// read_open(), and compares the checksum.
Law read_verified(const h5::Handle& file, const std::string& path)
{
  const int minor = h5::read_int_attribute(file, h5::version_minor, path);
  h5::Checksum found;
  Law law = read_open(file, path);
  const std::string checksum = h5::verify(file, found, minor >= h5::first_minor_with_checksum, path);
  law.provenance.erase(checksum_note);
  if (!checksum.empty()) law.provenance[checksum_note] = checksum;
  return law;
}

}  // namespace

Law read_law(const std::string& path)
{
  const h5::Silence silence;
  return read_verified(open_law(path), path);
}

Law read_law_image(std::span<const char> image, const std::string& path)
{
  const h5::Silence silence;
  std::vector<char> copy(image.begin(), image.end());  // HDF5 copies it again
  const h5::Handle access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_fapl_core(access, 1u << 16, 0);  // in memory, nothing is written back
  H5Pset_file_image(access, copy.data(), copy.size());
  // HDF5 gives an image a name and refuses that of a file that exists
  const h5::Handle file(H5Fopen((path + "/image in memory").c_str(), H5F_ACC_RDONLY, access));
  if (!file.ok()) fail(path, "the bytes that rank 0 read are no law file");
  return read_verified(file, path);
}

void write_law(const Law& law, const std::string& path)
{
  check_pairs(law, path);
  for (const auto& [name, body] : law.bodies) {
    check_name(name, path);
    check_body(body, fmt::format("{}, material '{}'", path, name));
  }
  for (const auto& [name, laws] : law.pair_laws)
    for (const TwoBodyLaw& own : laws)
      check_body(own.law, fmt::format("{}, law of the pair {}", path, shortened(name)));

  const h5::Silence silence;
  write_atomically(path, [&](const std::string& temporary) {
    h5::Handle file(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    if (!file.ok()) fail(path, "cannot write here (no such folder, or no permission)");
    h5::write_text_attribute(file, h5::format, h5::format_value, path);
    h5::write_int_attribute(file, h5::version_major, h5::major, path);
    h5::write_int_attribute(file, h5::version_minor, h5::minor, path);

    const h5::Handle notes = h5::create_group(file, h5::provenance, path);
    for (const auto& [name, text] : law.provenance)
      if (name != checksum_note) h5::write_text_attribute(notes, name.c_str(), text, path);

    std::vector<std::string> pairs;
    for (const LawPair& pair : law.pairs) pairs.push_back(pair.a + ":" + pair.b);
    h5::write_texts(file, h5::pairs, pairs, path);

    const h5::Handle bodies = h5::create_group(file, h5::bodies, path);
    for (const auto& [name, body] : law.bodies)
      write_body(h5::create_group(bodies, name.c_str(), path), body, path);

    if (!law.pair_laws.empty()) {
      const h5::Handle own_laws = h5::create_group(file, h5::pair_laws, path);
      for (const auto& [name, laws] : law.pair_laws)
        write_pair_laws(h5::create_group(own_laws, name.c_str(), path), laws, path);
    }

    h5::Checksum written;
    read_open(file, path);
    h5::write(file, written, path);
    if (H5Fflush(file, H5F_SCOPE_LOCAL) < 0) fail(path, "cannot write (disk full?)");
  });
}

}  // namespace granulaw
