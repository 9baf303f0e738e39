#include "characterise/shape/shape_certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/state_archive.hpp"
#include "contact/body_behind.hpp"
#include "characterise/body/characterised_body.hpp"
#include "characterise/shape/clump_impact.hpp"
#include "characterise/shape/energetic_restitution.hpp"
#include "characterise/body/law_material.hpp"
#include "characterise/shape/orientations.hpp"
#include "law/replay.hpp"
#include "solver/run/accuracy.hpp"
#include "solver/runs.hpp"
#include "solver/shape/rotation.hpp"
#include "solver/solver_id.hpp"

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
  check.effective_mass = o.effective_mass, check.height = o.height;
  check.local = local_contact(o.radii);
  return check;
}

/// One impact of the certificate. It is turned about the wall's normal so that the contact's principal
/// directions lie along the grid's axes: a long contact has as many cells then as a round one.
struct CertifiedImpact
{
  OrientationCheck check;
  double turn;
  int cells;

  Vector3 direction() const { return {check.direction[0], check.direction[1], check.direction[2]}; }
};

std::vector<CertifiedImpact> impacts_of(const Shape& solid, const ShapeQuestion& question)
{
  std::vector<CertifiedImpact> impacts;
  for (const double velocity : question.velocities)
    for (const Orientation& o : orientations_of(solid, question.directions))
      impacts.push_back(
          {check_of(o, velocity), turn_along(o.direction, o.radii.sharper_direction), question.resolution});
  return impacts;
}

/// Cells of the runs that give what `resolution` costs: fewer, or more where there are no fewer.
int compared_resolution(int resolution)
{
  const int coarse = coarse_partner(resolution);
  return coarse < resolution ? coarse : 4 * resolution / 3;
}

/// The impacts, spread over all, that are made again at another resolution.
std::vector<std::size_t> repeated(std::size_t count)
{
  const std::size_t picks = std::min<std::size_t>(count, 4);
  std::vector<std::size_t> picked;
  for (std::size_t k = 0; k < picks; ++k) picked.push_back((2 * k + 1) * count / (2 * picks));
  return picked;
}

RunJob job_of(const Particle& particle, const std::string& body, const CertifiedImpact& impact)
{
  const std::array<double, 3>& n = impact.check.direction;
  RunJob job;
  job.label = fmt::format("impact on ({:.2f}, {:.2f}, {:.2f})", n[0], n[1], n[2]);
  job.key = fmt::format("{} thrown velocity={:.17g} direction={:.17g},{:.17g},{:.17g} cells={} solver={}",
                        body, impact.check.velocity, n[0], n[1], n[2], impact.cells, solver_id());
  job.cost = std::pow(impact.cells, 4);  // of one body: cells, and steps
  job.run = [particle, impact](const RunOptions& given) {
    RunOptions options = given;
    options.resolution = impact.cells;
    options.shifted_grids = 1;
    options.precision = Precision::single;
    Approach thrown;
    thrown.velocity = impact.check.velocity;
    thrown.orientation = impact.check.direction;
    thrown.turn = impact.turn;
    thrown.first_contact_only = true;
    return granulaw::impact(particle, thrown, {}, options);
  };
  return job;
}

/// Largest force and e of the contact: the centre's velocities say little of it.
ContactAnswer answer_of(const RunResult& run, const CertifiedImpact& impact, const MassProperties& of_one,
                        double density)
{
  const Eigen::Matrix3d turned = rotation_to_plane(impact.direction(), impact.turn);
  const RigidBody rigid{density * of_one.volume, density * turned * of_one.inertia * turned.transpose()};
  return {run.summary.force_max, energetic_restitution(run, rigid, impact.check.velocity)};
}

/// Relative, of F and e. `answers`: of all impacts, then of those of `again` at the other resolution.
double solver_error(const std::vector<ContactAnswer>& answers, const std::vector<std::size_t>& again,
                    std::size_t count, int resolution)
{
  std::vector<double> in_force, in_restitution;
  for (std::size_t k = 0; k < again.size(); ++k) {
    const ContactAnswer &own = answers[again[k]], &other = answers[count + k];
    in_force.push_back(other.force_max / own.force_max - 1);
    in_restitution.push_back(other.restitution / own.restitution - 1);
  }
  const double ratio = static_cast<double>(resolution) / compared_resolution(resolution);
  return std::max(spatial_rule.left(in_force, ratio), spatial_rule.left(in_restitution, ratio));
}

