#include "hostile_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "law/h5.hpp"

namespace granulaw::tests {

namespace {

using h5::Handle;
using Values = std::vector<double>;

const std::vector<std::string> material = {"density", "youngs_modulus", "poisson_ratio", "yield_stress",
                                           "hardening_modulus"};
const std::vector<std::string> lists = {"force_ratio", "residual_ratio", "exponent", "foot", "radius_ratio"};
const std::vector<std::string> certificate = {"held_out_error", "slow_press_force", "max_inertia",
                                              "axis_cost_force", "atlas_error_restitution"};
const std::vector<std::string> axis = {"speed_end",
                                       "impact_overlap",
                                       "slices",
                                       "ratio_end",
                                       "first_slices",
                                       "force_correction",
                                       "force_correction_slope",
                                       "residual_correction",
                                       "exponent_correction_slope"};

// what only a file with a pair's own law has, and of what it shares with bodies enough to find another way in
const std::string pair_law = "pair_laws/powder:glass";
const std::vector<std::string> pair_sets = {"radius_ratio_of_runs",
                                            "curve/s_end",
                                            "curve/onset",
                                            "curve/force_ratio",
                                            "curve/exponent_slope",
                                            "certificate/max_inertia",
                                            "inertia_axis/reference_radius",
                                            "inertia_axis/speed_begin",
                                            "inertia_axis/speed_end",
                                            "inertia_axis/slices",
                                            "inertia_axis/impact_overlap",
                                            "inertia_axis/force_correction"};

std::string parent_of(const std::string& path)
{
  return path.substr(0, path.rfind('/') + 1) + ".";
}

/// A dataset's values; {1} where another damage left nothing that could be read.
Values read(hid_t file, const char* path)
{
  const Handle set(H5Dopen2(file, path, H5P_DEFAULT));
  if (!set.ok()) return {1.0};
  const Handle space(H5Dget_space(set)), type(H5Dget_type(set)), list(H5Dget_create_plist(set));
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  const H5D_layout_t layout = H5Pget_layout(list);
  if (count < 1 || count > 65536 || H5Tget_class(type) != H5T_FLOAT || layout != H5D_CONTIGUOUS ||
      H5Pget_external_count(list) != 0)
    return {1.0};
  Values values(static_cast<std::size_t>(count));
  H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  return values;
}

hsize_t count_of(hid_t file, const char* path)
{
  return read(file, path).size();
}

void overwrite(hid_t file, const std::string& path, const std::function<void(Values&)>& change)
{
  Values values = read(file, path.c_str());
  change(values);
  const Handle set(H5Dopen2(file, path.c_str(), H5P_DEFAULT)), space(set.ok() ? H5Dget_space(set) : -1);
  if (space.ok() && H5Sget_simple_extent_npoints(space) == static_cast<hssize_t>(values.size()))
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
}

/// Puts a dataset of `type` and `extents` (none: a scalar) in place of `path`; `values` may be nothing.
void replace(hid_t file, const std::string& path, hid_t type, const std::vector<hsize_t>& extents,
             const void* values = nullptr, hid_t value_type = -1, hid_t list = H5P_DEFAULT)
{
  H5Ldelete(file, path.c_str(), H5P_DEFAULT);
  const Handle space(extents.empty()
                         ? H5Screate(H5S_SCALAR)
                         : H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr));
  const Handle set(H5Dcreate2(file, path.c_str(), type, space, H5P_DEFAULT, list, H5P_DEFAULT));
  if (set.ok() && values)
    H5Dwrite(set, value_type < 0 ? type : value_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
}

/// A creation list with a fill value, so that values never written read as it.
Handle filled(double value)
{
  Handle list(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_fill_value(list, H5T_NATIVE_DOUBLE, &value);
  return list;
}

Handle text_type(std::size_t size)
{
  Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, size);
  return type;
}

using NamedType = std::pair<std::string, std::function<Handle()>>;
std::vector<NamedType> types()
{
  const auto copy = [](hid_t type) { return Handle(H5Tcopy(type)); };
  return {
      {"32-bit integers", [=] { return copy(H5T_STD_I32LE); }},
      {"bytes", [=] { return copy(H5T_STD_U8BE); }},
      {"bits", [=] { return copy(H5T_STD_B64LE); }},
      {"references", [=] { return copy(H5T_STD_REF_OBJ); }},
      {"floats of 4 bytes", [=] { return copy(H5T_IEEE_F32BE); }},
      {"floats of 200 bytes",
       [=] {
         Handle type = copy(H5T_IEEE_F64LE);
         H5Tset_size(type, 200);
         return type;
       }},
      {"floats with one bit of mantissa",
       [=] {
         Handle type = copy(H5T_IEEE_F64LE);
         H5Tset_fields(type, 63, 52, 11, 0, 1);
         return type;
       }},
      {"text of one byte", [] { return text_type(1); }},
      {"text of a megabyte", [] { return text_type(1 << 20); }},
      {"text of any length", [] { return text_type(H5T_VARIABLE); }},
      {"opaque", [] { return Handle(H5Tcreate(H5T_OPAQUE, 8)); }},
      {"pairs of numbers",
       [] {
         Handle type(H5Tcreate(H5T_COMPOUND, 16));
         H5Tinsert(type, "a", 0, H5T_IEEE_F64LE);
         H5Tinsert(type, "b", 8, H5T_IEEE_F64LE);
         return type;
       }},
      {"names", [] { return Handle(H5Tenum_create(H5T_NATIVE_INT)); }},
      {"arrays",
       [] {
         const hsize_t extent = 1 << 20;
         return Handle(H5Tarray_create2(H5T_IEEE_F64LE, 1, &extent));
       }},
      {"lists of any length", [] { return Handle(H5Tvlen_create(H5T_IEEE_F64LE)); }},
  };
}

struct Collector
{
  std::vector<Damage>& all;
  std::string folder;
  bool leads_away = false;  // the next one added

