#include "characterise/file/make_law_file.hpp"

#include "characterise/run/request.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <ctime>

#include "base/error.hpp"
#include "base/version.hpp"
#include "atlas/law_without_runs.hpp"
#include "characterise/build/build_law.hpp"
#include "characterise/pair/corrected_law.hpp"
#include "characterise/body/law_body.hpp"
#include "characterise/body/law_material.hpp"
#include "characterise/shape/shape_certificate.hpp"
#include "characterise/pair/two_body_law.hpp"
#include "law/plan_notes.hpp"

namespace granulaw {

namespace {

using Provenance = std::map<std::string, std::string>;

std::string now_utc()
{
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

/// A flow law as the materials file has it.
std::string text_of(const FlowLaw& law)
{
  std::string text = law.name;
  for (const auto& [key, values] : law.values)
    text += fmt::format(", {} = {:g}", key, fmt::join(values, " "));
  return text;
}

/// The size and the speeds that the law of a rate-dependent body holds for.
std::string size_of(const LawBody& body, const BodyLaw& law)
{
  return fmt::format("rate-dependent: holds for R = {:g} m and from {:.3g} m/s on a wall", body.characterised.scale.length,
                     law.curve.axis()->speed_begin * speed_unit(body.material));
}

void note_holes(const std::string& name, const std::vector<std::string>& holes, Provenance& provenance)
{
  for (std::size_t k = 0; k < holes.size(); ++k)
    provenance[fmt::format("hole.{}.{}", name, k + 1)] = holes[k];
}

/// Records the runs from which a body's law was made.
void note_runs(const std::string& name, const BuiltLaw& built, Provenance& provenance)
{
  note_holes(name, built.holes, provenance);
  provenance["sampling_plan." + name] = fmt::format("{} runs", built.runs);
  if (!built.guide.empty()) provenance["guide." + name] = built.guide;
  if (!built.rate_free.empty()) provenance["rate_free." + name] = built.rate_free;
  provenance["admissible." + name] =
      fmt::format("the fitted e changed by {:.2g} % at most", 100 * built.change_of_restitution);
}

/// Records properties of a material beyond the numbers that the file stores.
void note_flow_laws(const std::string& name, const std::vector<Material>& materials, Provenance& provenance)
{
  if (materials.size() != 1) return;
  if (!materials[0].hardening.name.empty()) provenance["hardening." + name] = text_of(materials[0].hardening);
  if (materials[0].rate_dependent()) provenance["rate." + name] = text_of(materials[0].rate);
}

void note_count(const FarmCount& count, Provenance& provenance)
{
  provenance["runs_made"] = fmt::format("{}", count.made);
  provenance["runs_from_cache"] = fmt::format("{}", count.from_cache);
  provenance["runs_retried"] = fmt::format("{}", count.retried);
  provenance["runs_failed"] = fmt::format("{}", count.failed);
  provenance["cpu_s"] = fmt::format("{:.1f}", count.cpu_s);
}

/// Makes the laws of a plan, one after the other.
class Maker
{
 public:
  Maker(const LawFilePlan& plan, Farm& farm, const Progress& progress)
      : plan_(plan), farm_(farm), progress_(progress)
  {
    options_ = plan.build_options();
    options_.farm = &farm;
    laws_ = plan.bodies.size();
    for (const auto& [name, planned] : plan.bodies) laws_ += planned.body->shape ? 1 : 0;
    for (const LawFilePlan::Pair& pair : plan.pairs)
      laws_ += pair.own_law ? 1 : 0;  // composing takes no time
  }

  MadeLawFile make()
  {
    add_without_runs();
    for (const auto& [name, planned] : plan_.bodies) add_body(name, planned);
    for (const LawFilePlan::Pair& pair : plan_.pairs)
      if (!is_without_runs(pair)) add_pair(pair);
    in_order_of_plan();
    add_provenance();
    return std::move(file_);
  }

 private:
  bool is_from_atlas(const std::string& name) const
  {
    return name == wall_name || plan_.bodies.at(name).from_atlas();
  }
  bool is_without_runs(const LawFilePlan::Pair& pair) const
  {
    return is_from_atlas(pair.a) && is_from_atlas(pair.b) && !pair.own_law;
  }

  /// All that the atlas has.
  void add_without_runs()
  {
    std::vector<LawMaterial> materials;
    for (const auto& [name, planned] : plan_.bodies)
      if (planned.from_atlas()) materials.push_back(planned.body->material);
    std::vector<PlannedPair> pairs;
    for (const LawFilePlan::Pair& pair : plan_.pairs)
      if (is_without_runs(pair)) pairs.push_back(pair);
    if (materials.empty()) return;
    file_.law = law_without_runs(*plan_.request.atlas, materials, pairs, options_);
  }

  void in_order_of_plan()
  {
    std::vector<LawPair> ordered;
    for (const LawFilePlan::Pair& pair : plan_.pairs) ordered.push_back(*file_.law.find_pair(pair.a, pair.b));
    file_.law.pairs = std::move(ordered);
  }

  void add_body(const std::string& name, const LawFilePlan::Body& planned)
  {
    const LawBody& body = *planned.body;
    BodyLaw law = planned.from_atlas() ? std::move(file_.law.bodies.at(name)) : body_by_runs(name, body);
    law.body = body.body;
    if (!law.is_sphere()) {
      law.pole_radius = body.characterised.scale.length;
      law.mass_ratio = body.characterised.mass / (4.0 / 3.0 * M_PI);
    }
    file_.law.provenance["material_hash." + name] = body.hash;
    ++finished_;
    if (body.shape) law.shape = certificate_of(name, body, law);
    file_.law.bodies[name] = std::move(law);
  }

  BodyLaw body_by_runs(const std::string& name, const LawBody& body)
  {
    BuildOptions options = options_named(name);
    if (body.characterised.rate_dependent())
      options.slowest = plan_.request.slowest * std::sqrt(body.material.density / body.material.yield_stress);
    BuiltLaw built = build_law(body.material, body.characterised, options);
    Provenance& provenance = file_.law.provenance;
    note_runs(name, built, provenance);
    note_flow_laws(name, body.characterised.particle.materials, provenance);
    MadeLawFile::Runs& runs = file_.runs[name];
    runs = {built.runs, built.sampling_error, {}};
    if (body.characterised.rate_dependent())
      runs.size = provenance["size." + name] = size_of(body, built.law);
    return std::move(built.law);
  }

  ShapeCertificate certificate_of(const std::string& name, const LawBody& body, const BodyLaw& law)
  {
    ShapeQuestion question = plan_.request.shapes;
    if (question.velocities.empty())
      question.velocities = {usual_velocity(body.material, plan_.request.damage_number)};
    ShapeCertificate certificate =
        certify_shape(*body.shape, law, question, farm_, options_named(name).progress);
    ++finished_;
    return certificate;
  }

  void add_pair(const LawFilePlan::Pair& pair)
  {
    ComposedLaws made;
    if (pair.composed_at.empty() && pair.own_law)
      made.laws = law_by_runs(pair);
    else if (!pair.composed_at.empty())
      made = pair.own_law ? corrected_or_composed(pair) : composed(pair);
    add_pair_laws(file_.law, pair, std::move(made));
  }

  ComposedLaws composed(const LawFilePlan::Pair& pair)
  {
    const UnlikePair bodies = unlike_pair(material(pair.a), material(pair.b));
    return compose_laws(*plan_.request.atlas, pair_body(bodies.yielding), pair_body(bodies.partner),
                        pair.composed_at, options_);
  }

  /// The composed law stays if an impact of the two bodies fails.
  ComposedLaws corrected_or_composed(const LawFilePlan::Pair& pair)
  {
    try {
      return {corrected(pair), {}};
    } catch (const Error& error) {
      file_.law.provenance["not_corrected." + pair.name()] = error.what();
      file_.runs[pair.name()] = {};
      ++finished_;
      return composed(pair);
    }
  }

  std::vector<TwoBodyLaw> corrected(const LawFilePlan::Pair& pair)
  {
    const UnlikePair bodies = unlike_pair(material(pair.a), material(pair.b));
    CorrectedLaws made = corrected_laws(bodies, pair_body(bodies.yielding), pair_body(bodies.partner),
                                        pair.composed_at, options_named(pair.name()));
    note_holes(pair.name(), made.holes, file_.law.provenance);
    file_.runs[pair.name()] = {made.runs, made.sampling_error, {}};
    ++finished_;
    return std::move(made.laws);
  }

  /// Made once for all pairs.
  const PairBody& pair_body(const LawMaterial& m)
  {
    const Atlas& atlas = *plan_.request.atlas;
    if (plan_.bodies.at(m.name).from_atlas()) return pair_bodies_.try_emplace(m.name, atlas, m).first->second;
    const Material& solid = plan_.bodies.at(m.name).body->characterised.particle.materials.front();
    return pair_bodies_.try_emplace(m.name, atlas, m, flow_curve(solid), file_.law.bodies.at(m.name).curve)
        .first->second;
  }

  std::vector<TwoBodyLaw> law_by_runs(const LawFilePlan::Pair& pair)
  {
    const UnlikePair bodies = unlike_pair(material(pair.a), material(pair.b), own_law_radius_ratio);
    BuiltLaw built = build_two_body_law(bodies, options_named(pair.name()));
    note_holes(pair.name(), built.holes, file_.law.provenance);
    file_.runs[pair.name()] = {built.runs, built.sampling_error, {}};
    ++finished_;
    return {{std::move(built.law), own_law_radius_ratio}};
  }

  void add_provenance()
  {
    Provenance& provenance = file_.law.provenance;
    provenance["version"] = version();
    provenance["git_hash"] = git_hash();
    provenance["created"] = now_utc();
    provenance[depth_note] = fmt::format("{:g}", plan_.request.depth);
    provenance["radius_ratio"] = fmt::format("{:g}", plan_.request.radius_ratio);
    if (plan_.needs_runs()) note_count(farm_.count(), provenance);
  }

  /// With the progress of all laws, this one under its name.
  BuildOptions options_named(const std::string& name)
  {
    BuildOptions options = options_;
    if (progress_)
      options.progress = [this, name](double done, const std::string& what) {
        progress_((static_cast<double>(finished_) + done) / static_cast<double>(laws_), name + ": " + what);
      };
    return options;
  }

  const LawMaterial& material(const std::string& name) const { return plan_.bodies.at(name).body->material; }

  const LawFilePlan& plan_;
  Farm& farm_;
  const Progress& progress_;
  BuildOptions options_;
  MadeLawFile file_;
  std::map<std::string, PairBody> pair_bodies_;
  std::size_t laws_ = 0, finished_ = 0;
};

}  // namespace

MadeLawFile make_law_file(const LawFilePlan& plan, Farm* farm, const Progress& progress)
{
  ThreadFarm this_thread(1);
  return Maker(plan, farm ? *farm : this_thread, progress).make();
}

}  // namespace granulaw
