#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "calibrate/calibrate.hpp"
#include "calibrate/design.hpp"
#include "calibrate/kind/composed.hpp"
#include "calibrate/kind/kind.hpp"
#include "calibrate/measurement_file.hpp"
#include "calibrate/noise.hpp"
#include "own_atlas.hpp"

namespace granulaw::kinds_test {

using tests::atlas;
using testing::HasSubstr;

/// So strong that all of Brinell's balls leave dents that they may leave.
LawMaterial stone()
{
  return {"stone", 12000, 60e9, 0.25, 360e6, 0};
}

std::string text_of(const std::string& path)
{
  std::stringstream text;
  text << std::ifstream(std::string(GRANULAW_SOURCE_DIR) + "/" + path).rdbuf();
  return text.str();
}

Measurement form_of(const Kind& kind)
{
  Measurement m;
  m.kind = &kind;
  m.source = kind.name;
  m.radius = 1e-3;
  m.fit_offset = kind.has_machine;
  if (kind.counterpart == Kind::Counterpart::indenter) m.indenter_radius = 1e-3;
  return m;
}

/// The kind's measurement of the stone, with values by its own model.
Measurement measured(const Kind& kind)
{
  Measurement m = form_of(kind);
  if (kind.planned)
    m.data = kind.planned(kind.contacts * 0.05 * m.effective_radius());
  else
    for (const double speed : {0.3, 0.4, 0.6, 0.8, 1.0, 1.2, 1.5, 1.8, 2.1, 2.4}) m.data.push_back({kind.x.exists() ? speed : 0, 1, 0, 1});
  std::optional<ComposedModel> composed;
  if (m.is_composed()) composed.emplace(atlas(), m, std::vector{Parameter::yield_stress});
  const SphereLaws laws(atlas(), stone());
  const Prediction p = kind.predict(m, {stone(), laws, {}, composed ? &*composed : nullptr});
  EXPECT_EQ(p.values.size(), m.data.size());
  EXPECT_EQ(p.scatter.size(), m.data.size());
  EXPECT_EQ(p.errors.size(), kind.smooth_errors);
  for (std::size_t k = 0; k < m.data.size(); ++k) m.data[k].y = p.values[k], m.data[k].sd = 0;
  complete_standard_deviations(m, 0.01);
  return m;
}

/// Of the stone's yield stress.
CalibrationRequest request(std::vector<Measurement> measurements)
{
  CalibrationRequest r;
  r.known = stone();
  r.known.yield_stress = 0;
  r.fit = {Parameter::yield_stress};
  r.measurements = std::move(measurements);
  return r;
}

std::string misfits(const CalibrationRequest& r)
{
  std::string all;
  for (const Misfit& m : calibrate(CalibrationProblem(atlas(), r)).misfits) all += m.name + ";";
  return all;
}

class OfEachKind : public testing::TestWithParam<const Kind*>
{
};

TEST_P(OfEachKind, ItsFileIsRead)
{
  const Kind& kind = *GetParam();
  std::string text = kind.header() + "\n";
  for (const Datum& d : measured(kind).data)
    text += (kind.x.exists() ? std::to_string(1e6 * d.x) + "e-6," : "") + std::to_string(1e6 * d.y) + "e-6\n";
  const Measurement read = parse_measurement(text, "data.csv", kind.word ? kind : kind_named("flat", "test"));
  EXPECT_EQ(read.kind, &kind);
}

TEST_P(OfEachKind, ItsModelGivesBackTheYieldStress)
{
  CalibrationRequest r = request({measured(*GetParam())});
  const Calibration c = calibrate(CalibrationProblem(atlas(), r));
  // the same model made the data; a contact time hardly depends on Y
  EXPECT_NEAR(c.material.yield_stress / stone().yield_stress, 1, 0.02);
  EXPECT_THAT(c.misfits, testing::IsEmpty());
}

TEST_P(OfEachKind, ItsOutliersAreNamed)
{
  CalibrationRequest r = request({measured(*GetParam())});
  Datum& off = r.measurements[0].data[2];
  off.y *= GetParam()->y.most == 1 ? 0.5 : 3;
  EXPECT_THAT(misfits(r), HasSubstr("outliers"));
}

TEST_P(OfEachKind, ADesignExpectsAnIntervalOfIt)
{
  const CalibrationRequest r = request({});
  const Kind& kind = *GetParam();
  const double place = kind.planned ? kind.contacts * 5e-5 : kind.x.exists() ? 2 : 0;
  const Design design(atlas(), r, stone(), {{form_of(kind), place}, {form_of(kind), place}}, 0.01);
  EXPECT_GT(design.expected({0})[0], 0);
  EXPECT_LT(design.expected({0})[0], 0.5 * design.expected({})[0]);
}

TEST_P(OfEachKind, TheGuideHasItsRow)
{
  const Kind& kind = *GetParam();
  const std::string guide = text_of("docs/guide/calibrate.md");
  const std::string header = "| `" + kind.header() + "` |", word = kind.word ? kind.word : "";
  EXPECT_TRUE(guide.find(header) != std::string::npos) << header;
  EXPECT_TRUE(word.empty() || word == "platens" ||
              guide.find("| the same with `--kind " + word + "` |") != std::string::npos)
      << word;
  EXPECT_STRNE(kind.help, "");
  EXPECT_EQ(&kind_named(kind.name, "test"), &kind);
}

INSTANTIATE_TEST_SUITE_P(Kinds, OfEachKind, testing::ValuesIn(kinds().begin(), kinds().end()),
                         [](const auto& kind) {
                           std::string name = kind.param->name;
                           for (char& c : name)
                             if (c == ' ') c = '_';
                           return name;
                         });

/// A slow hardness counts against impacts: it is far below what the impacts show.
TEST(Kinds, AHardnessIsHeldAgainstImpacts)
{
  CalibrationRequest r = request({measured(kind_named("restitution", "test")), measured(kind_named("hardness", "test"))});
  for (Datum& d : r.measurements[1].data) d.y *= 0.5, d.sd *= 0.5;
  EXPECT_THAT(misfits(r), HasSubstr("rate;"));
}

/// Contradictory data lead the search along directions that nothing determines; it steps to no number.
TEST(Kinds, ContradictoryDataAreFitted)
{
  const auto data = [](const char* kind, std::vector<std::pair<double, double>> rows, double sd) {
    Measurement m = form_of(kind_named(kind, "test"));
    for (const auto& [x, y] : rows) m.data.push_back({x, y, sd * y, 1});
    return m;
  };
  CalibrationRequest r;
  r.known = LawMaterial{"grain", 1540, 0, 0.25, 0, 0};
  r.fit = {Parameter::youngs_modulus, Parameter::yield_stress, Parameter::hardening_modulus};
  r.measurements = {
      data("contact radius", {{0.2, 5.2e-5}, {0.8, 1.05e-4}, {3.2, 2.15e-4}}, 0.01),
      data("residual displacement", {{0.5, 1.2e-6}, {1, 3.1e-6}, {2, 8.1e-6}, {4, 2e-5}}, 0.01),
      data("contact time", {{0.5, 9e-6}, {1, 8e-6}, {2, 7.3e-6}, {4, 6.8e-6}}, 0.0125),
      data("restitution", {{0.1, 0.9999}, {0.2, 0.9751}, {0.4, 0.93}, {0.8, 0.87}, {1.6, 0.79}, {6, 0.64}},
           0.01)};
  const CalibrationProblem problem(atlas(), r);
  EXPECT_GT(calibrate(problem).chi_squared, 100);
}

}  // namespace granulaw::kinds_test
