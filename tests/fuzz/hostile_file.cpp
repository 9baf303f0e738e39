#include "hostile_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "law/h5.hpp"

namespace granulaw::tests {

namespace {

using h5::Handle;
using Values = std::vector<double>;
using Extents = std::vector<hsize_t>;

const std::string pair_law = "pair_laws/powder:glass";

std::string parent_of(const std::string& path)
{
  return path.substr(0, path.rfind('/') + 1) + ".";
}

Handle space_of(const Extents& extents)
{
  return Handle(extents.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr));
}

/// A dataset's values; {1} where another damage left nothing that could be read.
Values read(hid_t file, const std::string& path)
{
  const Handle set(H5Dopen2(file, path.c_str(), H5P_DEFAULT));
  if (!set.ok()) return {1.0};
  const Handle space(H5Dget_space(set)), type(H5Dget_type(set)), list(H5Dget_create_plist(set));
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count < 1 || count > 65536 || H5Tget_class(type) != H5T_FLOAT || H5Pget_layout(list) != H5D_CONTIGUOUS || H5Pget_external_count(list) != 0) return {1.0};
  Values values(static_cast<std::size_t>(count));
  H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  return values;
}

void overwrite(hid_t file, const std::string& path, const std::function<void(Values&)>& change)
{
  Values values = read(file, path);
  change(values);
  const Handle set(H5Dopen2(file, path.c_str(), H5P_DEFAULT)), space(set.ok() ? H5Dget_space(set) : -1);
  if (space.ok() && H5Sget_simple_extent_npoints(space) == static_cast<hssize_t>(values.size()))
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
}

/// Puts a dataset of `type` and `extents` (none: a scalar) in place of `path`; `values` may be nothing.
void replace(hid_t file, const std::string& path, hid_t type, const Extents& extents, const double* values = nullptr, hid_t list = H5P_DEFAULT)
{
  H5Ldelete(file, path.c_str(), H5P_DEFAULT);
  const Handle set(H5Dcreate2(file, path.c_str(), type, space_of(extents), H5P_DEFAULT, list, H5P_DEFAULT));
  if (set.ok() && values) H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
}

Handle creation(const std::function<void(hid_t)>& set)
{
  Handle list(H5Pcreate(H5P_DATASET_CREATE));
  set(list);
  return list;
}

Handle text_type(std::size_t size)
{
  Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, size);
  return type;
}

void hard_link(hid_t file, const std::string& to, const std::string& at)
{
  H5Lcreate_hard(file, to.c_str(), file, at.c_str(), H5P_DEFAULT, H5P_DEFAULT);
}

using NamedType = std::pair<std::string, std::function<Handle()>>;
std::vector<NamedType> types()
{
  const auto copy = [](hid_t type, const std::function<void(hid_t)>& change = [](hid_t) {}) {
    return [=] {
      Handle made(H5Tcopy(type));
      change(made);
      return made;
    };
  };
  const hsize_t million = 1 << 20;
  return {
      {"32-bit integers", copy(H5T_STD_I32LE)},
      {"bytes", copy(H5T_STD_U8BE)},
      {"bits", copy(H5T_STD_B64LE)},
      {"references", copy(H5T_STD_REF_OBJ)},
      {"floats of 4 bytes", copy(H5T_IEEE_F32BE)},
      {"floats of 200 bytes", copy(H5T_IEEE_F64LE, [](hid_t t) { H5Tset_size(t, 200); })},
      {"floats with one bit of mantissa", copy(H5T_IEEE_F64LE, [](hid_t t) { H5Tset_fields(t, 63, 52, 11, 0, 1); })},
      {"text of one byte", [] { return text_type(1); }},
      {"text of a megabyte", [] { return text_type(1 << 20); }},
      {"text of any length", [] { return text_type(H5T_VARIABLE); }},
      {"opaque", [] { return Handle(H5Tcreate(H5T_OPAQUE, 8)); }},
      {"pairs of numbers",
       [] {
         Handle type(H5Tcreate(H5T_COMPOUND, 16));
         H5Tinsert(type, "a", 0, H5T_IEEE_F64LE), H5Tinsert(type, "b", 8, H5T_IEEE_F64LE);
         return type;
       }},
      {"names", [] { return Handle(H5Tenum_create(H5T_NATIVE_INT)); }},
      {"arrays", [=] { return Handle(H5Tarray_create2(H5T_IEEE_F64LE, 1, &million)); }},
      {"lists of any length", [] { return Handle(H5Tvlen_create(H5T_IEEE_F64LE)); }},
  };
}

