// mpm shape: what a body's shape does to its contacts, beside the law of spheres of its local radii.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <vector>

#include "atlas/law_from_atlas.hpp"
#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "characterise/body/characterised_body.hpp"
#include "characterise/body/law_material.hpp"
#include "characterise/run/request.hpp"
#include "characterise/shape/shape_certificate.hpp"
#include "command.hpp"
#include "farm_options.hpp"
#include "json_output.hpp"
#include "law/law_file.hpp"
#include "material_file/materials_file.hpp"
#include "material_file/shape_reader.hpp"
#include "option_checks.hpp"
#include "own_files.hpp"
#include "shape_output.hpp"
#include "terminal.hpp"

namespace granulaw {

namespace of_shape {

struct ShapeRequest
{
  std::string materials, particle, law, output, picture;
  ShapeQuestion question;
  FarmOptions farm;
  bool json = false;
};

/// Law of the sphere of the particle's material: from the law file that is given, else from the atlas.
BodyLaw sphere_law(const Particle& particle, const ShapeRequest& r)
{
  const LawMaterial material = law_material(r.particle, particle.materials.front());
  if (!r.law.empty()) {
    Law law = read_law(r.law);
    for (auto& [name, body] : law.bodies) {
      const LawMaterial& m = body.material;
      if (body.is_sphere() && m.youngs_modulus == material.youngs_modulus && m.yield_stress == material.yield_stress && m.poisson_ratio == material.poisson_ratio)
        return std::move(body);
    }
    fail(r.law, fmt::format("holds no law of a sphere of the material of '{}'", r.particle));
  }
  const Material& m = particle.materials.front();
  check_von_mises(m, r.particle);
  if (material.yields() && (!m.hardening.name.empty() || m.rate_dependent()))
    fail("--law", "is needed: the atlas does not know the flow law of this material", {}, "the law file of mpm table for its sphere");
  const std::optional<Atlas> atlas = own_atlas();
  if (!atlas) fail("--law", "is needed: there is no atlas beside the program");
  BuildOptions options;
  options.depth = 0.5;
  options.fastest = 0.3;
  return law_from(*atlas, material, options);
}

void write_map(const ShapeCertificate& certificate, const std::string& path)
{
  std::string text =
      "direction_x,direction_y,direction_z,velocity_m_per_s,contact,sharper_radius_m,flatter_radius_m,effective_mass_share,height_m,force_max_N,restitution,law_force_max_N,law_restitution,law_with_body_force_max_N,law_with_body_restitution\n";
  for (const OrientationCheck& c : certificate.checks) {
    const std::array<double, 3>& n = c.direction;
    text += fmt::format("{:.6f},{:.6f},{:.6f},{:g},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", n[0], n[1], n[2], c.velocity,
        name_of(c.local), c.sharper_radius, c.flatter_radius, c.effective_mass, c.height, c.solver.force_max, c.solver.restitution, c.law.force_max, c.law.restitution,
        c.law_with_body.force_max, c.law_with_body.restitution);
  }
  write_text_atomically(path, text);
}

void print_directions(const ShapeCertificate& certificate)
{
  fmt::print("   direction            V m/s   R', R'' mm       m_e/m   F_max N    e      law: F      e    with body: F   e\n");
  for (const OrientationCheck& c : certificate.checks) {
    const std::array<double, 3>& n = c.direction;
    fmt::print("{:6.2f} {:6.2f} {:6.2f}  {:7.4g}  {:7.4g} {:7.4g}  {:6.3f}  {:9.4g}  {:.3f}", n[0], n[1], n[2], c.velocity, 1e3 * c.sharper_radius,
        1e3 * c.flatter_radius, c.effective_mass, c.solver.force_max, c.solver.restitution);
    if (c.local == OrientationCheck::Local::curved)
      fmt::print("  {:+6.1f} %  {:+.3f}  {:+6.1f} %  {:+.3f}\n", 100 * c.force_error(c.law), c.restitution_error(c.law), 100 * c.force_error(c.law_with_body),
          c.restitution_error(c.law_with_body));
    else
      fmt::print("  {}\n", name_of(c.local));
  }
}

void print_json_of(const ShapeCertificate& certificate, const FarmCount& count)
{
  nlohmann::ordered_json out = as_json(certificate);
  out["cpu_s"] = count.cpu_s;
  print_json(out);
}

void certify(ShapeRequest& r)
{
  r.farm.check();
  check_output("-o", r.output, ".csv");
  check_output("--plot", r.picture, ".png, .pdf, .svg");
  const MaterialsFile materials = read_materials(r.materials);
  const Particle& particle = materials.particle(r.particle);
  const BodyLaw law = sphere_law(particle, r);
  const std::unique_ptr<Farm> farm = r.farm.farm();
  ShapeCertificate certificate;
  fmt::print(stderr, "mpm: {} impacts by the solver in three dimensions\n", certificate_runs(particle, r.question));
  {
    ProgressBar bar;
    certificate = certify_shape(particle, law, r.question, *farm, [&](double done, const std::string& what) { bar.update(done, what); });
  }
  if (!r.output.empty()) write_map(certificate, r.output);
  if (!r.picture.empty()) draw_shape("shape", r.particle, certificate, r.picture);
  if (r.json) return print_json_of(certificate, farm->count());
  print_directions(certificate);
  print_shape(r.particle, certificate);
  print_count(farm->count());
}

void define(Options& command)
{
  const auto r = std::make_shared<ShapeRequest>();
  command.add_option("MATERIALS", r->materials, "materials file (TOML)").required();
  command.add_option("--particle", r->particle, "[particle.NAME] of one material, of any shape (" + names_of_shapes() + ") or profile").required();
  command.add_option("--velocity", r->question.velocities, "speeds of the impacts on a rigid wall, m/s").required().check(above_zero());
  command.add_option("--directions,--orientations", r->question.directions, "directions over the whole sphere; the body's mirror planes leave a part of them")
      .check(whole_from_to(4, 10000))
      .capture_default_str();
  command.add_option("--resolution", r->question.resolution, "cells across the contact block: the error of F falls as 1/cells")
      .check(whole_from_to(6, 100))
      .capture_default_str();
  command.add_option("--law", r->law, "law file with the law of a sphere of this material (default: from the atlas)");
  command.add_option("-o,--output", r->output, "NAME.csv: the map, direction by direction");
  command.add_option("--plot", r->picture, "NAME.png, .pdf or .svg: the map as a picture, errors over the sphere of directions");
  command.add_flag("--json", r->json, "print one JSON object instead of the table");
  r->farm.add_to(command);
  command.callback([r] { certify(*r); });
}

}  // namespace of_shape

extern const Command shape_command{"shape",
    "Error of a sphere's law for a particle of any shape: by direction of impact on a wall. The\n"
    "law is used with the local radius of curvature, as for clumps and superquadrics.\n"
    "Example: mpm shape grains.toml --particle pebble --velocity 1 -o pebble.csv",
    of_shape::define};

}  // namespace granulaw
