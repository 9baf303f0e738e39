#include "law/law_file.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

#include "law/error_bound.hpp"
#include "law/layout.hpp"
#include "law/oblique.hpp"
#include "scratch_folder.hpp"
#include "synthetic_law.hpp"
#include "without_checksum.hpp"

namespace granulaw::law_file_test {

// HDF5 1.10 complains at exit ("infinite loop closing library") after it was fed damaged files; nothing is open then.
[[maybe_unused]] const herr_t no_exit_handler = H5dont_atexit();

namespace fs = std::filesystem;
using tests::SyntheticLaw;
using Change = std::function<void(hid_t)>;

void overwrite(hid_t file, const std::string& dataset, const std::function<void(std::vector<double>&)>& change)
{
  const hid_t set = H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), space = H5Dget_space(set);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  change(values);
  H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Sclose(space);
  H5Dclose(set);
}
/// Sets all values of a dataset, or its first.
Change set(const std::string& dataset, double value, bool all = true)
{
  return [=](hid_t f) { overwrite(f, dataset, [=](auto& v) { std::fill(v.begin(), all ? v.end() : v.begin() + 1, value); }); };
}
Change without(const std::string& dataset)
{
  return [=](hid_t f) { ASSERT_GE(H5Ldelete(f, dataset.c_str(), H5P_DEFAULT), 0) << dataset; };
}
Change without_attribute(const std::string& object, const std::string& name)
{
  return [=](hid_t f) { ASSERT_GE(H5Adelete_by_name(f, object.c_str(), name.c_str(), H5P_DEFAULT), 0) << name; };
}
/// Replaces a dataset by an empty one of another type or extent.
Change replaced(const std::string& dataset, hid_t type, hsize_t extent, bool chunked = false)
{
  return [=](hid_t file) {
    H5Ldelete(file, dataset.c_str(), H5P_DEFAULT);
    const hid_t space = H5Screate_simple(1, &extent, nullptr), list = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t chunk = 1024;
    if (chunked) H5Pset_chunk(list, 1, &chunk);
    H5Dclose(H5Dcreate2(file, dataset.c_str(), type, space, H5P_DEFAULT, list, H5P_DEFAULT));
    H5Pclose(list);
    H5Sclose(space);
  };
}

class LawFile : public ScratchFolder
{
 protected:
  /// Writes a good law, changes the file through the raw API, returns the reader's sentence ("" if it accepts).
  std::string after(const Change& change, const Law& law = SyntheticLaw{}.law())
  {
    write_law(law, path_);
    const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    change(file);
    H5Fclose(file);
    return sentence_of([&] { read_law(path_); });
  }
  struct Damage
  {
    Change change;
    std::string part;  ///< of the sentence
  };
  void refused(const Law& law, const std::vector<Damage>& damages)
  {
    for (std::size_t k = 0; k < damages.size(); ++k) {
      const std::string said = after(damages[k].change, law);
      EXPECT_TRUE(!said.empty() && said.find(damages[k].part) != std::string::npos) << k << ": '" << damages[k].part << "' not in: " << said;
    }
  }
  /// Laws that are not written.
  void not_written(const Law& law, const std::vector<std::pair<std::function<void(Law&)>, std::string>>& changes)
  {
    for (const auto& [change, part] : changes) {
      Law bad = law;
      change(bad);
      expect_error(part, [&] { write_law(bad, path_); });
    }
  }
  std::string bytes() const { return read(path_); }

  const std::string path_ = path("law.h5");
};

/// Every number and word of a law, bit for bit, by the tables of the layout.
class Contents
{
 public:
  explicit Contents(const Law& law)
  {
    for (const auto& [name, body] : law.bodies) add(body);
    for (const LawPair& pair : law.pairs) word(pair.a), word(pair.b);
    for (const auto& [pair, laws] : law.pair_laws)
      for (const TwoBodyLaw& own : laws) word(pair), add(own.radius_ratio), add(own.law);
    for (const auto& [key, note] : law.provenance)
      if (key != checksum_note) word(key), word(note);
  }
  std::string text;