  void add(std::string name, std::function<void(hid_t)> change, bool big = false)
  {
    all.push_back({std::move(name), std::move(change), big, leads_away});
    leads_away = false;
  }
  void values(const std::string& path);
  void storage(const std::string& path);
  void entry(const std::string& path);
  void texts();
  void names();
  void attribute(const std::string& object, const std::string& name);
};

/// Numbers that are no law's.
void Collector::values(const std::string& path)
{
  for (const double bad :
       {std::nan(""), HUGE_VAL, -HUGE_VAL, -1.0, 0.0, -0.0, 1e308, -1e308, 5e-324, 1e12, 0.5})
    for (const int where : {0, 1, 2}) {
      const char* at = where == 0 ? "the first" : where == 1 ? "the middle" : "every";
      add(fmt::format("{}: {} value {:g}", path, at, bad), [=](hid_t file) {
        overwrite(file, path, [&](Values& v) {
          if (where == 2)
            v.assign(v.size(), bad);
          else
            v[where * v.size() / 2] = bad;
        });
      });
    }
  add(path + ": reversed", [=](hid_t f) {
    overwrite(f, path, [](Values& v) { v = {v.rbegin(), v.rend()}; });
  });
  add(path + ": rotated", [=](hid_t f) {
    overwrite(f, path, [](Values& v) { std::rotate(v.begin(), v.begin() + v.size() / 3, v.end()); });
  });
  add(path + ": alternating signs", [=](hid_t f) {
    overwrite(f, path, [](Values& v) {
      for (std::size_t k = 1; k < v.size(); k += 2) v[k] = -v[k];
    });
  });
}

/// Types, ranks, extents and storage that are not the format's.
void Collector::storage(const std::string& path)
{
  for (const auto& [name, make] : types())
    add(path + ": " + name,
        [=, make = make](hid_t f) { replace(f, path, make(), {count_of(f, path.c_str())}); });
  for (const hsize_t extent : {hsize_t{0}, hsize_t{1}, hsize_t{2}, hsize_t{3}, hsize_t{128}, hsize_t{65536},
                               hsize_t{65537}, hsize_t{1} << 40}) {
    add(path + ": declared extent " + std::to_string(extent), [=](hid_t f) {
      // no storage until written: a file of some kB can declare terabytes
      replace(f, path, H5T_IEEE_F64LE, {extent}, nullptr, -1, filled(1.5));
    });
    add(path + ": chunked extent " + std::to_string(extent), [=](hid_t f) {
      const Handle list = filled(0.5);
      const hsize_t chunk = (hsize_t{1} << 28) - 1;  // of 2 GiB: read into memory as a whole
      H5Pset_chunk(list, 1, &chunk);
      replace(f, path, H5T_IEEE_F64LE, {extent}, nullptr, -1, list);
    });
  }
  add(path + ": scalar", [=](hid_t f) {
    const Values values = read(f, path.c_str());
    replace(f, path, H5T_IEEE_F64LE, {}, values.data(), H5T_NATIVE_DOUBLE);
  });
  add(path + ": a column", [=](hid_t f) {
    const Values values = read(f, path.c_str());
    replace(f, path, H5T_IEEE_F64LE, {values.size(), 1}, values.data(), H5T_NATIVE_DOUBLE);
  });
  add(path + ": rank 32", [=](hid_t f) { replace(f, path, H5T_IEEE_F64LE, std::vector<hsize_t>(32, 1)); });
  add(path + ": rank 32, 2^62 values", [=](hid_t f) {
    std::vector<hsize_t> extents(32, 4);
    extents[0] = 1;
    const Handle list(H5Pcreate(H5P_DATASET_CREATE));
    const std::vector<hsize_t> chunk(32, 1);
    H5Pset_chunk(list, 32, chunk.data());
    replace(f, path, H5T_IEEE_F64LE, extents, nullptr, -1, list);
  });
  add(path + ": no extent", [=](hid_t f) {
    H5Ldelete(f, path.c_str(), H5P_DEFAULT);
    const Handle space(H5Screate(H5S_NULL));
    const Handle set(
        H5Dcreate2(f, path.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  });
  for (const bool checksummed : {false, true})
    add(path + (checksummed ? ": chunks with a checksum" : ": compressed"), [=](hid_t f) {
      const Values values = read(f, path.c_str());
      const Handle list(H5Pcreate(H5P_DATASET_CREATE));
      const hsize_t chunk = values.size();
      H5Pset_chunk(list, 1, &chunk);
      if (checksummed)
        H5Pset_fletcher32(list);
      else
        H5Pset_deflate(list, 9);
      replace(f, path, H5T_IEEE_F64LE, {chunk}, values.data(), H5T_NATIVE_DOUBLE, list);
    });
  add(path + ": a filter that nobody has", [=](hid_t f) {
    const H5Z_class2_t nothing = {
        H5Z_CLASS_T_VERS,
        300,
        1,
        1,
        "none",
        nullptr,
        nullptr,
        [](unsigned, std::size_t, const unsigned*, std::size_t size, std::size_t*, void**) { return size; }};
    H5Zregister(&nothing);
    {
      const Values values = read(f, path.c_str());
      const Handle list(H5Pcreate(H5P_DATASET_CREATE));
      const hsize_t chunk = values.size();
      H5Pset_chunk(list, 1, &chunk);
      H5Pset_filter(list, 300, 0, 0, nullptr);
      replace(f, path, H5T_IEEE_F64LE, {chunk}, values.data(), H5T_NATIVE_DOUBLE, list);
    }
    H5Fflush(f, H5F_SCOPE_LOCAL);
    H5Zunregister(300);
  });
  for (const char* elsewhere : {"/dev/zero", "/none", "other.h5", "fifo"}) {
    leads_away = true;
    add(path + ": values stored in " + elsewhere, [=, in = folder](hid_t f) {
      const std::string name = elsewhere[0] == '/' ? elsewhere : in + "/" + elsewhere;
      const hsize_t count = count_of(f, path.c_str());
      const Handle list(H5Pcreate(H5P_DATASET_CREATE));
      H5Pset_external(list, name.c_str(), 0, 8 * count);
      replace(f, path, H5T_IEEE_F64LE, {count}, nullptr, -1, list);
    });
  }
  for (const char* elsewhere : {"other.h5", "fifo"}) {
    leads_away = true;
    add(path + ": virtual, of " + elsewhere, [=, in = folder](hid_t f) {
      const hsize_t count = count_of(f, path.c_str());
      const Handle list(H5Pcreate(H5P_DATASET_CREATE)), space(H5Screate_simple(1, &count, nullptr));
      H5Pset_virtual(list, space, (in + "/" + elsewhere).c_str(), path.c_str(), space);
      replace(f, path, H5T_IEEE_F64LE, {count}, nullptr, -1, list);
    });
  }
}

/// Objects that can stand in place of any dataset or group.
void Collector::entry(const std::string& path)
{
  const auto instead = [&](const std::string& name, std::function<void(hid_t, const char*)> make) {
    add(path + ": " + name, [=](hid_t f) {
      H5Ldelete(f, path.c_str(), H5P_DEFAULT);
      make(f, path.c_str());
    });
  };
  instead("missing", [](hid_t, const char*) {});
  instead("a group", [](hid_t f, const char* at) {
    const Handle group(H5Gcreate2(f, at, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  });
  instead("a number", [](hid_t f, const char* at) { replace(f, at, H5T_IEEE_F64LE, {}); });
  instead("a type", [](hid_t f, const char* at) {
    const Handle type(H5Tcopy(H5T_IEEE_F64LE));
    H5Tcommit2(f, at, type, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  });
  instead("the root",
          [](hid_t f, const char* at) { H5Lcreate_hard(f, "/", f, at, H5P_DEFAULT, H5P_DEFAULT); });
  instead("its parent", [](hid_t f, const char* at) {
    H5Lcreate_hard(f, parent_of(at).c_str(), f, at, H5P_DEFAULT, H5P_DEFAULT);
  });
  instead("a link to itself",
          [](hid_t f, const char* at) { H5Lcreate_soft(at, f, at, H5P_DEFAULT, H5P_DEFAULT); });
  instead("links in a circle", [](hid_t f, const char* at) {
    H5Lcreate_soft("/there", f, at, H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_soft(at, f, "/there", H5P_DEFAULT, H5P_DEFAULT);
  });
  instead("a link to nothing",
          [](hid_t f, const char* at) { H5Lcreate_soft("/none", f, at, H5P_DEFAULT, H5P_DEFAULT); });
  for (const char* elsewhere : {"other.h5", "fifo", "none.h5"}) {
    leads_away = true;
    instead(std::string("a link into ") + elsewhere,
            [name = folder + "/" + elsewhere](hid_t f, const char* at) {
              H5Lcreate_external(name.c_str(), at, f, at, H5P_DEFAULT, H5P_DEFAULT);
            });
  }
  add(path + ": a link to where it moved", [=](hid_t f) {
    H5Lmove(f, path.c_str(), f, "/moved", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_soft("/moved", f, path.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  });
}

void Collector::texts()
{
  const auto write = [](hid_t f, const std::vector<std::string>& texts) {
    H5Ldelete(f, "pairs", H5P_DEFAULT);
    if (!h5::has_link(f, "pairs")) h5::write_texts(f, "pairs", texts, "hostile");
  };
  const std::string long_name(60000, 'a');
  for (const std::vector<std::string>& texts :
       std::vector<std::vector<std::string>>{{},
                                             {""},
                                             {":"},
                                             {"powder"},
                                             {"powder:"},
                                             {":powder"},
                                             {"powder:powder:wall"},
                                             {"none:wall"},
                                             {"wall:wall"},
                                             {"powder:wall", "powder:wall"},
                                             {"powder:wall\n"},
                                             {"\x1b[31m:wall"},
                                             {"\xff\xfe:wall"},
                                             {long_name},
                                             {long_name + ":wall"}})
    add(fmt::format("pairs: '{:.10}'", texts.empty() ? "" : texts[0].c_str()),
        [=](hid_t f) { write(f, texts); });
  add(
      "pairs: 70000", [=](hid_t f) { write(f, std::vector<std::string>(70000, "powder:wall")); }, true);
  add("pairs: 65536 of 1 kB", [=](hid_t f) {
    replace(f, "pairs", text_type(1024), {65536});  // declared: 64 MB
  });
}

void Collector::names()
{
  for (const std::string& name :
       {std::string("wall"), std::string("two\nlines"), std::string("\x1b[2J"), std::string("a:b"),
        std::string("..."), std::string("\xff\xfe"), std::string(255, 'n'), std::string(60000, 'n')}) {
    add("a body named " + name.substr(0, 9), [=](hid_t f) {
      H5Lcreate_hard(f, "bodies/powder", f, ("bodies/" + name).c_str(), H5P_DEFAULT, H5P_DEFAULT);
    });
    add("a note named " + name.substr(0, 9), [=](hid_t f) {
      const Handle notes(H5Gopen2(f, "provenance", H5P_DEFAULT)), space(H5Screate(H5S_SCALAR)),
          type = text_type(4);
      const Handle note(H5Acreate2(notes, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT));
      if (note.ok()) H5Awrite(note, type, "a\nb");
    });
  }
  for (const std::string& name :
       {std::string("glass:powder"), std::string("powder:wall"), std::string("wall:wall"),
        std::string("powder:powder"), std::string("powder:none"), std::string("powder"), std::string(":"),
        std::string("powder:glass:wall"), std::string("\x1b[2J:\n"), std::string(60000, 'n')})
    for (const bool moved : {false, true})
      add((moved ? "a pair law renamed " : "a second pair law named ") + name.substr(0, 20), [=](hid_t f) {
        if (moved)
          H5Lmove(f, pair_law.c_str(), f, ("pair_laws/" + name).c_str(), H5P_DEFAULT, H5P_DEFAULT);
        else
          H5Lcreate_hard(f, pair_law.c_str(), f, ("pair_laws/" + name).c_str(), H5P_DEFAULT, H5P_DEFAULT);
      });
  add("300 pair laws", [](hid_t f) {
    for (int k = 0; k < 300; ++k)
      H5Lcreate_hard(f, pair_law.c_str(), f, ("pair_laws/p" + std::to_string(k) + ":glass").c_str(),
                     H5P_DEFAULT, H5P_DEFAULT);
  });
  add("the pair law is a body's", [](hid_t f) {
    H5Ldelete(f, pair_law.c_str(), H5P_DEFAULT);
    H5Lcreate_hard(f, "bodies/powder", f, pair_law.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  });
  add("the pair law's axis is a body's", [](hid_t f) {
    H5Ldelete(f, (pair_law + "/inertia_axis").c_str(), H5P_DEFAULT);
    H5Lcreate_hard(f, "bodies/powder/inertia_axis", f, (pair_law + "/inertia_axis").c_str(), H5P_DEFAULT,
                   H5P_DEFAULT);
  });
  for (const int count : {200, 300, 3000})
    add(std::to_string(count) + " bodies", [=](hid_t f) {
      for (int k = 0; k < count; ++k)
        H5Lcreate_hard(f, "bodies/powder", f, ("bodies/p" + std::to_string(k)).c_str(), H5P_DEFAULT,
                       H5P_DEFAULT);
    });
  add(
      "200 bodies of 65536 nodes",
      [](hid_t f) {
        // hard links to one body: 4 MB in the file, 3 GB in a trusting reader's memory
        for (const std::string& list : lists)
          for (const char* suffix : {"", "_slope"}) {
            const bool slope = *suffix;
            const Values values(65536, slope ? 0.0 : list == "residual_ratio" ? 0.5 : 1.5);
            replace(f, "bodies/powder/curve/" + list + suffix, H5T_IEEE_F64LE, {values.size()}, values.data(),
                    H5T_NATIVE_DOUBLE);
          }
        for (int k = 0; k < 200; ++k)
          H5Lcreate_hard(f, "bodies/powder", f, ("bodies/p" + std::to_string(k)).c_str(), H5P_DEFAULT,
                         H5P_DEFAULT);
      },
      true);
  add("a thousand groups deep", [](hid_t f) {
    std::string deep = "bodies";
    for (int k = 0; k < 1000; ++k) {
      deep += "/d";
      const Handle group(H5Gcreate2(f, deep.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    }
  });
  for (const int count : {500, 2000})
    add(
        std::to_string(count) + " notes of 4 kB",
        [=](hid_t f) {
          const Handle notes(H5Gopen2(f, "provenance", H5P_DEFAULT));
          const std::string text(4096, 'x');
          for (int k = 0; k < count; ++k) {
            const Handle type = text_type(text.size()), space(H5Screate(H5S_SCALAR));
            const Handle note(
                H5Acreate2(notes, ("n" + std::to_string(k)).c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT));
            H5Awrite(note, type, text.data());
          }
        },
        true);
  add("something more, as a later minor version may hold", [](hid_t f) {
    replace(f, "more", H5T_STD_I32LE, {5});
    replace(f, "bodies/powder/more", H5T_STD_I32LE, {5});
    replace(f, "bodies/powder/curve/more", H5T_STD_I32LE, {5});
  });
  add("a unit the size of a header", [](hid_t f) {
    const Handle set(H5Dopen2(f, "bodies/powder/curve/s_end", H5P_DEFAULT)), space(H5Screate(H5S_SCALAR));
    H5Adelete(set, "unit");
    const Handle unit(H5Acreate2(set, "unit", text_type(60000), space, H5P_DEFAULT, H5P_DEFAULT));
  });
}

void Collector::attribute(const std::string& object, const std::string& name)
{
  const auto instead = [&](const std::string& what, hid_t type, const std::vector<hsize_t>& extents,
                           const std::string& bytes = std::string(64, '\x7f')) {
    const auto kept = std::make_shared<Handle>(H5Tcopy(type));
    add(object + " attribute " + name + ": " + what, [=](hid_t f) {
      const Handle owner(H5Oopen(f, object.c_str(), H5P_DEFAULT));
      H5Adelete(owner, name.c_str());
      const Handle space(extents.empty()
                             ? H5Screate(H5S_SCALAR)
                             : H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr));
      const Handle made(H5Acreate2(owner, name.c_str(), *kept, space, H5P_DEFAULT, H5P_DEFAULT));
      if (made.ok() && !bytes.empty()) H5Awrite(made, *kept, bytes.data());
    });
  };
  add(object + " attribute " + name + ": missing", [=](hid_t f) {
    const Handle owner(H5Oopen(f, object.c_str(), H5P_DEFAULT));
    H5Adelete(owner, name.c_str());
  });
  instead("a float", H5T_IEEE_F64LE, {});
  instead("a byte", H5T_STD_I8LE, {});
  instead("a large number", H5T_STD_U64LE, {}, std::string(8, '\xff'));
  instead("minus one", H5T_STD_I32LE, {}, std::string(4, '\xff'));
  instead("eight numbers", H5T_STD_I64LE, {8});
  instead("no number", H5T_STD_I64LE, {0}, "");
  instead("one number in 32 axes", H5T_STD_I32LE, std::vector<hsize_t>(32, 1));
  instead("text without end", text_type(64), {});
  instead("text with escapes", text_type(12), {}, "\x1b[2J\n\r\t\xff\xfe\x01 ");
  instead("text never written", text_type(64), {}, "");
  instead("two texts", text_type(32), {2});
  instead("text of 64 kB", text_type(65000), {}, std::string(65000, 'a'));
  instead("text of any length", text_type(H5T_VARIABLE), {}, "");
}

}  // namespace

void spoil(hid_t file, const std::vector<const Damage*>& damages)
{
  const Damage* last = nullptr;
  for (const Damage* damage : damages)
    if (!damage->leads_away)
      damage->change(file);
    else if (!last)
      last = damage;
  if (last) last->change(file);
}

std::vector<Damage> hostile_damages(const std::string& folder)
{
  std::vector<Damage> all;
  Collector collect{all, folder};
  std::vector<std::string> sets;
  for (const std::string& name : material) sets.push_back("bodies/powder/material/" + name);
  for (const std::string& name : {std::string("s_end"), std::string("onset")})
    sets.push_back("bodies/powder/curve/" + name);
  for (const std::string& name : certificate) sets.push_back("bodies/powder/certificate/" + name);
  for (const std::string& name : axis) sets.push_back("bodies/powder/inertia_axis/" + name);
  for (const std::string& name : {std::string("pole_radius"), std::string("mass_ratio")})
    sets.push_back("bodies/powder/" + name);
  sets.push_back("pair_reduction_error_force");
  for (const std::string& name : lists) {
    sets.push_back("bodies/powder/curve/" + name);
    sets.push_back("bodies/powder/curve/" + name + "_slope");
    sets.push_back("bodies/glass/curve/" + name);
  }
  for (const std::string& name : pair_sets) sets.push_back(pair_law + "/" + name);
  for (const std::string& path : sets) {
    collect.values(path);
    collect.storage(path);
    collect.entry(path);
  }
  collect.storage("pairs");
  for (const std::string& path :
       {std::string("pairs"), std::string("provenance"), std::string("bodies"), std::string("bodies/glass"),
        std::string("bodies/powder"), std::string("bodies/powder/material"),
        std::string("bodies/powder/curve"), std::string("bodies/powder/certificate"),
        std::string("bodies/powder/inertia_axis"), std::string("pair_laws"), pair_law, pair_law + "/curve",
        pair_law + "/certificate", pair_law + "/inertia_axis"})
    collect.entry(path);
  collect.texts();
  collect.names();
  for (const char* name : {"format", "version_major", "version_minor"}) collect.attribute("/", name);
  collect.attribute("bodies/powder/certificate", "support");
  collect.attribute("bodies/powder/certificate", "origin");
  collect.attribute("bodies/powder/inertia_axis", "kind");
  collect.attribute(pair_law + "/inertia_axis", "kind");
  collect.attribute(pair_law + "/certificate", "support");
  collect.attribute("bodies/powder", "body");
  collect.attribute("provenance", "command");
  return all;
}

}  // namespace granulaw::tests
