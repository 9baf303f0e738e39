#include "law/shape_certificate_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/error.hpp"
#include "law/h5.hpp"
#include "law/layout.hpp"

namespace granulaw::h5 {

namespace {

struct Column
{
  const Field& field;
  std::function<double&(OrientationCheck&)> value;
};

const std::vector<Column>& columns()
{
  using Check = OrientationCheck;
  static const std::vector<Column> all{
      {direction_x, [](Check& c) -> double& { return c.direction[0]; }},
      {direction_y, [](Check& c) -> double& { return c.direction[1]; }},
      {direction_z, [](Check& c) -> double& { return c.direction[2]; }},
      {velocity, [](Check& c) -> double& { return c.velocity; }},
      {sharper_radius, [](Check& c) -> double& { return c.sharper_radius; }},
      {flatter_radius, [](Check& c) -> double& { return c.flatter_radius; }},
      {effective_mass, [](Check& c) -> double& { return c.effective_mass; }},
      {solver_force_max, [](Check& c) -> double& { return c.solver.force_max; }},
      {solver_restitution, [](Check& c) -> double& { return c.solver.restitution; }},
      {law_force_max, [](Check& c) -> double& { return c.law.force_max; }},
      {law_restitution, [](Check& c) -> double& { return c.law.restitution; }},
      {height, [](Check& c) -> double& { return c.height; }},
      {body_force_max, [](Check& c) -> double& { return c.law_with_body.force_max; }},
      {body_restitution, [](Check& c) -> double& { return c.law_with_body.restitution; }}};
  return all;
}

/// Throws unless low <= value <= high.
void require_within(double value, double low, double high, const Field& field, const std::string& where)
{
  if (!(value >= low && value <= high))
    fail(where, fmt::format("'{}' of an orientation is out of range", field.name),
         fmt::format("{:.6g} {}", value, field.unit), fmt::format("{:g} to {:g}", low, high));
}

void check_orientation(const OrientationCheck& c, const std::string& where)
{
  const double length = std::hypot(c.direction[0], c.direction[1], c.direction[2]);
  require_within(length, 1 - 1e-6, 1 + 1e-6, direction_x, where);
  require_within(c.velocity, 1e-20, 1e20, velocity, where);
  require_within(c.effective_mass, 1e-20, 1 + 1e-9, effective_mass, where);
  require_within(c.solver.force_max, 1e-30, 1e30, solver_force_max, where);
  require_within(c.solver.restitution, 0, 1.5, solver_restitution, where);
  if (std::isnan(c.sharper_radius) || std::isnan(c.flatter_radius))
    fail(where, "a radius of curvature is not a number");
  if (c.local != OrientationCheck::Local::curved) return;
  require_within(c.sharper_radius, 1e-20, 1e20, sharper_radius, where);
  require_within(c.flatter_radius, 1e-20, 1e20, flatter_radius, where);
  require_within(c.law.force_max, 1e-30, 1e30, law_force_max, where);
  require_within(c.law.restitution, 0, 1.5, law_restitution, where);
  if (c.height == 0) return;
  require_within(c.height, -1e20, 1e20, height, where);
  require_within(c.law_with_body.force_max, 1e-30, 1e30, body_force_max, where);
  require_within(c.law_with_body.restitution, 0, 1.5, body_restitution, where);
}

OrientationCheck::Local local_of(double number, const std::string& where)
{
  if (!(number == 0 || number == 1 || number == 2 || number == 3))
    fail(where, fmt::format("'{}' of an orientation is unknown", contact_kind.name),
         fmt::format("{:.6g}", number), "0, 1, 2, 3");
  return static_cast<OrientationCheck::Local>(static_cast<int>(number));
}

}  // namespace

ShapeCertificate read_shape_certificate(hid_t owner, const std::string& where)
{
  const Handle group = open_group(owner, orientations, where);
  ShapeCertificate oriented;
  oriented.shape = read_text_attribute(group, shape, where);
  oriented.volume = read_scalar(group, shape_volume, where);
  oriented.solver_error = read_scalar(group, orientations_solver_error, where);
  const std::vector<double> planes = read_vector(group, mirrors, 3, where);
  if (planes.size() != 3) fail(where, fmt::format("'{}' needs three numbers", mirrors.name));
  for (std::size_t d = 0; d < 3; ++d) oriented.mirrors[d] = planes[d] != 0;
  const std::vector<double> kinds = read_vector(group, contact_kind, most_orientations, where);
  oriented.checks.resize(kinds.size());
  for (std::size_t k = 0; k < kinds.size(); ++k) oriented.checks[k].local = local_of(kinds[k], where);
  const bool has_body = has_link(group, height.name);  // older files have none
  for (const Column& column : columns()) {
    if (!has_body && &column.field == &height) break;  // the last columns belong together
    const std::vector<double> values = read_vector(group, column.field, most_orientations, where);
    if (values.size() != kinds.size())
      fail(where, fmt::format("'{}' has the wrong length", column.field.name), std::to_string(values.size()),
           std::to_string(kinds.size()));
    for (std::size_t k = 0; k < values.size(); ++k) column.value(oriented.checks[k]) = values[k];
  }
  check_shape_certificate(oriented, where);
  return oriented;
}

void write_shape_certificate(hid_t owner, const ShapeCertificate& oriented, const std::string& where)
{
  const Handle group = create_group(owner, orientations, where);
  write_text_attribute(group, shape, oriented.shape, where);
  write_scalar(group, shape_volume, oriented.volume, where);
  write_scalar(group, orientations_solver_error, oriented.solver_error, where);
  std::vector<double> values;
  for (const bool mirrored : oriented.mirrors) values.push_back(mirrored);
  write_vector(group, mirrors, values, where);
  std::vector<OrientationCheck> checks = oriented.checks;
  values.clear();
  for (const OrientationCheck& c : checks) values.push_back(static_cast<double>(c.local));
  write_vector(group, contact_kind, values, where);
  for (const Column& column : columns()) {
    values.clear();
    for (OrientationCheck& c : checks) values.push_back(column.value(c));
    write_vector(group, column.field, values, where);
  }
}

void check_shape_certificate(const ShapeCertificate& oriented, const std::string& where)
{
  if (oriented.checks.empty() || oriented.checks.size() > most_orientations)
    fail(where, "has an unusable number of orientations", std::to_string(oriented.checks.size()),
         fmt::format("1 to {}", most_orientations));
  require_within(oriented.volume, 1e-60, 1e60, shape_volume, where);
  require_within(oriented.solver_error, 0, 1e3, orientations_solver_error, where);
  for (const OrientationCheck& check : oriented.checks) check_orientation(check, where);
}

}  // namespace granulaw::h5