 private:
  void add(double value) { text += std::to_string(std::bit_cast<std::uint64_t>(value)) + " "; }
  void word(const std::string& w) { text += w + " "; }
  void add(const std::vector<double>& values)
  {
    for (const double value : values) add(value);
    text += "\n";
  }
  void add(const BodyLaw& b)
  {
    const LawMaterial& m = b.material;
    word(m.name), word(b.body), word(b.certificate.origin);
    add({m.density, m.youngs_modulus, m.poisson_ratio, m.yield_stress, m.hardening_modulus, b.pole_radius, b.mass_ratio});
    add(m.flow.strain), add(m.flow.stress);
    const CurveTable& table = b.curve.table();
    add({table.onset, table.end, table.octaves * 1.0});
    for (const auto& f : h5::curve_columns) add((table.*f.column).value), add((table.*f.column).slope);
    for (const auto& row : table.unloading_radius) add({row[0], row[1], row[2]});
    for (const auto& f : h5::certificate_fields) add(b.certificate.*f.value);
    for (const auto& f : h5::bound_fields) add(b.bound.*f.value);
    for (const AxisCost& cost : b.bound.omitted_axis)
      for (const auto& f : h5::axis_cost_fields) add(cost.*f.value);
    if (const AxisTable* axis = b.curve.axis()) {
      add(static_cast<double>(axis->by));
      for (const auto& n : h5::axis_numbers) add(axis->*n.value);
      for (const auto& f : h5::axis_columns) add((axis->*f.column).value), add((axis->*f.column).slope);
      for (const auto& f : h5::axis_lists) add(axis->*f.values);
    }
    if (!b.shape) return;
    word(b.shape->shape), add({b.shape->volume, b.shape->solver_error});
    for (const bool mirror : b.shape->mirrors) add(mirror * 1.0);
    for (const OrientationCheck& c : b.shape->checks) {
      add({c.direction[0], c.direction[1], c.direction[2], c.velocity, c.sharper_radius, c.flatter_radius, c.effective_mass, c.height,
           static_cast<double>(c.local)});
      for (const auto& answer : {c.solver, c.law, c.law_with_body}) add(answer.force_max), add(answer.restitution);
    }
  }
};

std::string contents(const Law& law)
{
  return Contents(law).text;
}

/// Two orientations, one of which no sphere represents.
Law law_with_orientations()
{
  Law law = SyntheticLaw{}.law();
  ShapeCertificate shape;
  shape.shape = "box 1 1 1 0.1", shape.mirrors = {true, false, true};
  shape.volume = 1.0 / 3, shape.solver_error = 0.01;
  using Local = OrientationCheck::Local;
  shape.checks = {{{0, 0.6, -0.8}, 0.7, 1e-3, 2e-3, 0.9, 1.8e-3, Local::curved, {2.5, 0.5}, {2.6, 0.45}, {2.525, 0.48}},
                  {{1, 0, 0}, 0.7, 1e-4, INFINITY, 1, 1e-3, Local::flat, {3.5, 0.6}, {}, {}}};
  law.bodies["powder"].shape = shape;
  return law;
}

/// A law of everything that a file may hold, each number another one.
Law everything()
{
  Law law = SyntheticLaw{}.whole_law();
  law.bodies["powder"].shape = law_with_orientations().bodies["powder"].shape;
  BodyLaw grain = law.bodies["powder"];
  grain.shape.reset();
  grain.material.name = "grain", grain.material.hardening_modulus = 0, grain.material.flow = {{0, 0.1, 1}, {1e8, 1.3e8, 1.7e8}};
  grain.curve = Curve(SyntheticLaw{}.table(), SyntheticLaw{}.rate_axis(2.5e-3));
  grain.body = "core-shell", grain.pole_radius = 2.5e-3, grain.mass_ratio = 0.87;
  double value = 0.001;
  for (const auto& f : h5::certificate_fields) grain.certificate.*f.value = value += 1e-4;
  for (const auto& f : h5::bound_fields) grain.bound.*f.value = value += 1e-4;  // not what the certificate gives
  grain.bound.size_restitution = std::numeric_limits<double>::infinity();
  grain.certificate.origin = "atlas", grain.bound.omitted_axis = {{0.01, -0.001, 0.002}, {0.02, 0.003, 0.01}};
  law.bodies["grain"] = grain;
  law.pairs.push_back({"grain", "grain"}), law.pairs.push_back({"grain", "wall"});
  return law;
}

