#include <gmock/gmock.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "granulaw.h"
#include "law/law_file.hpp"
#include "law/stated_collision.hpp"
#include "scratch_folder.hpp"
#include "synthetic_law.hpp"

// Forces against LIGGGHTS and whole collisions against `mpm law`: tests/liggghts/test_c_interface.py.
namespace granulaw::c_interface_test {

using ::testing::HasSubstr;

constexpr double wall = std::numeric_limits<double>::infinity();

/// powder and glass, with laws by size for them; each contact law is closed at the end.
class CInterface : public ScratchFolder
{
 protected:
  CInterface()
  {
    law_.pair_laws["powder:glass"] = {sized(1, 0.8), sized(3, 0.5)};
    law_.bodies.at("powder").bound = {.force = 0.01, .restitution = 0.003};
  }
  void SetUp() override
  {
    ScratchFolder::SetUp();
    write_law(law_, path("law.h5"));
    ASSERT_EQ(granulaw_open(path("law.h5").c_str(), &file_, &why_), GRANULAW_OK) << why_.text;
    granulaw_usual_pair(&pair_, sizeof pair_);
    pair_.a = "powder", pair_.b = "wall";
  }
  void TearDown() override
  {
    for (granulaw_contact_law* contact : contacts_) granulaw_close_contact(contact);
    granulaw_close(file_);
    ScratchFolder::TearDown();
  }

  TwoBodyLaw sized(double ratio, double depth) const
  {
    tests::SyntheticLaw other;
    other.depth = depth;
    TwoBodyLaw own;
    own.law = law_.bodies.at("powder");
    own.law.curve = other.curve_with_axis();
    own.law.certificate.origin = "runs";
    own.radius_ratio = ratio;
    return own;
  }
  granulaw_contact_law* contact()
  {
    granulaw_contact_law* made = nullptr;
    EXPECT_EQ(granulaw_contact(file_, &pair_, &made, &why_), GRANULAW_OK) << why_.text;
    contacts_.push_back(made);
    return made;
  }
  std::string refused(int code)
  {
    granulaw_contact_law* made = nullptr;
    EXPECT_EQ(granulaw_contact(file_, &pair_, &made, &why_), code);
    EXPECT_EQ(made, nullptr);
    return why_.text;
  }

  static granulaw_motion motion(double overlap, double radius_b = wall)
  {
    granulaw_motion m{};
    m.size = sizeof m;
    m.radius_a = 1e-3, m.radius_b = radius_b, m.m_eff = 6e-6;
    m.overlap = overlap, m.approach = 1, m.dt = 1e-7;
    m.normal[2] = 1, m.slide[0] = 0.1;
    return m;
  }
  /// The answer to the last of steps that begin a contact.
  static granulaw_answer answer(const granulaw_contact_law* contact, const std::vector<granulaw_motion>& steps,
                                std::vector<double>* history = nullptr, double* ledger = nullptr)
  {
    std::vector<double> own(granulaw_history(contact));
    granulaw_answer now{};
    now.size = sizeof now;
    for (const granulaw_motion& m : steps)
      EXPECT_EQ(granulaw_advance(contact, 1, &m, own.data(), &now, ledger, nullptr), GRANULAW_OK);
    if (history) *history = own;
    return now;
  }

