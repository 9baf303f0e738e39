// Makes the synthetic law files that the plug-in's tests read, and replays single collisions outside
// LIGGGHTS.
//
//   law_fixture write FILE                                   the synthetic law, all pairs
//   law_fixture write FILE pairs a:b c:wall ...              only these pairs
//   law_fixture write FILE major N                           claims to be of major version N
//   law_fixture write FILE axis                              the powder has a velocity axis
//   law_fixture write FILE rate RADIUS                       the powder depends on the rate, made for RADIUS
//   law_fixture write FILE certificate ORIGIN N              the powder states errors, of N fresh impacts
//   law_fixture write FILE depth D                           other residuals of the powder
//   law_fixture write FILE pair_law                          powder:glass has a law of its own, all with axis
//   law_fixture write FILE by_size ORIGIN                    laws of this origin by radius ratio:
//                       powder:gum at 1, 3 and, if `composed`, infinity; powder:powder at 3 and infinity
//   law_fixture write FILE composed                          composed laws that radiate at like sizes:
//                       powder:glass where either is a deformable wall and at 1, powder:powder at infinity
//   law_fixture force FILE A B R_EFF DELTA DELTA_MAX X       prints force (N)
//   law_fixture radius FILE A B R_EFF DELTA DELTA_MAX X      prints contact radius (m)
//   law_fixture impact FILE A B R_EFF M_EFF V                prints the impact overlap X of a contact
//   law_fixture mpm FILE A B R_EFF M_EFF V [C]               one collision under the law; C: m/N, of the
//                       bodies behind the contact
//   law_fixture collision FILE A B R_A R_B R_EFF M_EFF V     the same under the law for these radii
//   law_fixture still FILE A B R_A R_B R_EFF M_EFF V         the same without waves
//   law_fixture elastic FILE A E_STAR R_EFF M_EFF V          A against an elastic body of modulus E_STAR
//   law_fixture thornton E_STAR P_Y R_EFF M_EFF V            one collision under Thornton's law
// The last five print "restitution duration(s) delta_max(m)", `collision` and `still` also the largest force
// (N) and the work of waves (J).
#include <hdf5.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <limits>
#include <string>

#include "law/law_file.hpp"
#include "law/replay.hpp"
#include "contact/thornton.hpp"
#include "synthetic_law.hpp"