TEST_F(LawFile, EverythingComesBackBitExact)
{
  for (const Law& law : {SyntheticLaw{}.law(), everything()}) {
    write_law(law, path_);
    EXPECT_EQ(contents(read_law(path_)), contents(law));
    EXPECT_EQ(contents(read_law_image(bytes(), path_)), contents(law));
    EXPECT_EQ(files(), 1u) << "a temporary file was left";
  }
  EXPECT_THROW(read_law_image(bytes().substr(0, 1000), path_), Error);
  EXPECT_THROW(read_law_image("", path_), Error);
  // as many nodes as the laws of 21 materials for every ratio of radii
  Law many = SyntheticLaw{}.whole_law(60, 80);
  std::vector<TwoBodyLaw>& laws = many.pair_laws["powder:glass"];
  for (int k = 1; k < 60; ++k) laws.push_back(laws.front()), laws.back().radius_ratio += 0.1 * k;
  write_law(many, path_);
  EXPECT_EQ(read_law(path_).pair_laws.at("powder:glass").size(), 60u);
}

/// One flipped bit in each of 600 places, or three changed bytes besides: the file is refused, or the law is the same.
TEST_F(LawFile, AFlippedBitIsRefusedOrChangesNothing)
{
  write_law(SyntheticLaw{}.law_with_axis(), path_);
  const std::string good = bytes(), expected = contents(read_law(path_));
  EXPECT_EQ(read_law(path_).provenance.count(checksum_note), 1u);
  unsigned state = 20261124;
  int refused = 0;
  for (int k = 0; k < 600; ++k) {
    state = state * 1664525u + 1013904223u;
    const std::size_t place = (state >> 4) % good.size();
    std::string bad = good;
    bad[place] = static_cast<char>(bad[place] ^ (1 << (state >> 1) % 8));
    for (int j = 0; k % 5 == 0 && j < 3; ++j) {
      state = state * 1664525u + 1013904223u;
      bad[(state >> 4) % bad.size()] = static_cast<char>(state >> 24);
    }
    std::ofstream(path_, std::ios::binary) << bad;
    try {
      EXPECT_EQ(contents(read_law(path_)), expected) << "byte " << place;
    } catch (const Error&) {
      ++refused;
    }
    if (HasFailure()) break;
  }
  EXPECT_GT(refused, 280);  // most bytes are numbers
}

/// Files of minor version 0 have no checksum: they are read, and the law says so.
TEST_F(LawFile, AFileOfMinorVersion0HasNoChecksum)
{
  EXPECT_EQ(after(tests::without_checksum), "");
  EXPECT_EQ(read_law(path_).provenance.count(checksum_note), 0u);
}

TEST_F(LawFile, OlderOrientationsHaveNoBodyBehindTheContact)
{
  write_law(law_with_orientations(), path_);
  const ShapeCertificate whole = *read_law(path_).bodies.at("powder").shape;
  EXPECT_EQ(whole.covered(), 0.5);
  EXPECT_NEAR(whole.force().largest, 0.04, 1e-12);
  EXPECT_NEAR(whole.force(&OrientationCheck::law_with_body).largest, 0.01, 1e-12);
  EXPECT_TRUE(whole.has_body());
  const auto older = [](hid_t file) {
    tests::without_checksum(file);
    for (const char* name : {"height", "body_force_max", "body_restitution"}) without(std::string("bodies/powder/orientations/") + name)(file);
  };
  EXPECT_EQ(after(older, law_with_orientations()), "");
  EXPECT_FALSE(read_law(path_).bodies.at("powder").shape->has_body());
}

/// Makes an open file one of major version 4, without bounds and radii of unloading.
void of_version_4(hid_t file)
{
  tests::without_checksum(file);
  const int major = 4;
  const hid_t attribute = H5Aopen(file, "version_major", H5P_DEFAULT);
  H5Awrite(attribute, H5T_NATIVE_INT, &major);
  H5Aclose(attribute);
  without("bodies/powder/curve/unloading_radius")(file);
  for (const char* body : {"powder", "glass"})
    for (const auto& f : h5::bound_fields) without(std::string("bodies/") + body + "/certificate/" + f.field.name)(file);
}