  Law law_ = tests::SyntheticLaw{}.law_with_axis();
  granulaw_law* file_ = nullptr;
  granulaw_pair pair_{};
  granulaw_why why_{};
  std::vector<granulaw_contact_law*> contacts_;
};

TEST_F(CInterface, ListsWhatTheFileHas)
{
  ASSERT_EQ(granulaw_materials(file_), 2u);
  granulaw_material material{};
  material.size = sizeof material;
  ASSERT_EQ(granulaw_material_of(file_, 1, &material), GRANULAW_OK);
  EXPECT_STREQ(material.name, "powder");
  EXPECT_EQ(material.yield_stress, 1e8);
  EXPECT_EQ(granulaw_material_of(file_, 2, &material), GRANULAW_NO_NUMBER);
  ASSERT_EQ(granulaw_pairs(file_), 5u);
  const char *a = nullptr, *b = nullptr;
  ASSERT_EQ(granulaw_pair_of(file_, 3, &a, &b), GRANULAW_OK);
  EXPECT_STREQ(a, "powder");
  EXPECT_STREQ(b, "wall");
  EXPECT_EQ(granulaw_abi(), unsigned{GRANULAW_ABI});
}

TEST_F(CInterface, BytesOfAFileAreTheFile)
{
  const std::string bytes = read(path("law.h5"));
  granulaw_law* image = nullptr;
  ASSERT_EQ(granulaw_open_image(bytes.data(), bytes.size(), "an image", &image, &why_), GRANULAW_OK) << why_.text;
  EXPECT_EQ(granulaw_pairs(image), 5u);
  granulaw_close(image);
  EXPECT_EQ(granulaw_open_image(bytes.data(), bytes.size() / 2, "an image", &image, &why_), GRANULAW_NO_FILE);
  EXPECT_THAT(why_.text, HasSubstr("an image"));
}

/// That of the contact made for the size alone, to the bit.
TEST_F(CInterface, OneContactLawServesAllSizes)
{
  pair_.b = "glass", pair_.friction = 0.3;
  const granulaw_contact_law* all = contact();
  double before = 0;
  for (const double radius : {0.9e-3, 1.2e-3, 2.9e-3, 5e-3}) {
    pair_.radius_a = 1e-3, pair_.radius_b = radius;
    const granulaw_contact_law* one = contact();
    const std::vector steps = {motion(1e-5, radius), motion(2e-5, radius), motion(1.5e-5, radius)};
    EXPECT_EQ(answer(all, steps).normal, answer(one, steps).normal);
    EXPECT_EQ(answer(all, steps).shear[0], answer(one, steps).shear[0]);
    EXPECT_NE(answer(all, steps).normal, before);
    before = answer(all, steps).normal;
  }
}

/// Of the same contact in micrometres, picograms and microseconds: forces in 1e-9 N, energies in 1e-15 J.
TEST_F(CInterface, AnswersInTheCallersUnits)
{
  for (const bool yields : {false, true}) {
    pair_.friction = 0.3, pair_.yields_in_shear = yields;
    pair_.length = pair_.mass = pair_.time = 0;
    const granulaw_contact_law* si = contact();
    pair_.length = 1e-6, pair_.mass = 1e-15, pair_.time = 1e-6;
    const granulaw_contact_law* micro = contact();
    std::vector<granulaw_motion> steps, scaled;
    for (const double overlap : {1e-5, 3e-5, 2.5e-5}) {
      granulaw_motion m = motion(overlap);
      steps.push_back(m);
      m.radius_a *= 1e6, m.m_eff *= 1e15, m.overlap *= 1e6, m.dt *= 1e6;  // speeds are the same
      scaled.push_back(m);
    }
    double taken[GRANULAW_MECHANISMS] = {}, scaled_taken[GRANULAW_MECHANISMS] = {};
    const granulaw_answer now = answer(si, steps, nullptr, taken), same = answer(micro, scaled, nullptr, scaled_taken);
    EXPECT_NEAR(same.normal * 1e-9 / now.normal, 1, 1e-12);  // rounding
    EXPECT_NEAR(same.shear[0] * 1e-9 / now.shear[0], 1, 1e-12);
    EXPECT_NEAR(scaled_taken[GRANULAW_PLASTIC] * 1e-15 / taken[GRANULAW_PLASTIC], 1, 1e-12);
    granulaw_range range{}, scaled_range{};
    range.size = scaled_range.size = sizeof range;
    ASSERT_EQ(granulaw_range_of(si, 1e-3, wall, 6e-6, &range), GRANULAW_OK);
    ASSERT_EQ(granulaw_range_of(micro, 1e3, wall, 6e9, &scaled_range), GRANULAW_OK);
    EXPECT_NEAR(scaled_range.fastest / range.fastest, 1, 1e-12);
  }
}

TEST_F(CInterface, StateIsTheSlopeAndTheWorkOfTheForce)
{
  pair_.elastic_damping = 0;
  const granulaw_contact_law* c = contact();
  std::vector<double> history;
  answer(c, {motion(1e-5), motion(3e-5)}, &history);
  double given_back = 0, ends_at = 0;
  granulaw_state state{}, before{};
  state.size = before.size = sizeof state;
  const granulaw_motion top = motion(3e-5);
  ASSERT_EQ(granulaw_state_of(c, 1, &top, history.data(), &before), GRANULAW_OK);
  EXPECT_EQ(before.branch, GRANULAW_LOADING);
  const double step = 1e-9;
  for (double overlap = 3e-5 - 0.5 * step; overlap > 0; overlap -= step) {
    granulaw_motion m = motion(overlap);
    m.asked_again = 1;
    granulaw_answer now{};
    now.size = sizeof now;
    ASSERT_EQ(granulaw_advance(c, 1, &m, history.data(), &now, nullptr, nullptr), GRANULAW_OK);
    given_back += now.normal * step;
    if (now.normal == 0 && ends_at == 0) ends_at = overlap;
  }
  EXPECT_NEAR(given_back / before.stored_energy, 1, 1e-4);  // the sum's steps
  ASSERT_GT(ends_at, 0);
  granulaw_motion m = motion(0.5 * (3e-5 + ends_at));
  granulaw_answer low{}, high{};
  low.size = high.size = sizeof low;
  ASSERT_EQ(granulaw_state_of(c, 1, &m, history.data(), &state), GRANULAW_OK);
  EXPECT_EQ(state.branch, GRANULAW_UNLOADING);
  EXPECT_EQ(state.largest_overlap, 3e-5);
  EXPECT_GT(state.contact_radius, 0);
  const double off = 1e-10;
  m.asked_again = 1, m.overlap -= off;
  granulaw_advance(c, 1, &m, history.data(), &low, nullptr, nullptr);
  m.overlap += 2 * off;
  granulaw_advance(c, 1, &m, history.data(), &high, nullptr, nullptr);
  EXPECT_NEAR((high.normal - low.normal) / (2 * off) / state.stiffness, 1, 1e-6);  // the difference's own error
  m = motion(0.9 * ends_at);
  ASSERT_EQ(granulaw_state_of(c, 1, &m, history.data(), &state), GRANULAW_OK);
  EXPECT_EQ(state.branch, GRANULAW_APART);
}

TEST_F(CInterface, SaysWhatIsBeyondTheLaw)
{
  const granulaw_contact_law* c = contact();
  granulaw_range range{};
  range.size = sizeof range;
  ASSERT_EQ(granulaw_range_of(c, 1e-3, wall, 6e-6, &range), GRANULAW_OK);
  EXPECT_EQ(answer(c, {motion(0.5 * range.overlap * 1e-3)}).beyond, 0u);
  EXPECT_EQ(answer(c, {motion(1.1 * range.overlap * 1e-3)}).beyond, unsigned{GRANULAW_BEYOND_OVERLAP});
  granulaw_motion fast = motion(1e-6);
  fast.approach = 1.01 * range.fastest;
  EXPECT_EQ(answer(c, {fast}).beyond, unsigned{GRANULAW_BEYOND_FAST});
  EXPECT_EQ(answer(c, {motion(1e-6), fast}).beyond, 0u);  // it began slower
}

TEST_F(CInterface, ARateLawHoldsForOneSize)
{
  law_.bodies.at("powder").curve = Curve(tests::SyntheticLaw{}.table(), tests::SyntheticLaw{}.rate_axis(1e-3, 8, 25));
  write_law(law_, path("rate.h5"));
  granulaw_close(file_);
  ASSERT_EQ(granulaw_open(path("rate.h5").c_str(), &file_, &why_), GRANULAW_OK) << why_.text;
  const granulaw_contact_law* c = contact();
  granulaw_range range{};
  range.size = sizeof range;
  ASSERT_EQ(granulaw_range_of(c, 1e-3, wall, 6e-6, &range), GRANULAW_OK);
  ASSERT_GT(range.slowest, 0);
  granulaw_motion m = motion(1e-6);
  m.approach = 2 * range.slowest;
  EXPECT_EQ(answer(c, {m}).beyond, 0u);
  m.approach = 0.5 * range.slowest;
  EXPECT_EQ(answer(c, {m}).beyond, unsigned{GRANULAW_BEYOND_SLOW});
  m.approach = 2 * range.slowest, m.radius_a = 1.1e-3;
  EXPECT_EQ(answer(c, {m}).beyond, unsigned{GRANULAW_BEYOND_SIZE});
}

/// That of `mpm law`; none beyond the damage number that the file states.
TEST_F(CInterface, TheBoundIsThatOfTheFile)
{
  const granulaw_contact_law* c = contact();
  granulaw_bound bound{};
  bound.size = sizeof bound;
  const ChosenPair chosen = choose_pair(law_, {"law.h5", "powder:wall", 1e-3, {}});
  ASSERT_EQ(granulaw_bound_of(c, 1e-3, wall, chosen.m_eff, 2, &bound), GRANULAW_OK);
  const ErrorBound expected = collide(law_, chosen, 2, "law.h5").bound();
  ASSERT_TRUE(expected.stated());
  EXPECT_EQ(bound.force, expected.force);
  EXPECT_EQ(bound.restitution, expected.restitution);
  ASSERT_EQ(granulaw_bound_of(c, 1e-3, wall, chosen.m_eff, 200, &bound), GRANULAW_OK);
  EXPECT_TRUE(std::isinf(bound.force));
}

/// What is derived may be lost: the answers stay.
TEST_F(CInterface, DerivedValuesFollowFromTheOthers)
{
  for (const bool yields : {false, true}) {
    pair_.friction = 0.3, pair_.yields_in_shear = yields;
    const granulaw_contact_law* c = contact();
    std::vector<double> history, kept;
    answer(c, {motion(1e-5), motion(3e-5), motion(2.9e-5)}, &history);
    kept = history;
    int derived = 0;
    for (std::size_t k = 0; k < kept.size(); ++k)
      if (granulaw_is_derived(c, k)) kept[k] = 0, ++derived;
    EXPECT_EQ(derived, 5);
    granulaw_motion m = motion(2.8e-5);
    granulaw_answer now{}, again{};
    now.size = again.size = sizeof now;
    granulaw_advance(c, 1, &m, history.data(), &now, nullptr, nullptr);
    granulaw_advance(c, 1, &m, kept.data(), &again, nullptr, nullptr);
    EXPECT_EQ(now.normal, again.normal);
    EXPECT_EQ(now.shear[0], again.shear[0]);
  }
}

TEST_F(CInterface, AnErrorInABatchHasItsPlace)
{
  const granulaw_contact_law* c = contact();
  std::vector motions(3, motion(1e-5));
  motions[1].approach = std::nan("");
  std::vector<granulaw_answer> answers(3, {sizeof(granulaw_answer), 0, {}, {}, 0});
  std::vector<double> history(3 * granulaw_history(c));
  std::size_t done = 9;
  EXPECT_EQ(granulaw_advance(c, 3, motions.data(), history.data(), answers.data(), nullptr, &done), GRANULAW_NO_NUMBER);
  EXPECT_EQ(done, 1u);
  EXPECT_GT(answers[0].normal, 0);
  EXPECT_EQ(answers[2].normal, 0);
  motions[1] = {};  // a contact that ended needs no numbers
  EXPECT_EQ(granulaw_advance(c, 3, motions.data(), history.data(), answers.data(), nullptr, &done), GRANULAW_OK);
  EXPECT_EQ(done, 3u);
}

/// A program of a later version has longer structs: it runs while what this library does not know is 0.
TEST_F(CInterface, OtherVersionsRunOrAreTold)
{
  struct Longer
  {
    granulaw_motion now;
    double later;
  };
  const granulaw_contact_law* c = contact();
  std::vector<Longer> longer(2, {motion(1e-5), 0});
  for (Longer& one : longer) one.now.size = sizeof(Longer);
  std::vector<double> history(2 * granulaw_history(c));
  std::vector<granulaw_answer> answers(2, {sizeof(granulaw_answer), 0, {}, {}, 0});
  EXPECT_EQ(granulaw_advance(c, 2, &longer[0].now, history.data(), answers.data(), nullptr, nullptr), GRANULAW_OK);
  EXPECT_EQ(answers[0].normal, answers[1].normal);
  EXPECT_GT(answers[1].normal, 0);
  longer[0].later = 1;
  EXPECT_EQ(granulaw_advance(c, 2, &longer[0].now, history.data(), answers.data(), nullptr, nullptr), GRANULAW_NO_SIZE);
  longer[0].now.size = 0;
  EXPECT_EQ(granulaw_advance(c, 2, &longer[0].now, history.data(), answers.data(), nullptr, nullptr), GRANULAW_NO_SIZE);
  pair_.size = 8;
  EXPECT_EQ(refused(GRANULAW_NO_SIZE), "granulaw_pair: its member `size` is not set to sizeof(granulaw_pair)");
}

/// A program that was compiled with the first header of version 1, before adhesion: nothing behind its structs is read or written.
TEST_F(CInterface, AProgramOfTheFirstHeaderRuns)
{
  constexpr std::size_t pair_size = offsetof(granulaw_pair, work_of_adhesion), range_size = offsetof(granulaw_range, reach);
  granulaw_pair older{};
  older.work_of_adhesion = -1;  // what lies there is not the program's: it would be refused
  granulaw_usual_pair(&older, pair_size);
  EXPECT_EQ(older.size, pair_size);
  EXPECT_EQ(older.work_of_adhesion, -1);
  older.a = "powder", older.b = "wall";
  const std::vector steps{motion(1e-5), motion(3e-5)};
  const granulaw_answer expected = answer(contact(), steps);
  pair_ = older;
  granulaw_range range{};
  range.size = range_size, range.reach = -1;
  double ledger[5] = {0, 0, 0, 0, -1};  // four mechanisms then
  EXPECT_EQ(answer(contact(), steps, nullptr, ledger).normal, expected.normal);
  EXPECT_GT(ledger[GRANULAW_PLASTIC], 0);
  EXPECT_EQ(ledger[4], -1);
  ASSERT_EQ(granulaw_range_of(contact(), 1e-3, wall, 6e-6, &range), GRANULAW_OK);
  EXPECT_GT(range.fastest, 0);
  EXPECT_EQ(range.reach, -1);
  pair_.size = pair_size - 8;
  EXPECT_EQ(refused(GRANULAW_NO_SIZE), "granulaw_pair: its member `size` is not set to sizeof(granulaw_pair)");
}

TEST_F(CInterface, RefusesInASentence)
{
  pair_.friction = -1;
  EXPECT_THAT(refused(GRANULAW_NO_NUMBER), HasSubstr("0 or more"));
  pair_.friction = 0, pair_.radius_a = 1e-3;
  EXPECT_THAT(refused(GRANULAW_NO_NUMBER), HasSubstr("both over 0"));
  pair_.radius_a = 0, pair_.b = "clay";
  EXPECT_THAT(refused(GRANULAW_NO_LAW), HasSubstr("clay"));
  pair_.a = "wall", pair_.b = "powder";
  EXPECT_EQ(refused(GRANULAW_NO_LAW), "granulaw_contact: the wall is b");
  pair_.a = nullptr;
  EXPECT_THAT(refused(GRANULAW_NO_POINTER), HasSubstr("null"));
}

TEST(CInterfaceOfNothing, NullPointersAreAnsweredWithoutNumbers)
{
  EXPECT_EQ(granulaw_history(nullptr), 0u);
  EXPECT_EQ(granulaw_changes_sign(nullptr, 0), 0);
  EXPECT_EQ(granulaw_is_derived(nullptr, 0), 0);
  EXPECT_EQ(granulaw_materials(nullptr), 0u);
  EXPECT_EQ(granulaw_range_of(nullptr, 1, 1, 1, nullptr), GRANULAW_NO_POINTER);
  EXPECT_EQ(granulaw_bound_of(nullptr, 1, 1, 1, 1, nullptr), GRANULAW_NO_POINTER);
  granulaw_close(nullptr);
  granulaw_close_contact(nullptr);
}

}  // namespace granulaw::c_interface_test
