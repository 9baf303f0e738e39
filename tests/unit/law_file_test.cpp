#include "law/law_file.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <functional>

#include "law/error_bound.hpp"
#include "law/layout.hpp"
#include "scratch_folder.hpp"
#include "synthetic_law.hpp"
#include "without_checksum.hpp"

namespace granulaw::law_file_test {

// HDF5 1.10 complains at exit ("infinite loop closing library") after it was fed damaged files; nothing is
// open then.
[[maybe_unused]] const herr_t no_exit_handler = H5dont_atexit();

namespace fs = std::filesystem;
using tests::SyntheticLaw;

class LawFile : public ScratchFolder
{
 protected:
  /// Writes a good law, changes the file through the raw API, returns the reader's sentence ("" if it
  /// accepts).
  std::string after(const std::function<void(hid_t)>& change, const Law& law = SyntheticLaw{}.law())
  {
    write_law(law, path_);
    const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    change(file);
    H5Fclose(file);
    return refusal();
  }
  /// The same must name `what`.
  void says(const std::function<void(hid_t)>& change, const std::string& what, const Law& law = SyntheticLaw{}.law())
  {
    after(change, law);
    expect_error(what, [&] { read_law(path_); });
  }
  /// A change of the first value of a dataset, or of all.
  static std::function<void(hid_t)> set(const std::string& dataset, double value, bool all = false)
  {
    return [=](hid_t file) {
      overwrite(file, dataset.c_str(), [=](std::vector<double>& v) { std::fill(v.begin(), all ? v.end() : v.begin() + 1, value); });
    };
  }
  static std::function<void(hid_t)> without(const std::string& dataset)
  {
    return [=](hid_t file) { ASSERT_GE(H5Ldelete(file, dataset.c_str(), H5P_DEFAULT), 0) << dataset; };
  }
  std::string bytes() const { return read(path_); }
  std::string refusal() const
  {
    return sentence_of([&] { read_law(path_); });
  }
  static void overwrite(hid_t file, const char* dataset,
                        const std::function<void(std::vector<double>&)>& change)
  {
    const hid_t set = H5Dopen2(file, dataset, H5P_DEFAULT), space = H5Dget_space(set);
    std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    change(values);
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(set);
  }
  /// Replaces a dataset by an empty one of another type or extent.
  static void replace(hid_t file, const char* dataset, hid_t type, hsize_t extent, bool chunked = false)
  {
    H5Ldelete(file, dataset, H5P_DEFAULT);
    const hid_t space = H5Screate_simple(1, &extent, nullptr), list = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t chunk = 1024;
    if (chunked) H5Pset_chunk(list, 1, &chunk);
    H5Dclose(H5Dcreate2(file, dataset, type, space, H5P_DEFAULT, list, H5P_DEFAULT));
    H5Pclose(list);
    H5Sclose(space);
  }