namespace {

void set_major(const char* path, int major)
{
  const hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t attribute = H5Aopen(file, "version_major", H5P_DEFAULT);
  H5Awrite(attribute, H5T_NATIVE_INT, &major);
  H5Aclose(attribute);
  H5Fclose(file);
}

/// The powder's law with other residuals, that distinguish it from others, for a pair of this size.
granulaw::TwoBodyLaw law_of_size(const granulaw::BodyLaw& powder, double radius_ratio, double depth,
                                 const std::string& origin)
{
  granulaw::tests::SyntheticLaw other;
  other.depth = depth;
  granulaw::TwoBodyLaw own;
  own.law = powder;
  own.law.curve = other.curve_with_axis();
  own.law.certificate.origin = origin;
  own.radius_ratio = radius_ratio;
  return own;
}

granulaw::Law laws_by_size(const std::string& origin)
{
  granulaw::Law law = granulaw::tests::SyntheticLaw{}.law_with_axis();
  const granulaw::BodyLaw& powder = law.bodies.at("powder");
  granulaw::BodyLaw& gum = law.bodies["gum"] = law.bodies.at("glass");  // elastic
  gum.material = powder.material;
  gum.material.name = "gum";
  gum.material.yield_stress = std::numeric_limits<double>::infinity();
  law.pairs.insert(law.pairs.end(), {{"powder", "gum"}, {"gum", "gum"}, {"gum", "wall"}});
  constexpr double thick_wall = std::numeric_limits<double>::infinity();
  const auto add = [&](const char* pair, double ratio, double depth) {
    if (std::isfinite(ratio) || origin == granulaw::composed_origin)
      law.pair_laws[pair].push_back(law_of_size(powder, ratio, depth, origin));
  };
  add("powder:gum", 1, 0.8);
  add("powder:gum", 3, 0.5);
  add("powder:gum", thick_wall, 0.3);
  add("powder:powder", 3, 0.7);
  add("powder:powder", thick_wall, 0.4);
  return law;
}

/// The glass is so heavy that waves return from a sphere of it after the contact: only C knows of it, masses
/// are the deck's.
granulaw::Law composed_laws()
{
  granulaw::Law law = granulaw::tests::SyntheticLaw{}.law_with_axis();
  const granulaw::BodyLaw& powder = law.bodies.at("powder");
  law.bodies.at("glass").material.density *= 60;
  constexpr double thick_wall = std::numeric_limits<double>::infinity();
  for (const double ratio : {0.0, 1.0, thick_wall})
    law.pair_laws["powder:glass"].push_back(law_of_size(powder, ratio, 0.8, granulaw::composed_origin));
  law.pair_laws["powder:powder"].push_back(law_of_size(powder, thick_wall, 0.4, granulaw::composed_origin));
  return law;
}

void print(const granulaw::Replay& replay)
{
  std::printf("%.10g %.10g %.10g\n", replay.restitution, replay.contact_time, replay.delta_max);
}

int run(int argc, char** argv)
{
  const auto word = [&](int k) { return std::string(k < argc ? argv[k] : ""); };
  const auto number = [&](int k) { return std::strtod(word(k).c_str(), nullptr); };
  if (word(1) == "write") {
    granulaw::tests::SyntheticLaw synthetic;
    if (word(3) == "depth") synthetic.depth = number(4);
    granulaw::Law law = word(3) == "axis" ? synthetic.law_with_axis() : synthetic.law();
    if (word(3) == "rate") {
      granulaw::BodyLaw& powder = law.bodies.at("powder");
      powder.curve = granulaw::Curve(synthetic.table(), synthetic.rate_axis(number(4)));
    }
    if (word(3) == "pair_law") {
      law = synthetic.law_with_axis();
      law.pair_laws["powder:glass"].push_back(law_of_size(law.bodies.at("powder"), 2, 0.8, "runs"));
    }
    if (word(3) == "composed") law = composed_laws();
    if (word(3) == "by_size") law = laws_by_size(word(4));
    if (word(3) == "certificate") {
      granulaw::Certificate& c = law.bodies.at("powder").certificate;
      c.origin = word(4);
      c.verification_impacts = number(5);
      c.verification_error_force = 0.012, c.verification_error_restitution = 0.034;
      c.atlas_error_force = 0.056, c.atlas_error_restitution = 0.078;
      law.bodies.at("powder").state();
    }
    if (word(3) == "pairs") {
      law.pairs.clear();
      for (int k = 4; k < argc; ++k) {
        const std::string pair = word(k);
        law.pairs.push_back({pair.substr(0, pair.find(':')), pair.substr(pair.find(':') + 1)});
      }
    }
    granulaw::write_law(law, word(2));
    if (word(3) == "major") set_major(argv[2], std::atoi(argv[4]));
    return 0;
  }
  if (word(1) == "mpm") {
    const granulaw::Law law = granulaw::read_law(word(2));
    const granulaw::PairLaw pair = granulaw::resolve_pair(law, word(3), word(4), word(2));
    print(granulaw::replay_collision(pair, number(5), number(6), number(7), 20000, {.compliance = number(8)}));
    return 0;
  }
  if (word(1) == "collision" || word(1) == "still") {
    const granulaw::Law law = granulaw::read_law(word(2));
    granulaw::PairLaw pair = granulaw::resolve_pair(law, word(3), word(4), word(2), number(5), number(6));
    if (word(1) == "still") pair.radiation = 0;
    const granulaw::Replay replay = granulaw::replay_collision(pair, number(7), number(8), number(9));
    print(replay);
    std::printf("%.10g %.10g\n", replay.force_max, replay.work_waves);
    return 0;
  }
  if (word(1) == "force") {
    const granulaw::Law law = granulaw::read_law(word(2));
    const granulaw::PairLaw pair = granulaw::resolve_pair(law, word(3), word(4), word(2));
    std::printf("%.10g\n", pair.evaluate(number(5), number(6), number(7), number(8)).force);
    return 0;
  }
  if (word(1) == "impact") {
    const granulaw::Law law = granulaw::read_law(word(2));
    const granulaw::PairLaw pair = granulaw::resolve_pair(law, word(3), word(4), word(2));
    std::printf("%.10g\n", pair.impact_overlap(number(5), number(6), number(7)));
    return 0;
  }
  if (word(1) == "radius") {
    const granulaw::Law law = granulaw::read_law(word(2));
    const granulaw::PairLaw pair = granulaw::resolve_pair(law, word(3), word(4), word(2));
    std::printf("%.10g\n", pair.evaluate(number(5), number(6), number(7), number(8)).contact_radius);
    return 0;
  }
  if (word(1) == "elastic") {
    const granulaw::Law law = granulaw::read_law(word(2));
    const granulaw::BodyLaw& body = law.bodies.at(word(3));
    const granulaw::PairLaw pair{
        {&body.curve, granulaw::PairMapping::deformable_partner(body.material.e_star(), number(4))}, &body};
    print(granulaw::replay_collision(pair, number(5), number(6), number(7)));
    return 0;
  }
  if (word(1) == "thornton") {
    const granulaw::Thornton pair(number(2), number(3));
    const double r_eff = number(4), m_eff = number(5), v = number(6);
    const double duration = 2.87 * std::pow(m_eff * m_eff / (pair.e_star * pair.e_star * r_eff * v), 0.2);
    print(granulaw::replay_collision([&](double d, double d_max) { return pair.evaluate(r_eff, d, d_max); },
                                     m_eff, v, duration));
    return 0;
  }
  std::fprintf(stderr, "law_fixture: see the head of law_fixture.cpp\n");
  return 2;
}

}  // namespace

int main(int argc, char** argv)
{
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "law_fixture: %s\n", error.what());
    return 1;
  }
}
