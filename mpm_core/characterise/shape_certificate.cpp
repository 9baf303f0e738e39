#include "characterise/shape_certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "characterise/characterised_body.hpp"
#include "characterise/energetic_restitution.hpp"
#include "characterise/law_material.hpp"
#include "characterise/orientations.hpp"
#include "law/replay.hpp"
#include "solver/output/state_archive.hpp"
#include "solver/run/accuracy.hpp"
#include "solver/solid/body_frame.hpp"
#include "solver/solver_id.hpp"
#include "solver/spatial/spatial_runs.hpp"

namespace granulaw {

namespace {

/// The sphere that has the local contact, if there is one.
OrientationCheck::Local local_contact(const PrincipalRadii& radii)
{
  if (radii.sharper == 0) return OrientationCheck::Local::edge;
  if (radii.sharper < 0 || std::isinf(radii.flatter)) return OrientationCheck::Local::flat;
  return OrientationCheck::Local::curved;
}

OrientationCheck check_of(const Orientation& o, double velocity)
{
  OrientationCheck check;
  check.direction = {o.direction.x(), o.direction.y(), o.direction.z()};
  check.velocity = velocity;
  check.sharper_radius = o.radii.sharper, check.flatter_radius = o.radii.flatter;
  check.effective_mass = o.effective_mass;
  check.local = local_contact(o.radii);
  return check;
}

RunJob job_of(const Particle& particle, const std::string& body, const OrientationCheck& check,
              int resolution)
{
  const std::array<double, 3>& n = check.direction;
  RunJob job;
  job.label = fmt::format("impact on ({:.2f}, {:.2f}, {:.2f})", n[0], n[1], n[2]);
  job.key = fmt::format("{} thrown velocity={:.17g} direction={:.17g},{:.17g},{:.17g} cells={} solver={}",
                        body, check.velocity, n[0], n[1], n[2], resolution, solver_id());
  job.run = [particle, check, resolution](const RunOptions& given) {
    RunOptions options = given;
    options.resolution = resolution;
    options.shifted_grids = 1;
    BodyThrow thrown;
    thrown.velocity = check.velocity;
    thrown.orientation = check.direction;
    return run_body_impact(particle, thrown, options);
  };
  return job;
}

/// The law's answer; nothing where the overlap leaves its table.
void replay(OrientationCheck& check, const BodyLaw& law, double mass)
{
  if (check.local != OrientationCheck::Local::curved) return;
  const Replay replay = replay_on_wall(law, check.local_radius(), mass, check.velocity);
  if (replay.left_range) {
    check.local = OrientationCheck::Local::beyond_law;
    return;
  }
  check.law = {replay.force_max, replay.restitution};
}

}  // namespace

std::string shape_text(const Solid& solid)
{
  constexpr std::size_t longest = 200;
  const std::string text = solid.definition();
  return text.size() <= longest ? text : fmt::format("{} {:016x}", solid.kind(), checksum(text));
}

ShapeCertificate certify_shape(const Particle& particle, const BodyLaw& law, const ShapeQuestion& question,
                               Farm& farm, const Progress& progress)
{
  if (particle.materials.size() != 1)
    fail("the certificate of a shape", "needs a body of one material",
         fmt::format("{} materials", particle.materials.size()), "one");
  const std::shared_ptr<const Solid> solid = solid_of(particle);
  const MassProperties of_one = solid->mass_properties();
  const double density = particle.materials[0].density, mass = density * of_one.volume;
  ShapeCertificate certificate;
  certificate.shape = shape_text(*solid), certificate.volume = of_one.volume;
  certificate.mirrors = solid->symmetric();
  for (const double velocity : question.velocities)
    for (const Orientation& orientation : orientations_of(*solid, question.directions))
      certificate.checks.push_back(check_of(orientation, velocity));

  const std::string body = fmt::format("{} {}", solid->definition(), description_of(particle.materials[0]));
  std::vector<RunJob> jobs;
  for (const OrientationCheck& check : certificate.checks)
    jobs.push_back(job_of(particle, body, check, question.resolution));
  // the last direction again with fewer cells: what these cells cost
  jobs.push_back(job_of(particle, body, certificate.checks.back(), coarse_partner(question.resolution)));
  const std::vector<RunResult> runs = farm.run_all(jobs, progress);

  for (std::size_t k = 0; k < certificate.checks.size(); ++k) {
    OrientationCheck& check = certificate.checks[k];
    const Vector3 direction(check.direction[0], check.direction[1], check.direction[2]);
    const Eigen::Matrix3d turned = rotation_to_plane(direction);
    const RigidBody rigid{mass, density * turned * of_one.inertia * turned.transpose()};
    check.solver = {runs[k].summary.force_max, energetic_restitution(runs[k], rigid, check.velocity)};
    replay(check, law, mass * check.effective_mass);
  }
  const RunResult& last = runs[certificate.checks.size() - 1];
  certificate.solver_error = error_between(last, runs.back());
  return certificate;
}

double usual_velocity(const LawMaterial& material, double largest_damage_number)
{
  constexpr double usual = 0.0025, elastic = 0.005;
  if (!material.yields()) return elastic * std::sqrt(material.e_star() / material.density);
  const double damage_number = largest_damage_number > 0 ? std::min(usual, largest_damage_number) : usual;
  return std::sqrt(damage_number) * speed_unit(material);
}

}  // namespace granulaw