/// What its certificate says.
TEST_F(LawFile, AFileOfVersion4HasTheBoundOfItsCertificate)
{
  Law law = SyntheticLaw{}.law();
  Certificate& c = law.bodies.at("powder").certificate;
  c.origin = "atlas", c.atlas_error_force = 0.003, c.atlas_error_restitution = 0.015, c.solver_error_force = 0.004;
  law.bodies.at("glass").certificate.damage_number_max = std::numeric_limits<double>::infinity();
  EXPECT_EQ(after(of_version_4, law), "");
  const Law read = read_law(path_);
  EXPECT_DOUBLE_EQ(read.bodies.at("powder").bound.force, 0.005);
  EXPECT_EQ(read.bodies.at("powder").bound.restitution, 0.015);
  EXPECT_GT(read.bodies.at("glass").bound.swing_force, 0);
  EXPECT_FALSE(read.states_unloading_radius());
  EXPECT_EQ(read.bodies.at("powder").curve.unloading_radius(0.01).share(0.5), 0.5);
  EXPECT_TRUE(law.states_unloading_radius());
}

/// An older file states the cost at the end alone; slower impacts take a part of it.
TEST_F(LawFile, AnOlderFilesOmittedAxisIsInTheBound)
{
  Law law = SyntheticLaw{}.law();
  Certificate& c = law.bodies.at("powder").certificate;
  c.axis_cost_force = 0.08, c.axis_cost_restitution = -0.06, c.damage_number_max = 0.04;
  EXPECT_EQ(after(of_version_4, law), "");
  const ErrorBound bound = read_law(path_).bodies.at("powder").bound;
  EXPECT_DOUBLE_EQ(bound.at(0.2).force - bound.force, 0.08 * (1 + bound.force));
  EXPECT_DOUBLE_EQ(bound.at(0.2).restitution_at(0.5) - bound.restitution_at(0.5), 0.03);
  EXPECT_DOUBLE_EQ(bound.at(0.05).force - bound.force, 0.02 * (1 + bound.force));
}