struct Collector
{
  std::vector<Damage>& all;
  std::string folder;
  std::set<std::string> met{};  // "curve/force", "curve list": those of a body and of a pair's law are read by the same functions

  void add(std::string name, std::function<void(hid_t)> change, bool big = false, bool leads_away = false)
  {
    all.push_back({std::move(name), std::move(change), big, leads_away});
  }
  void values(const std::string& path, bool scalar);
  void storage(const std::string& path);
  void entry(const std::string& path);
  void texts();
  void names();
  void attribute(const std::string& object, const std::string& name);
  void everything(hid_t file, const std::string& group);
};

/// Numbers that are no law's.
void Collector::values(const std::string& path, bool scalar)
{
  const auto change = [&](const std::string& what, const std::function<void(Values&)>& of) {
    add(path + ": " + what, [=](hid_t f) { overwrite(f, path, of); });
  };
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, -1.0, 0.0, -0.0, 1e308, -1e308, 5e-324, 1e12, 0.5}) {
    change(fmt::format("every value {:g}", bad), [=](Values& v) { v.assign(v.size(), bad); });
    if (scalar) continue;
    change(fmt::format("the first value {:g}", bad), [=](Values& v) { v.front() = bad; });
    change(fmt::format("the middle value {:g}", bad), [=](Values& v) { v[v.size() / 2] = bad; });
  }
  if (scalar) return;
  change("reversed", [](Values& v) { v = {v.rbegin(), v.rend()}; });
  change("rotated", [](Values& v) { std::rotate(v.begin(), v.begin() + v.size() / 3, v.end()); });
  change("alternating signs", [](Values& v) {
    for (std::size_t k = 1; k < v.size(); k += 2) v[k] = -v[k];
  });
}

