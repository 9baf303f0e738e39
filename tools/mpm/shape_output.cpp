#include "shape_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "json_output.hpp"
#include "own_files.hpp"

namespace granulaw {

namespace {

nlohmann::ordered_json as_json(const OrientationCheck& c)
{
  nlohmann::ordered_json out;
  out["direction"] = c.direction;
  out["velocity_m_per_s"] = c.velocity;
  out["contact"] = name_of(c.local);
  out["sharper_radius_m"] = json_number(c.sharper_radius);
  out["flatter_radius_m"] = json_number(c.flatter_radius);
  out["effective_mass_share"] = c.effective_mass;
  out["force_max_N"] = c.solver.force_max;
  out["e"] = c.solver.restitution;
  const bool answered = c.local == OrientationCheck::Local::curved;
  out["law_force_max_N"] = answered ? json_number(c.law.force_max) : nullptr;
  out["law_e"] = answered ? json_number(c.law.restitution) : nullptr;
  if (c.height != 0) {
    out["height_m"] = c.height;
    out["law_with_body_force_max_N"] = answered ? json_number(c.law_with_body.force_max) : nullptr;
    out["law_with_body_e"] = answered ? json_number(c.law_with_body.restitution) : nullptr;
  }
  return out;
}

/// "30 orientations at 1.5 m/s": several speeds by commas.
std::string question_text(const ShapeCertificate& certificate)
{
  std::set<double> speeds;
  for (const OrientationCheck& c : certificate.checks) speeds.insert(c.velocity);
  std::string text;
  for (const double v : speeds) text += fmt::format("{}{:.4g}", text.empty() ? "" : ", ", v);
  return fmt::format("{} orientations at {} m/s", certificate.checks.size() / speeds.size(), text);
}

}  // namespace

nlohmann::ordered_json as_json(const ShapeCertificate& certificate)
{
  nlohmann::ordered_json out;
  const ErrorQuantiles force = certificate.force(), e = certificate.restitution();
  out["covered"] = certificate.covered();
  out["force_error_median"] = force.median;
  out["force_error_95"] = force.largest;
  out["restitution_error_median"] = e.median;
  out["restitution_error_95"] = e.largest;
  if (certificate.has_body()) {
    const auto with_body = &OrientationCheck::law_with_body;
    const ErrorQuantiles body_force = certificate.force(with_body), body_e = certificate.restitution(with_body);
    out["with_body"] = {{"force_error_median", body_force.median}, {"force_error_95", body_force.largest}, {"restitution_error_median", body_e.median},
        {"restitution_error_95", body_e.largest}};
  }
  out["solver_error"] = certificate.solver_error;
  out["mirrors"] = certificate.mirrors;
  for (const OrientationCheck& check : certificate.checks) out["directions"].push_back(as_json(check));
  return out;
}

void print_shape(const std::string& name, const ShapeCertificate& certificate)
{
  const ErrorQuantiles force = certificate.force(), e = certificate.restitution();
  fmt::print("{}: the law of spheres at the local radius sqrt(R' R'') answers {:.0f} % of {}\n", name, 100 * certificate.covered(), question_text(certificate));
  if (certificate.covered() > 0)
    fmt::print("{}: F_max off by {:.2g} % in the median, within {:.2g} % in 95 %; e by {:.2g} and {:.2g}; solver error {:.2g} %\n", name, 100 * force.median,
        100 * force.largest, e.median, e.largest, 100 * certificate.solver_error);
  if (certificate.covered() > 0 && certificate.has_body()) {
    const auto with_body = &OrientationCheck::law_with_body;
    const ErrorQuantiles body_force = certificate.force(with_body), body_e = certificate.restitution(with_body);
    fmt::print("{}: with the body behind the contact (bodyCompliance on) F_max by {:.2g} and {:.2g} %, e by {:.2g} and {:.2g}\n", name, 100 * body_force.median,
        100 * body_force.largest, body_e.median, body_e.largest);
  }
  if (certificate.covered() < 1)
    fmt::print("{}: at its edges, corners and flats no sphere is like the contact: the runs' own F_max and e stand in the certificate\n", name);
}

void draw_shape(const char* command, const std::string& name, const ShapeCertificate& certificate, const std::string& picture)
{
  nlohmann::ordered_json input = as_json(certificate);
  input["name"] = name, input["orientations"] = question_text(certificate);
  draw_by_python(command, "plot_shape.py", {picture}, input.dump(), picture);
  fmt::print("wrote {}\n", picture);
}

}  // namespace granulaw