/// What is said of a damage; hostile_law_test has every damage, without what is said.
TEST_F(LawFile, DamagesAreNamed)
{
  const std::string body = "bodies/powder/", force = body + "curve/force", material = body + "material/";
  const auto version = [](int number) {
    return [=](hid_t file) {
      const hid_t attribute = H5Aopen(file, "version_major", H5P_DEFAULT);
      H5Awrite(attribute, H5T_NATIVE_INT, &number);
      H5Aclose(attribute);
    };
  };
  refused(SyntheticLaw{}.law(),
          {{[](hid_t f) { overwrite(f, "bodies/powder/curve/kept", [](auto& v) { v[30] *= 0.9999; }); }, "its data do not have its checksum"},
           {without_attribute(".", "checksum"), "its checksum is missing"},
           {version(7), "major version"},
           {version(7), "found 7, allowed is 6"},
           {version(3), "a law file of version 3, and this program reads 4 to 6: make it anew with `mpm table x.toml`"},
           {set(body + "certificate/bound_force", -0.1), "bound_force"},
           {set(body + "certificate/bound_force", INFINITY), "bound_force"},
           {without(body + "certificate/bound_restitution"), "bound_restitution"},
           {without(body + "pole_radius"), "pole_radius"},
           {without(body + "curve/hertz_share"), "hertz_share"},
           {set(body + "curve/unloading_radius", NAN), "unloading_radius"},
           {without(body + "curve/onset"), ""},
           {without(body + "certificate/axis_cost_force"), "axis_cost_force"},
           {without("bodies"), "bodies"},
           {without("bodies/glass"), "glass"},
           {without_attribute("bodies/powder", "body"), "body"},
           {without_attribute("bodies/powder/certificate", "origin"), "origin"},
           {set(body + "curve/kept", NAN, false), "kept"},
           {set(body + "curve/end", 1e9), ""},
           {set(material + "density", -1), "density"},
           {set(material + "poisson_ratio", 0.5), ""},
           {set(material + "yield_stress", NAN), ""},
           {set(body + "certificate/max_inertia", NAN), ""},
           {set(body + "certificate/max_inertia", INFINITY), "infinite"},
           {replaced(force, H5T_STD_I32LE, 129), "force"},
           {replaced(force, H5T_C_S1, 129), "force"},
           // 2^50 doubles that are declared but not stored
           {replaced(force, H5T_IEEE_F64LE, hsize_t{1} << 50, true), "up to"},
           {replaced(force, H5T_IEEE_F64LE, 7), "not stored"},
           {[&](hid_t f) { replaced(force, H5T_IEEE_F64LE, 7)(f), overwrite(f, force, [](auto& v) { v.assign(7, 1.0); }); }, "length"},
           {replaced("pairs", H5T_IEEE_F64LE, 3), "pairs"}});
  const std::string axis = body + "velocity_axis/";
  refused(SyntheticLaw{}.law_with_axis(),
          {{set(axis + "level", 0.05), "level"},
           {set(axis + "kept", 1.5), "kept"},
           {set(axis + "speed_end", 1e300), "speed_end"},
           {set(axis + "force", NAN), "force"},
           {set(axis + "reach", 0.01), "reach"},
           {set(body + "curve/octaves", 2.5), "octaves"},
           {set(body + "mass_ratio", 0.5), "mass_ratio"},
           {set(body + "certificate/atlas_error_force", NAN), "atlas_error_force"},
           {without(axis + "span"), "span"},
           {without(axis + "share_end"), "share_end"},
           {without_attribute(axis, "kind"), "kind"},
           {replaced(axis + "force_slope", H5T_IEEE_F64LE, hsize_t{1} << 50, true), "up to"}});
  const std::string turns = body + "orientations/";
  std::vector<Damage> of_turns{{set(turns + "direction_z", 0, false), "direction_x"},
                               {without(turns + "law_restitution"), "law_restitution"},
                               {without_attribute(turns, "shape"), "shape"}};
  for (const auto& [name, value] : {std::pair{"contact", 4.0}, {"contact", NAN}, {"velocity", -1}, {"force_max", 0}, {"restitution", NAN}, {"effective_mass", 2},
                                    {"sharper_radius", INFINITY}, {"law_force_max", 0}, {"body_force_max", 0}, {"body_restitution", NAN}, {"height", NAN}, {"volume", 0}})
    of_turns.push_back({set(turns + name, value, false), name});
  refused(law_with_orientations(), of_turns);
  Law law = SyntheticLaw{}.law();
  law.bodies.at("powder").bound.omitted_axis = {{0.01, -0.001, 0.002}, {0.02, 0.003, 0.01}};
  law.bodies.at("powder").material.flow = {{0, 0.1, 1}, {1e8, 1.3e8, 1.7e8}};
  const std::string omitted = body + "certificate/omitted_axis_";
  refused(law, {{without(omitted + "force"), "omitted_axis_force"},
                {set(omitted + "speed", 0.01), "ascending"},
                {set(omitted + "restitution", NAN, false), "omitted velocity axis"},
                {replaced(omitted + "force", H5T_IEEE_F64LE, 3), "omitted_axis_force"},
                {set(material + "flow_strain", 0.1, false), "flow_strain"},
                {set(material + "flow_strain", -1, false), "flow_strain"},
                {set(material + "flow_strain", NAN, false), "flow_strain"},
                {set(material + "flow_stress", 0, false), "flow_stress"},
                {set(material + "flow_stress", NAN, false), "flow_stress"},
                {without(material + "flow_stress"), "flow_stress"}});
}

TEST_F(LawFile, LawsThatNoneIsAreNotWritten)
{
  not_written(SyntheticLaw{}.law_with_axis(),
              {{[](Law& l) { l.bodies["powder"].certificate.origin = "thin air"; }, "origin"},
               {[](Law& l) { l.bodies["powder"].body = "a\nb"; }, "body"},
               {[](Law& l) { l.bodies["powder"].body = "shell", l.pairs = {{"powder", "wall"}}; }, "pole_radius"},
               {[](Law& l) { l.bodies["powder"].body = "shell", l.bodies["powder"].pole_radius = 1e-3; }, "only against the rigid wall and its like"},
               {[](Law& l) { l.bodies["glass"].curve = l.bodies["powder"].curve; }, "elastic"},
               {[](Law& l) { l.bodies["powder"].material.density = -1; }, "density"}});
  const auto rename = [](Law& law, const std::string& name) {
    auto node = law.pair_laws.extract("powder:glass");
    node.key() = name;
    law.pair_laws.insert(std::move(node));
  };
  not_written(SyntheticLaw{}.whole_law(),
              {{[&](Law& l) { rename(l, "glass:powder"); }, "not among its pairs"},
               {[&](Law& l) { l.pair_laws.begin()->second.front().radius_ratio = 1, rename(l, "powder:powder"); }, "over 1"},
               {[&](Law& l) { rename(l, "powder:wall"); }, "rigid wall"},
               {[&](Law& l) { rename(l, "powder"); }, "not among its pairs"},
               {[](Law& l) { l.pair_laws.begin()->second.front().radius_ratio = -1; }, "radius_ratio"},
               {[](Law& l) { l.pair_laws.begin()->second.front().law.certificate.held_out_error = NAN; }, "held_out_error"},
               {[](Law& l) { l.pairs.push_back({"glass", "powder"}), l.pair_laws["glass:powder"] = l.pair_laws.at("powder:glass"); }, "two laws"}});
}