/// Types, ranks, extents and storage that are not the format's.
void Collector::storage(const std::string& path)
{
  for (const auto& [name, make] : types())
    add(path + ": " + name, [=, make = make](hid_t f) { replace(f, path, make(), {read(f, path).size()}); });
  for (const hsize_t extent : {hsize_t{0}, hsize_t{1}, hsize_t{2}, hsize_t{3}, hsize_t{128}, hsize_t{65536}, hsize_t{65537}, hsize_t{1} << 40})
    for (const bool chunked : {false, true})
      // no storage until written: a file of some kB can declare terabytes; a chunk of 2 GiB is read into memory as a whole
      add(fmt::format("{}: {} extent {}", path, chunked ? "chunked" : "declared", extent), [=](hid_t f) {
        replace(f, path, H5T_IEEE_F64LE, {extent}, nullptr, creation([=](hid_t list) {
                  const double fill = 1.5;
                  const hsize_t chunk = (hsize_t{1} << 28) - 1;
                  H5Pset_fill_value(list, H5T_NATIVE_DOUBLE, &fill);
                  if (chunked) H5Pset_chunk(list, 1, &chunk);
                }));
      });
  add(path + ": scalar", [=](hid_t f) { replace(f, path, H5T_IEEE_F64LE, {}, read(f, path).data()); });
  add(path + ": a column", [=](hid_t f) {
    const Values v = read(f, path);
    replace(f, path, H5T_IEEE_F64LE, {v.size(), 1}, v.data());
  });
  add(path + ": rank 32", [=](hid_t f) { replace(f, path, H5T_IEEE_F64LE, Extents(32, 1)); });
  add(path + ": rank 32, 2^62 values", [=](hid_t f) {
    Extents extents(32, 4);
    extents[0] = 1;
    replace(f, path, H5T_IEEE_F64LE, extents, nullptr, creation([](hid_t list) { H5Pset_chunk(list, 32, Extents(32, 1).data()); }));
  });
  add(path + ": no extent", [=](hid_t f) {
    H5Ldelete(f, path.c_str(), H5P_DEFAULT);
    const Handle space(H5Screate(H5S_NULL)), set(H5Dcreate2(f, path.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  });
  const std::pair<const char*, std::function<void(hid_t)>> filters[] = {{"chunks with a checksum", [](hid_t list) { H5Pset_fletcher32(list); }},
                                                                        {"compressed", [](hid_t list) { H5Pset_deflate(list, 9); }},
                                                                        {"a filter that nobody has", [](hid_t list) { H5Pset_filter(list, 300, 0, 0, nullptr); }}};
  for (const auto& [name, filter] : filters)
    add(path + ": " + name, [=, filter = filter](hid_t f) {
      const H5Z_class2_t nothing = {H5Z_CLASS_T_VERS, 300, 1, 1, "none", nullptr, nullptr,
                                    [](unsigned, std::size_t, const unsigned*, std::size_t size, std::size_t*, void**) { return size; }};
      H5Zregister(&nothing);
      const Values v = read(f, path);
      const hsize_t chunk = v.size();
      replace(f, path, H5T_IEEE_F64LE, {chunk}, v.data(), creation([&](hid_t list) { H5Pset_chunk(list, 1, &chunk), filter(list); }));
      H5Fflush(f, H5F_SCOPE_LOCAL);
      H5Zunregister(300);
    });
  for (const std::string elsewhere : {"/dev/zero", "/none", "other.h5", "fifo"}) {
    const std::string name = elsewhere[0] == '/' ? elsewhere : folder + "/" + elsewhere;
    add(path + ": values stored in " + elsewhere, [=](hid_t f) {
      const hsize_t count = read(f, path).size();
      replace(f, path, H5T_IEEE_F64LE, {count}, nullptr, creation([&](hid_t list) { H5Pset_external(list, name.c_str(), 0, 8 * count); }));
    }, false, true);
    if (elsewhere[0] == '/') continue;
    add(path + ": virtual, of " + elsewhere, [=](hid_t f) {
      const hsize_t count = read(f, path).size();
      const Handle space = space_of({count});
      replace(f, path, H5T_IEEE_F64LE, {count}, nullptr, creation([&](hid_t list) { H5Pset_virtual(list, space, name.c_str(), path.c_str(), space); }));
    }, false, true);
  }
}

/// Objects that can stand in place of any dataset or group.
void Collector::entry(const std::string& path)
{
  const auto instead = [&](const std::string& name, std::function<void(hid_t, const char*)> make, bool leads_away = false) {
    add(path + ": " + name, [=](hid_t f) {
      H5Ldelete(f, path.c_str(), H5P_DEFAULT);
      make(f, path.c_str());
    }, false, leads_away);
  };
  const auto soft = [](const std::string& to) { return [=](hid_t f, const char* at) { H5Lcreate_soft(to.c_str(), f, at, H5P_DEFAULT, H5P_DEFAULT); }; };
  instead("missing", [](hid_t, const char*) {});
  instead("a group", [](hid_t f, const char* at) { const Handle group(H5Gcreate2(f, at, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)); });
  instead("a number", [](hid_t f, const char* at) { replace(f, at, H5T_IEEE_F64LE, {}); });
  instead("a type", [](hid_t f, const char* at) {
    const Handle type(H5Tcopy(H5T_IEEE_F64LE));
    H5Tcommit2(f, at, type, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  });
  instead("the root", [](hid_t f, const char* at) { hard_link(f, "/", at); });
  instead("its parent", [](hid_t f, const char* at) { hard_link(f, parent_of(at), at); });
  instead("a link to itself", soft(path));
  instead("links in a circle", [=](hid_t f, const char* at) { soft("/there")(f, at), soft(path)(f, "/there"); });
  instead("a link to nothing", soft("/none"));
  for (const std::string elsewhere : {"other.h5", "fifo", "none.h5"})
    instead("a link into " + elsewhere, [name = folder + "/" + elsewhere](hid_t f, const char* at) { H5Lcreate_external(name.c_str(), at, f, at, H5P_DEFAULT, H5P_DEFAULT); }, true);
  add(path + ": a link to where it moved", [=](hid_t f) {
    H5Lmove(f, path.c_str(), f, "/moved", H5P_DEFAULT, H5P_DEFAULT);
    soft("/moved")(f, path.c_str());
  });
}

void Collector::texts()
{
  const auto write = [&](const std::string& name, const std::vector<std::string>& texts, bool big = false) {
    add("pairs: " + name, [=](hid_t f) {
      H5Ldelete(f, "pairs", H5P_DEFAULT);
      if (!h5::has_link(f, "pairs")) h5::write_texts(f, "pairs", texts, "hostile");
    }, big);
  };
  const std::string long_name(60000, 'a');
  for (const std::string& text : {std::string(), std::string(":"), std::string("powder"), std::string("powder:"), std::string(":powder"), std::string("powder:powder:wall"),
                                  std::string("none:wall"), std::string("wall:wall"), std::string("powder:wall\n"), std::string("\x1b[31m:wall"),
                                  std::string("\xff\xfe:wall"), long_name, long_name + ":wall"})
    write(fmt::format("'{:.10}'", text), {text});
  write("none", {});
  write("one twice", {"powder:wall", "powder:wall"});
  write("70000", std::vector<std::string>(70000, "powder:wall"), true);
  add("pairs: 65536 of 1 kB", [=](hid_t f) { replace(f, "pairs", text_type(1024), {65536}); });  // declared: 64 MB
}

void Collector::names()
{
  for (const std::string& name : {std::string("wall"), std::string("two\nlines"), std::string("\x1b[2J"), std::string("a:b"), std::string("..."), std::string("\xff\xfe"),
                                  std::string(255, 'n'), std::string(60000, 'n')}) {
    add("a body named " + name.substr(0, 9), [=](hid_t f) { hard_link(f, "bodies/powder", "bodies/" + name); });
    add("a note named " + name.substr(0, 9), [=](hid_t f) {
      const Handle notes(H5Gopen2(f, "provenance", H5P_DEFAULT)), type = text_type(4), note(H5Acreate2(notes, name.c_str(), type, space_of({}), H5P_DEFAULT, H5P_DEFAULT));
      if (note.ok()) H5Awrite(note, type, "a\nb");
    });
  }
  for (const std::string& name : {std::string("glass:powder"), std::string("powder:wall"), std::string("wall:wall"), std::string("powder:powder"), std::string("powder:none"),
                                  std::string("powder"), std::string(":"), std::string("powder:glass:wall"), std::string("\x1b[2J:\n"), std::string(60000, 'n')}) {
    add("a pair law renamed " + name.substr(0, 20), [=](hid_t f) { H5Lmove(f, pair_law.c_str(), f, ("pair_laws/" + name).c_str(), H5P_DEFAULT, H5P_DEFAULT); });
    add("a second pair law named " + name.substr(0, 20), [=](hid_t f) { hard_link(f, pair_law, "pair_laws/" + name); });
  }
  for (const std::string part : {"", "/velocity_axis"})
    add("the pair law" + part + " is a body's", [=](hid_t f) {
      H5Ldelete(f, (pair_law + part).c_str(), H5P_DEFAULT);
      hard_link(f, "bodies/powder" + part, pair_law + part);
    });
  add("300 pair laws", [](hid_t f) {
    for (int k = 0; k < 300; ++k) hard_link(f, pair_law, fmt::format("pair_laws/p{}:glass", k));
  });
  for (const int count : {200, 300, 3000})
    add(std::to_string(count) + " bodies", [=](hid_t f) {
      for (int k = 0; k < count; ++k) hard_link(f, "bodies/powder", fmt::format("bodies/p{}", k));
    });
  add("200 bodies of 65536 nodes", [](hid_t f) {
    // hard links to one body: 5 MB in the file, 1 GB in a trusting reader's memory
    for (const char* column : {"force", "radius", "kept", "span", "hertz_share"})
      for (const char* suffix : {"", "_slope"}) replace(f, fmt::format("bodies/powder/curve/{}{}", column, suffix), H5T_IEEE_F64LE, {65536}, Values(65536, *suffix ? 0.0 : 0.5).data());
    for (int k = 0; k < 200; ++k) hard_link(f, "bodies/powder", fmt::format("bodies/p{}", k));
  }, true);
  add("a thousand groups deep", [](hid_t f) {
    std::string deep = "bodies";
    for (int k = 0; k < 1000; ++k) const Handle group(H5Gcreate2(f, (deep += "/d").c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  });
  for (const int count : {500, 2000})
    add(std::to_string(count) + " notes of 4 kB", [=](hid_t f) {
      const Handle notes(H5Gopen2(f, "provenance", H5P_DEFAULT));
      for (int k = 0; k < count; ++k) h5::write_text_attribute(notes, fmt::format("n{}", k).c_str(), std::string(4096, 'x'), "hostile");
    }, true);
  add("something more, as a later minor version may hold", [](hid_t f) {
    for (const char* at : {"more", "bodies/powder/more", "bodies/powder/curve/more"}) replace(f, at, H5T_STD_I32LE, {5});
  });
  add("a unit the size of a header", [](hid_t f) {
    const Handle set(H5Dopen2(f, "bodies/powder/curve/end", H5P_DEFAULT));
    H5Adelete(set, "unit");
    const Handle unit(H5Acreate2(set, "unit", text_type(60000), space_of({}), H5P_DEFAULT, H5P_DEFAULT));
  });
}

void Collector::attribute(const std::string& object, const std::string& name)
{
  const auto instead = [&](const std::string& what, hid_t type, const Extents& extents, const std::string& bytes = std::string(64, '\x7f')) {
    const auto kept = std::make_shared<Handle>(type < 0 ? -1 : H5Tcopy(type));
    add(object + " attribute " + name + ": " + what, [=](hid_t f) {
      const Handle owner(H5Oopen(f, object.c_str(), H5P_DEFAULT));
      H5Adelete(owner, name.c_str());
      if (!kept->ok()) return;
      const Handle made(H5Acreate2(owner, name.c_str(), *kept, space_of(extents), H5P_DEFAULT, H5P_DEFAULT));
      if (made.ok() && !bytes.empty()) H5Awrite(made, *kept, bytes.data());
    });
  };
  instead("missing", -1, {});
  instead("a float", H5T_IEEE_F64LE, {});
  instead("a byte", H5T_STD_I8LE, {});
  instead("a large number", H5T_STD_U64LE, {}, std::string(8, '\xff'));
  instead("minus one", H5T_STD_I32LE, {}, std::string(4, '\xff'));
  instead("eight numbers", H5T_STD_I64LE, {8});
  instead("no number", H5T_STD_I64LE, {0}, "");
  instead("one number in 32 axes", H5T_STD_I32LE, Extents(32, 1));
  instead("text without end", text_type(64), {});
  instead("text with escapes", text_type(12), {}, "\x1b[2J\n\r\t\xff\xfe\x01 ");
  instead("text never written", text_type(64), {}, "");
  instead("two texts", text_type(32), {2});
  instead("text of 64 kB", text_type(65000), {}, std::string(65000, 'a'));
  instead("text of any length", text_type(H5T_VARIABLE), {}, "");
}

/// Damages of all that a group of the good file holds. Storage and entries of datasets: of a number and of a list of each kind of
/// group, as the same two functions read all of them.
void Collector::everything(hid_t file, const std::string& group)
{
  const Handle here(H5Oopen(file, ("/" + group).c_str(), H5P_DEFAULT));
  for (const std::string& name : h5::attribute_names(here, 100, "hostile")) attribute(group.empty() ? "/" : group, name);
  const std::string kind = group.substr(group.rfind('/') + 1);
  for (const std::string& name : h5::link_names(here, 100, "hostile")) {
    const std::string path = group.empty() ? name : group + "/" + name;
    const Handle object(H5Oopen(file, path.c_str(), H5P_DEFAULT));
    if (H5Iget_type(object) == H5I_GROUP) {
      entry(path);
      everything(file, path);
    } else {
      const bool scalar = Handle(H5Dget_space(object)).ok() && H5Sget_simple_extent_ndims(Handle(H5Dget_space(object))) == 0;
      if (path != "pairs" && met.insert(kind + "/" + name).second) values(path, scalar);
      if (met.insert(kind + (scalar ? " number" : " list")).second || path == "pairs") storage(path), entry(path);
    }
  }
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
  collect.everything(Handle(H5Fopen((folder + "/other.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)), "");
  collect.texts();
  collect.names();
  return all;
}

}  // namespace granulaw::tests