  const std::string path_ = path("law.h5");
};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

bool same_bits(const HermiteColumn& a, const HermiteColumn& b)
{
  return same_bits(a.value, b.value) && same_bits(a.slope, b.slope);
}

TEST_F(LawFile, ImageIsTheFile)
{
  write_law(SyntheticLaw{}.law_with_axis(), path_);
  const Law law = read_law(path_), image = read_law_image(bytes(), path_);
  ASSERT_EQ(image.bodies.size(), law.bodies.size());
  ASSERT_EQ(image.pairs.size(), law.pairs.size());
  for (const auto& [name, body] : law.bodies) {
    const Curve &curve = body.curve, &copy = image.bodies.at(name).curve;
    for (const double x : {1e-6, 1e-4, 1e-2, 0.05}) {
      EXPECT_EQ(copy.loading(x, 0.01).force, curve.loading(x, 0.01).force) << name;
      EXPECT_EQ(copy.onset(), curve.onset());
    }
  }
  EXPECT_THROW(read_law_image(bytes().substr(0, 1000), path_), Error);
  EXPECT_THROW(read_law_image("", path_), Error);
}

TEST_F(LawFile, RoundTripIsBitExact)
{
  const Law law = SyntheticLaw{}.law();
  write_law(law, path_);
  Law read = read_law(path_);
  read.provenance.erase(checksum_note);
  EXPECT_EQ(read.pairs, law.pairs);
  EXPECT_EQ(read.provenance, law.provenance);
  ASSERT_EQ(read.bodies.size(), law.bodies.size());
  for (const auto& [name, body] : law.bodies) {
    const BodyLaw& other = read.bodies.at(name);
    EXPECT_EQ(other.material.density, body.material.density);
    EXPECT_EQ(other.material.youngs_modulus, body.material.youngs_modulus);
    EXPECT_EQ(other.material.poisson_ratio, body.material.poisson_ratio);
    EXPECT_EQ(other.material.yield_stress, body.material.yield_stress);
    EXPECT_EQ(other.certificate.damage_number_max, body.certificate.damage_number_max);
    const CurveTable &a = body.curve.table(), &b = other.curve.table();
    EXPECT_EQ(a.onset, b.onset);
    EXPECT_EQ(a.end, b.end);
    EXPECT_EQ(a.octaves, b.octaves);
    for (const auto& f : h5::curve_columns) EXPECT_TRUE(same_bits(a.*f.column, b.*f.column)) << f.values.name;
  }
  EXPECT_EQ(files(), 1u) << "a temporary file was left";
}

/// Every number of a law that a collision depends on, by its text to all digits.
std::string contents(const Law& law)
{
  std::string text;
  const auto add = [&](double value) { text += std::to_string(std::bit_cast<std::uint64_t>(value)) + " "; };
  for (const auto& [name, body] : law.bodies) {
    text += name + " ";
    for (const double value :
         {body.material.density, body.material.youngs_modulus, body.material.poisson_ratio,
          body.material.yield_stress, body.certificate.damage_number_max, body.certificate.atlas_error_force,
          body.mass_ratio})
      add(value);
    const auto add_column = [&](const HermiteColumn& column) {
      for (const double value : column.value) add(value);
      for (const double slope : column.slope) add(slope);
    };
    for (const auto& f : h5::curve_columns) add_column(body.curve.table().*f.column);
    if (const AxisTable* axis = body.curve.axis())
      for (const auto& f : h5::axis_columns) add_column(axis->*f.column);
  }
  for (const LawPair& pair : law.pairs) text += pair.a + ":" + pair.b + " ";
  return text;
}

/// One flipped bit in each of 1500 places, or three changed bytes besides: the file is refused, or the law is the same.
TEST_F(LawFile, AFlippedBitIsRefusedOrChangesNothing)
{
  write_law(SyntheticLaw{}.law_with_axis(), path_);
  const std::string good = bytes(), expected = contents(read_law(path_));
  EXPECT_EQ(read_law(path_).provenance.count(checksum_note), 1u);
  unsigned state = 20261124;
  int refused = 0;
  for (int k = 0; k < 1500; ++k) {
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
  EXPECT_GT(refused, 700);  // most bytes are numbers
}

TEST_F(LawFile, ChangedDataAreRefusedWithASentence)
{
  const auto change = [](hid_t file) {
    overwrite(file, "bodies/powder/curve/kept", [](std::vector<double>& v) { v[30] *= 0.9999; });
  };
  EXPECT_NE(after(change).find("its data do not have its checksum"), std::string::npos) << after(change);
  EXPECT_NE(after([](hid_t file) { H5Adelete(file, "checksum"); }).find("its checksum is missing"),
            std::string::npos);
}

/// Files of minor version 0 have no checksum: they are read, and the law says so.
TEST_F(LawFile, AFileOfMinorVersion0HasNoChecksum)
{
  EXPECT_EQ(after(tests::without_checksum), "");
  EXPECT_EQ(read_law(path_).provenance.count(checksum_note), 0u);
}

TEST_F(LawFile, TheAxisTheBodyAndThePairErrorsComeBackBitExact)
{
  Law law = SyntheticLaw{}.law_with_axis();
  BodyLaw& powder = law.bodies.at("powder");
  powder.certificate.atlas_error_force = 0.004;
  powder.certificate.atlas_error_restitution = 0.003;
  powder.certificate.origin = "atlas";
  law.pairs[1].reduction_error_force = 0.012;
  law.pairs[1].reduction_error_restitution = 0.034;
  BodyLaw grain = powder;
  grain.material.name = "grain";
  grain.curve = Curve(SyntheticLaw{}.table(), SyntheticLaw{}.rate_axis(2.5e-3));
  grain.body = "core-shell";
  grain.pole_radius = 2.5e-3;
  grain.mass_ratio = 0.87;
  law.bodies["grain"] = grain;
  law.pairs.push_back({"grain", "grain"});
  law.pairs.push_back({"grain", "wall"});
  write_law(law, path_);
  Law read = read_law(path_);
  read.provenance.erase(checksum_note);
  EXPECT_EQ(read.pairs, law.pairs);
  for (const char* name : {"powder", "grain"}) {
    const BodyLaw &a = law.bodies.at(name), &b = read.bodies.at(name);
    ASSERT_NE(b.curve.axis(), nullptr);
    const AxisTable &s = *a.curve.axis(), &t = *b.curve.axis();
    EXPECT_EQ(s.by, t.by);
    for (const auto& n : h5::axis_numbers) EXPECT_EQ(s.*n.value, t.*n.value) << n.field.name;
    for (const auto& f : h5::axis_columns) EXPECT_TRUE(same_bits(s.*f.column, t.*f.column)) << f.values.name;
    for (const auto& f : h5::axis_lists) EXPECT_TRUE(same_bits(s.*f.values, t.*f.values)) << f.field.name;
    EXPECT_EQ(a.certificate.axis_cost_force, b.certificate.axis_cost_force);
    EXPECT_EQ(a.certificate.axis_cost_restitution, b.certificate.axis_cost_restitution);
    EXPECT_EQ(a.certificate.atlas_error_force, b.certificate.atlas_error_force);
    EXPECT_EQ(a.certificate.atlas_error_restitution, b.certificate.atlas_error_restitution);
    EXPECT_EQ(a.certificate.origin, b.certificate.origin);
    EXPECT_EQ(a.body, b.body);
    EXPECT_EQ(a.pole_radius, b.pole_radius);
    EXPECT_EQ(a.mass_ratio, b.mass_ratio);
  }
}

/// As many nodes as the laws of 21 materials for every ratio of radii.
TEST_F(LawFile, ManyLawsComeBack)
{
  Law law = SyntheticLaw{}.whole_law(60, 80);
  std::vector<TwoBodyLaw>& laws = law.pair_laws["powder:glass"];
  for (int k = 1; k < 60; ++k) laws.push_back(laws.front()), laws.back().radius_ratio += 0.1 * k;
  write_law(law, path_);
  EXPECT_EQ(read_law(path_).pair_laws.at("powder:glass").size(), 60u);
}

TEST_F(LawFile, CostsOfAnOmittedAxisComeBackAndAreChecked)
{
  Law law = SyntheticLaw{}.law();
  std::vector<AxisCost>& costs = law.bodies.at("powder").certificate.omitted_axis;
  costs = {{0.01, -0.001, 0.002}, {0.02, 0.003, 0.01}};
  const std::string folder = "bodies/powder/certificate/";
  EXPECT_EQ(after([](hid_t) {}, law), "");
  const Law read = read_law(path_);
  const std::vector<AxisCost>& back = read.bodies.at("powder").certificate.omitted_axis;
  ASSERT_EQ(back.size(), 2u);
  for (const h5::AxisCostField& f : h5::axis_cost_fields)
    for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(back[k].*f.value, costs[k].*f.value) << f.field.name;
  says(without(folder + "omitted_axis_force"), "omitted_axis_force", law);
  says(set(folder + "omitted_axis_speed", 0.01, true), "ascending", law);
  says(set(folder + "omitted_axis_restitution", NAN), "omitted velocity axis", law);
  says([&](hid_t f) { replace(f, (folder + "omitted_axis_force").c_str(), H5T_IEEE_F64LE, 3); }, "omitted_axis_force", law);
}

/// An older file states the cost at the end alone; slower impacts take a part of it.
TEST_F(LawFile, AnOlderFilesOmittedAxisIsInTheBound)
{
  Law law = SyntheticLaw{}.law();
  Certificate& c = law.bodies.at("powder").certificate;
  c.axis_cost_force = 0.08, c.axis_cost_restitution = -0.06, c.damage_number_max = 0.04;
  write_law(law, path_);
  const ErrorBound bound = bound_of(read_law(path_).bodies.at("powder"));
  EXPECT_DOUBLE_EQ(bound.at(0.2).force - bound.force, 0.08 * (1 + bound.force));
  EXPECT_DOUBLE_EQ(bound.at(0.2).restitution_at(0.5) - bound.restitution_at(0.5), 0.03);
  EXPECT_DOUBLE_EQ(bound.at(0.05).force - bound.force, 0.02 * (1 + bound.force));
}

TEST_F(LawFile, WhatIsMissingIsNamed)
{
  for (const char* set : {"pair_reduction_error_force", "bodies/powder/pole_radius",
                          "bodies/powder/curve/hertz_share", "bodies/powder/certificate/axis_cost_force"})
    says(without(set), fs::path(set).filename());
  for (const auto& [group, name] :
       {std::pair{"bodies/powder", "body"}, {"bodies/powder/certificate", "origin"}})
    says([&](hid_t f) { ASSERT_GE(H5Adelete_by_name(f, group, name, H5P_DEFAULT), 0) << name; }, name);
}

TEST_F(LawFile, UnusableAdditionsAreRefused)
{
  const Law law = SyntheticLaw{}.law_with_axis();
  const std::string axis = "bodies/powder/velocity_axis/", body = "bodies/powder/";
  for (const auto& [dataset, value] : {std::pair{axis + "level", 0.05},
                                       {axis + "kept", 1.5},
                                       {axis + "speed_end", 1e300},
                                       {axis + "force", NAN},
                                       {axis + "reach", 0.01},
                                       {body + "curve/octaves", 2.5},
                                       {body + "mass_ratio", 0.5},
                                       {body + "certificate/atlas_error_force", NAN}})
    says(set(dataset, value, true), fs::path(dataset).filename(), law);
  says(set("pair_reduction_error_force", -1, true), "reduction error", law);
  says(without(axis + "span"), "span", law);
  says(without(axis + "share_end"), "share_end", law);
  says([&](hid_t f) { H5Adelete_by_name(f, axis.c_str(), "kind", H5P_DEFAULT); }, "kind", law);
  says([&](hid_t f) { replace(f, (axis + "force_slope").c_str(), H5T_IEEE_F64LE, hsize_t{1} << 50, true); },
       "up to", law);

  const auto refuses = [&](const std::function<void(Law&)>& change, const char* what) {
    Law bad = law;
    change(bad);
    expect_error(what, [&] { write_law(bad, path_); });
  };
  refuses([](Law& l) { l.bodies["powder"].certificate.origin = "thin air"; }, "origin");
  refuses([](Law& l) { l.bodies["powder"].body = "a\nb"; }, "body");
  refuses([](Law& l) { l.bodies["powder"].body = "shell", l.pairs = {{"powder", "wall"}}; }, "pole_radius");
  refuses([](Law& l) { l.bodies["powder"].body = "shell", l.bodies["powder"].pole_radius = 1e-3; },
          "only against the rigid wall and its like");
  refuses([](Law& l) { l.bodies["glass"].curve = l.bodies["powder"].curve; }, "elastic");
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

TEST_F(LawFile, OrientationsComeBackBitExact)
{
  const Law law = law_with_orientations();
  write_law(law, path_);
  const ShapeCertificate a = *law.bodies.at("powder").shape,
                         b = read_law(path_).bodies.at("powder").shape.value();
  EXPECT_EQ(a.shape, b.shape);
  EXPECT_EQ(a.mirrors, b.mirrors);
  EXPECT_EQ(a.volume, b.volume);
  EXPECT_EQ(a.solver_error, b.solver_error);
  ASSERT_EQ(b.checks.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const OrientationCheck &x = a.checks[k], &y = b.checks[k];
    EXPECT_EQ(x.direction, y.direction);
    EXPECT_EQ(x.velocity, y.velocity);
    EXPECT_EQ(x.sharper_radius, y.sharper_radius);
    EXPECT_EQ(x.flatter_radius, y.flatter_radius);
    EXPECT_EQ(x.effective_mass, y.effective_mass);
    EXPECT_EQ(x.local, y.local);
    EXPECT_EQ(x.solver.force_max, y.solver.force_max);
    EXPECT_EQ(x.solver.restitution, y.solver.restitution);
    EXPECT_EQ(x.law.force_max, y.law.force_max);
    EXPECT_EQ(x.law.restitution, y.law.restitution);
    EXPECT_EQ(x.height, y.height);
    EXPECT_EQ(x.law_with_body.force_max, y.law_with_body.force_max);
    EXPECT_EQ(x.law_with_body.restitution, y.law_with_body.restitution);
  }
  EXPECT_EQ(b.covered(), 0.5);
  EXPECT_NEAR(b.force().largest, 0.04, 1e-12);
  EXPECT_NEAR(b.force(&OrientationCheck::law_with_body).largest, 0.01, 1e-12);
  EXPECT_TRUE(b.has_body());
  EXPECT_FALSE(read_law(path_).bodies.at("glass").shape.has_value());
}

TEST_F(LawFile, OlderOrientationsHaveNoBodyBehindTheContact)
{
  const auto older = [](hid_t file) {
    tests::without_checksum(file);
    for (const char* name : {"height", "body_force_max", "body_restitution"})
      H5Ldelete(file, (std::string("bodies/powder/orientations/") + name).c_str(), H5P_DEFAULT);
  };
  EXPECT_EQ(after(older, law_with_orientations()), "");
  EXPECT_FALSE(read_law(path_).bodies.at("powder").shape->has_body());
}

TEST_F(LawFile, UnusableOrientationsAreRefused)
{
  const Law law = law_with_orientations();
  const std::string group = "bodies/powder/orientations/";
  says(set(group + "direction_z", 0), "direction_x", law);
  for (const auto& [name, value] : {std::pair{"contact", 4.0},
                                    {"contact", NAN},
                                    {"velocity", -1},
                                    {"force_max", 0},
                                    {"restitution", NAN},
                                    {"effective_mass", 2},
                                    {"sharper_radius", INFINITY},
                                    {"law_force_max", 0},
                                    {"body_force_max", 0},
                                    {"body_restitution", NAN},
                                    {"height", NAN},
                                    {"volume", 0}})
    says(set(group + name, value), name, law);
  says(without(group + "law_restitution"), "law_restitution", law);
  says([&](hid_t f) { H5Adelete_by_name(f, group.c_str(), "shape", H5P_DEFAULT); }, "shape", law);
}

TEST_F(LawFile, FlowStressComesBackBitExact)
{
  Law law = SyntheticLaw{}.law();
  const PairLaw linear = wall_pair(law.bodies.at("powder"));
  EXPECT_EQ(unknown_flow_stress(law, linear), "");
  law.provenance["hardening.powder"] = "voce";
  EXPECT_NE(unknown_flow_stress(law, linear).find("make it anew"), std::string::npos);  // of an older file
  FlowNodes& flow = law.bodies.at("powder").material.flow;
  flow = {{0, 0.1, 1}, {1e8, 1.3e8, 1.7e8}};
  EXPECT_EQ(unknown_flow_stress(law, wall_pair(law.bodies.at("powder"))), "");
  write_law(law, path_);
  const Law back = read_law(path_);
  EXPECT_EQ(back.bodies.at("powder").material.flow.strain, flow.strain);
  EXPECT_EQ(back.bodies.at("powder").material.flow.stress, flow.stress);

  const std::string group = "bodies/powder/material/";
  for (const double value : {0.1, -1.0, std::nan("")}) says(set(group + "flow_strain", value), "flow_strain", law);
  says(set(group + "flow_stress", 0), "flow_stress", law);
  says(set(group + "flow_stress", NAN), "flow_stress", law);
  says(without(group + "flow_stress"), "flow_stress", law);
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

TEST_F(LawFile, AnotherMajorVersionIsRefusedWithBothNumbers)
{
  const auto version = [](int number) {
    return [=](hid_t file) {
      const hid_t attribute = H5Aopen(file, "version_major", H5P_DEFAULT);
      H5Awrite(attribute, H5T_NATIVE_INT, &number);
      H5Aclose(attribute);
    };
  };
  says(version(5), "major version");
  says(version(5), "found 5, allowed is 4");
  says(version(3), "a law file of version 3, and this program reads 4: make it anew with `mpm table x.toml`");
}

TEST_F(LawFile, UnusableNumbersAreRefused)
{
  const std::string body = "bodies/powder/";
  says(set(body + "curve/kept", NAN), "kept");
  says(set(body + "curve/end", 1e9), "");
  says(set(body + "material/density", -1), "density");
  says(set(body + "material/poisson_ratio", 0.5), "");
  says(set(body + "material/yield_stress", NAN), "");
  says(set(body + "certificate/max_inertia", NAN), "");
  says(without(body + "curve/onset"), "");
}

TEST_F(LawFile, WrongTypesAndSizesAreRefusedWithoutLargeAllocation)
{
  const char* force = "bodies/powder/curve/force";
  says([&](hid_t f) { replace(f, force, H5T_STD_I32LE, 129); }, "force");
  says([&](hid_t f) { replace(f, force, H5T_C_S1, 129); }, "force");
  // 2^50 doubles that are declared but not stored
  says([&](hid_t f) { replace(f, force, H5T_IEEE_F64LE, hsize_t{1} << 50, true); }, "up to");
  says([&](hid_t f) { replace(f, force, H5T_IEEE_F64LE, 7); }, "not stored");
  says(
      [&](hid_t f) {
        replace(f, force, H5T_IEEE_F64LE, 7);
        overwrite(f, force, [](std::vector<double>& v) { v.assign(7, 1.0); });
      },
      "length");
  says([&](hid_t f) { replace(f, "pairs", H5T_IEEE_F64LE, 3); }, "pairs");
  says(without("bodies"), "bodies");
  says(without("bodies/glass"), "glass");
}

TEST_F(LawFile, AFailedWriteLeavesTheOldFile)
{
  write_law(SyntheticLaw{}.law(), path_);
  const auto size = fs::file_size(path_);
  Law bad = SyntheticLaw{}.law();
  bad.bodies["powder"].material.density = -1;
  EXPECT_THROW(write_law(bad, path_), Error);
  EXPECT_EQ(fs::file_size(path_), size);
  EXPECT_THROW(write_law(SyntheticLaw{}.law(), path("no/law.h5")), Error);
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

}  // namespace granulaw::law_file_test