TEST_F(LawFile, AFailedWriteLeavesTheOldFile)
{
  write_law(SyntheticLaw{}.law(), path_);
  const std::string before = bytes();
  Law bad = SyntheticLaw{}.law();
  bad.bodies["powder"].material.density = -1;
  EXPECT_THROW(write_law(bad, path_), Error);
  EXPECT_EQ(bytes(), before);
  EXPECT_THROW(write_law(SyntheticLaw{}.law(), path("no/law.h5")), Error);
}

TEST_F(LawFile, MissingAndForeignFilesAreRefused)
{
  const auto refused = [&](const char* part) { expect_error(part, [&] { read_law(path_); }); };
  refused("no such file");
  std::ofstream(path_) << "not a law\n";
  refused("not an HDF5 file");
  H5Fclose(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  refused("not a contact law");
  EXPECT_THROW(read_law(path("")), Error);
}

TEST(Law, FlowStressOfAnOlderFileIsUnknown)
{
  Law law = SyntheticLaw{}.law();
  const auto unknown = [&] { return unknown_flow_stress(law, wall_pair(law.bodies.at("powder"))); };
  EXPECT_EQ(unknown(), "");
  law.provenance["hardening.powder"] = "voce";
  EXPECT_NE(unknown().find("make it anew"), std::string::npos);
  law.bodies.at("powder").material.flow = {{0, 0.1, 1}, {1e8, 1.3e8, 1.7e8}};
  EXPECT_EQ(unknown(), "");
}

TEST(Law, ResolvesPairsByTheWeakerBody)
{
  const Law law = SyntheticLaw{}.law();
  const PairLaw mixed = resolve_pair(law, "glass", "powder", "test");
  EXPECT_EQ(mixed.yielding->material.name, "powder");
  EXPECT_DOUBLE_EQ(mixed.mapping.e_star_pair(), 1.0 / (1.0 / 10e9 + 1.0 / (70e9 / 0.96)));
  EXPECT_DOUBLE_EQ(resolve_pair(law, "wall", "powder", "test").mapping.sqrt_lambda, 1.0);
  EXPECT_DOUBLE_EQ(resolve_pair(law, "powder", "powder", "test").mapping.sqrt_lambda, 2.0);
  expect_error("did you mean 'powder'", [&] { resolve_pair(law, "powdr", "wall", "deck"); });
  const double infinite = std::numeric_limits<double>::infinity();
  expect_error("inf and inf", [&] { resolve_pair(law, "glass", "powder", "deck", infinite, infinite); });
  Law fewer = law;
  fewer.pairs = {{"powder", "wall"}};
  EXPECT_THROW(resolve_pair(fewer, "powder", "powder", "deck"), Error);

  Law shaped = law;
  shaped.bodies["powder"].body = "core-shell";
  EXPECT_NO_THROW(resolve_pair(shaped, "powder", "powder", "deck"));
  EXPECT_NO_THROW(resolve_pair(shaped, "powder", "wall", "deck"));
  for (const char* part : {"'powder' is that of a body 'core-shell'", "powder:powder, powder:wall"})
    expect_error(part, [&] { resolve_pair(shaped, "glass", "powder", "deck"); });
}

TEST(ReplayOblique, NeedsNumbersThatAnImpactHas)
{
  const Law law = SyntheticLaw{}.law();
  const PairLaw pair = resolve_pair(law, "powder", "wall", "test");
  const auto refused = [&](double velocity, int steps) {
    ObliqueThrow thrown;
    thrown.radius = 1e-3, thrown.mass = 1e-6, thrown.velocity = velocity, thrown.tangential_velocity = 1;
    expect_error("must be positive", [&] { replay_oblique(pair, thrown, TangentialKind::history, 0.3, 0.1, steps); });
  };
  refused(0, 100), refused(-1, 100), refused(std::numeric_limits<double>::quiet_NaN(), 100), refused(1, 0);
}

}  // namespace granulaw::law_file_test