/// The law's answers, alone and with the body behind the contact; nothing where the overlap leaves its table.
void replay(OrientationCheck& check, const BodyLaw& law, double mass)
{
  if (check.local != OrientationCheck::Local::curved) return;
  const double radius = check.local_radius();
  const Replay replay = replay_on_wall(law, radius, mass, check.velocity);
  if (replay.left_range) {
    check.local = OrientationCheck::Local::beyond_law;
    return;
  }
  check.law = {replay.force_max, replay.restitution};
  const double compliance =
      far_field(law.material.poisson_ratio) / law.material.e_star() * reach_behind(radius, check.height);
  const Replay with_body = replay_on_wall(law, radius, mass, check.velocity, compliance);
  check.law_with_body = {with_body.force_max, with_body.restitution};
}

/// The same of all balls of a clump that touch.
void replay_clump(OrientationCheck& check, const BodyLaw& law, std::vector<ClumpBall> balls, const MassProperties& of_one,
                  double density)
{
  const RigidBody body{density * of_one.volume, density * of_one.inertia};
  const Vector3 direction(check.direction[0], check.direction[1], check.direction[2]);
  for (ClumpBall& ball : balls) ball.centre -= of_one.centre;
  const auto impact = [&](bool with_body) { return clump_on_wall(law, balls, body, direction, check.velocity, with_body); };
  const ClumpAnswer alone = impact(false);
  if (alone.left_range)
    check.local = OrientationCheck::Local::beyond_law;
  else
    check.law = alone.contact, check.law_with_body = impact(true).contact;
}

}  // namespace

std::string shape_text(const Shape& solid)
{
  constexpr std::size_t longest = 200;
  const std::string text = solid.definition();
  return text.size() <= longest ? text : fmt::format("{} {:016x}", solid.kind(), checksum(text));
}

std::size_t certificate_runs(const Particle& particle, const ShapeQuestion& question)
{
  const std::size_t count = impacts_of(*shape_of(particle), question).size();
  return count + repeated(count).size();
}

ShapeCertificate certify_shape(const Particle& particle, const BodyLaw& law, const ShapeQuestion& question,
                               Farm& farm, const Progress& progress)
{
  if (particle.materials.size() != 1)
    fail("the certificate of a shape", "needs a body of one material",
         fmt::format("{} materials", particle.materials.size()), "one");
  const SharedShape solid = shape_of(particle);
  const MassProperties of_one = solid->mass_properties();
  const std::vector<ClumpBall> balls = balls_of(*solid);
  const double density = particle.materials[0].density;
  ShapeCertificate certificate;
  certificate.shape = shape_text(*solid), certificate.volume = of_one.volume;
  certificate.mirrors = solid->symmetric();
  std::vector<CertifiedImpact> impacts = impacts_of(*solid, question);
  const std::size_t count = impacts.size();
  const std::vector<std::size_t> again = repeated(count);
  for (const std::size_t k : again) {
    impacts.push_back(impacts[k]);
    impacts.back().cells = compared_resolution(question.resolution);
  }
  const std::string body = fmt::format("{} {}", solid->definition(), description_of(particle.materials[0]));
  std::vector<RunJob> jobs;
  for (const CertifiedImpact& impact : impacts) jobs.push_back(job_of(particle, body, impact));
  const std::vector<RunResult> runs = farm.run_all(jobs, progress);

  std::vector<ContactAnswer> answers;
  for (std::size_t k = 0; k < impacts.size(); ++k)
    answers.push_back(answer_of(runs[k], impacts[k], of_one, density));
  for (std::size_t k = 0; k < count; ++k) {
    certificate.checks.push_back(impacts[k].check);
    certificate.checks.back().solver = answers[k];
    if (balls.empty())
      replay(certificate.checks.back(), law, density * of_one.volume * impacts[k].check.effective_mass);
    else
      replay_clump(certificate.checks.back(), law, balls, of_one, density);
  }
  certificate.solver_error = solver_error(answers, again, count, question.resolution);
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
