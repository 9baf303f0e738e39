#include "characterise/shape_certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "characterise/characterised_body.hpp"
#include "law/replay.hpp"
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

RunJob job_of(const Particle& particle, const std::string& body, const OrientationCheck& check,
              int resolution)
{
  const Vector3& n = check.orientation.direction;
  RunJob job;
  job.label = fmt::format("impact on ({:.2f}, {:.2f}, {:.2f})", n.x(), n.y(), n.z());
  job.key = fmt::format("{} thrown velocity={:.17g} direction={:.17g},{:.17g},{:.17g} cells={} solver={}",
                        body, check.velocity, n.x(), n.y(), n.z(), resolution, solver_id());
  job.run = [particle, check, n, resolution](const RunOptions& given) {
    RunOptions options = given;
    options.resolution = resolution;
    options.shifted_grids = 1;
    BodyThrow thrown;
    thrown.velocity = check.velocity;
    thrown.orientation = {n.x(), n.y(), n.z()};
    return run_body_impact(particle, thrown, options);
  };
  return job;
}

ContactAnswer by_solver(const RunResult& run, double mass, double velocity)
{
  return {run.summary.force_max, run.rebound->impulse_normal / (mass * velocity) - 1};
}

/// The law's answer; nothing where the overlap leaves its table.
void replay(OrientationCheck& check, const BodyLaw& law, double mass)
{
  if (check.local != OrientationCheck::Local::curved) return;
  const Replay replay = replay_on_wall(law, check.local_radius, mass, check.velocity);
  if (replay.left_range) {
    check.local = OrientationCheck::Local::beyond_law;
    return;
  }
  check.law = {replay.force_max, replay.restitution};
}

template <class Error>
ErrorQuantiles quantiles(const std::vector<OrientationCheck>& checks, Error error)
{
  std::vector<double> errors;
  for (const OrientationCheck& check : checks)
    if (check.local == OrientationCheck::Local::curved) errors.push_back(std::abs(error(check)));
  if (errors.empty()) return {};
  std::sort(errors.begin(), errors.end());
  const auto at = [&](double share) {
    return errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1) + 0.5)];
  };
  return {at(0.5), at(0.95)};
}

}  // namespace

ErrorQuantiles ShapeCertificate::force() const
{
  return quantiles(checks, [](const OrientationCheck& c) { return c.force_error(); });
}

ErrorQuantiles ShapeCertificate::restitution() const
{
  return quantiles(checks, [](const OrientationCheck& c) { return c.restitution_error(); });
}

double ShapeCertificate::covered() const
{
  const auto answered = std::count_if(checks.begin(), checks.end(), [](const OrientationCheck& c) {
    return c.local == OrientationCheck::Local::curved;
  });
  return static_cast<double>(answered) / static_cast<double>(checks.size());
}

ShapeCertificate certify_shape(const Particle& particle, const BodyLaw& law, const ShapeQuestion& question,
                               Farm& farm, const Progress& progress)
{
  if (particle.materials.size() != 1)
    fail("the certificate of a shape", "needs a body of one material",
         fmt::format("{} materials", particle.materials.size()), "one");
  const std::shared_ptr<const Solid> solid = solid_of(particle);
  const double mass = particle.materials[0].density * solid->mass_properties().volume;
  ShapeCertificate certificate;
  for (const double velocity : question.velocities)
    for (const Orientation& orientation : orientations_of(*solid, question.directions)) {
      const double radius = std::sqrt(orientation.radii.sharper * orientation.radii.flatter);
      certificate.checks.push_back({orientation, velocity, radius, local_contact(orientation.radii), {}, {}});
    }

  const std::string body = fmt::format("{} {}", solid->definition(), description_of(particle.materials[0]));
  std::vector<RunJob> jobs;
  for (const OrientationCheck& check : certificate.checks)
    jobs.push_back(job_of(particle, body, check, question.resolution));
  // the last direction again with fewer cells: what these cells cost
  jobs.push_back(job_of(particle, body, certificate.checks.back(), coarse_partner(question.resolution)));
  const std::vector<RunResult> runs = farm.run_all(jobs, progress);

  for (std::size_t k = 0; k < certificate.checks.size(); ++k) {
    OrientationCheck& check = certificate.checks[k];
    const double resisting = mass * check.orientation.effective_mass;
    check.solver = by_solver(runs[k], resisting, check.velocity);
    replay(check, law, resisting);
  }
  const RunResult& last = runs[certificate.checks.size() - 1];
  certificate.solver_error = error_between(last, runs.back());
  return certificate;
}

}  // namespace granulaw
