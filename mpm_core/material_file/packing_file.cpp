#include "material_file/packing_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/error.hpp"
#include "base/number_in.hpp"
#include "material_file/words.hpp"

namespace granulaw {

namespace {

using Words = std::vector<std::string>;

constexpr const char* formats =
    "lines x y z radius [material] behind a first line # box LX LY LZ, a LIGGGHTS dump, or a LIGGGHTS data "
    "file";

class Reader
{
 public:
  Reader(const std::string& path, const Materials& materials, const Words& by_type)
      : path_(path), in_(path), materials_(materials), by_type_(by_type)
  {
    if (!in_) fail(path, "cannot be read");
  }

  PackingFile read()
  {
    if (!next_line()) fail(path_, in_.bad() ? "cannot be read" : "is empty", {}, formats);
    if (line_.starts_with("ITEM:"))
      read_dump();
    else if (const Words head = words_of(line_); head.size() > 1 && head[0] == "#" && head[1] == "box")
      read_lines();
    else
      read_data();
    if (out_.packing.spheres.empty()) fail(path_, "holds no sphere");
    for (int d = 0; d < 3; ++d) out_.packing.box[d] = high_[d] - low_[d];
    for (Packing::Sphere& s : out_.packing.spheres)
      for (int d = 0; d < 3; ++d) s.centre[d] -= low_[d];
    return std::move(out_);
  }

 private:
  std::string where() const { return fmt::format("{}:{}", path_, number_); }

  bool next_line()
  {
    if (!std::getline(in_, line_)) return false;
    ++number_;
    return true;
  }
  /// The next line that must be there.
  Words line_of(const char* what)
  {
    if (!next_line()) fail(path_, fmt::format("ends before {}", what));
    return words_of(line_);
  }
  double number(const Words& words, std::size_t k, const char* what) const
  {
    if (k >= words.size()) fail(where(), fmt::format("the {} is missing", what));
    const std::optional<double> value = number_in(words[k]);
    if (!value || !std::isfinite(*value))
      fail(where(), fmt::format("the {} is no number", what), cut(words[k]));
    return *value;
  }
  double over_zero(const Words& words, std::size_t k, const char* what) const
  {
    const double value = number(words, k, what);
    if (!(value > 0)) fail(where(), fmt::format("the {} cannot be used", what), words[k], "over 0 (m)");
    return value;
  }

  int material(const std::string& name)
  {
    const auto known = std::find(out_.names.begin(), out_.names.end(), name);
    if (known != out_.names.end()) return static_cast<int>(known - out_.names.begin());
    if (!materials_.materials.contains(name))
      fail_unknown(where(), "no material", name, names_of(materials_.materials));
    out_.names.push_back(name), out_.materials.push_back(materials_.material(name));
    return static_cast<int>(out_.names.size()) - 1;
  }
  int only_material(const char* remedy)
  {
    if (materials_.materials.size() == 1) return material(materials_.materials.begin()->first);
    fail(where(),
         fmt::format("the material is missing: {} has {} ({})", materials_.source,
                     materials_.materials.size(), list_of(names_of(materials_.materials))),
         {}, remedy);
  }
  int material_of_type(double type)
  {
    if (by_type_.empty()) return only_material("--materials NAMES, one for each atom type");
    if (!(type >= 1 && type <= static_cast<double>(by_type_.size())))
      fail(where(), "atom type without a material", fmt::format("{:g}", type),
           fmt::format("1 to {}, as --materials lists", by_type_.size()));
    return material(by_type_[static_cast<std::size_t>(type) - 1]);
  }
  void add(double x, double y, double z, double radius, int material)
  {
    out_.packing.spheres.push_back({{x, y, z}, radius, material});
  }

  void read_lines()
  {
    if (!by_type_.empty()) fail("--materials", "is for the atom types of LIGGGHTS files; a line of " + path_ + " ends with its material");
    const Words head = words_of(line_);
    for (std::size_t d = 0; d < 3; ++d) high_[d] = over_zero(head, 2 + d, "length of the box");
    while (next_line()) {
      const Words words = words_before_comment(line_);
      if (words.empty()) continue;
      if (words.size() > 5)
        fail(where(), "a sphere is x y z radius [material]", fmt::format("{} words", words.size()), "4 or 5");
      const double x = number(words, 0, "x"), y = number(words, 1, "y"), z = number(words, 2, "z");
      const double radius = over_zero(words, 3, "radius");
      add(x, y, z, radius,
          words.size() > 4 ? material(words[4]) : only_material("a fifth word, the name of one"));
    }
  }

  void read_bounds(int d)
  {
    const Words words = line_of("the bounds of the box");
    low_[d] = number(words, 0, "bound of the box"), high_[d] = number(words, 1, "bound of the box");
    if (!(high_[d] > low_[d])) fail(where(), "the box has no volume");
    if (words.size() > 2) fail(where(), "the box is not rectangular");
  }

  /// The last frame of a dump.
  void read_dump()
  {
    do {
      const Words item = words_of(line_);
      if (item.size() > 2 && item[1] == "NUMBER") {
        count_ = number(line_of("the number of atoms"), 0, "number of atoms");
      } else if (item.size() > 2 && item[1] == "BOX") {
        for (int d = 0; d < 3; ++d) read_bounds(d);
      } else if (item.size() > 1 && item[1] == "ATOMS") {
        read_atoms(Words(item.begin() + 2, item.end()));
      }
    } while (next_line());
    if (out_.packing.spheres.empty()) fail(path_, "the dump holds no atom with x y z radius");
  }

  void read_atoms(const Words& columns)
  {
    const auto column = [&](const char* name, bool needed = true) {
      const auto found = std::find(columns.begin(), columns.end(), name);
      if (found == columns.end() && needed)
        fail(where(), fmt::format("the dump has no column {}", name), list_of(columns),
             "dump ... custom ... id type x y z radius");
      return static_cast<std::size_t>(found - columns.begin());
    };
    const std::size_t x = column("x"), y = column("y"), z = column("z"), radius = column("radius"),
                      type = column("type", false);
    out_.packing.spheres.clear();
    for (double k = 0; k < count_; ++k) {
      const Words words = line_of("its last atom");
      const double of_type = type < columns.size() ? number(words, type, "type") : 1;
      add(number(words, x, "x"), number(words, y, "y"), number(words, z, "z"),
          over_zero(words, radius, "radius"), material_of_type(of_type));
    }
  }

  void read_data()
  {
    bool box[3] = {};
    while (next_line()) {
      const Words words = words_before_comment(line_);
      if (words.empty()) continue;
      for (int d = 0; d < 3; ++d) {
        const std::string low = std::string(1, "xyz"[d]) + "lo";
        if (words.size() != 4 || words[2] != low) continue;
        low_[d] = number(words, 0, "bound of the box"), high_[d] = number(words, 1, "bound of the box");
        box[d] = high_[d] > low_[d];
      }
      if (words.size() == 2 && words[1] == "atoms") count_ = number(words, 0, "number of atoms");
      if (words[0] != "Atoms") continue;
      if (!(box[0] && box[1] && box[2]))
        fail(where(), "the box of the data file is missing, or has no volume");
      for (double k = 0; k < count_;) {
        const Words atom = line_of("its last atom");
        if (atom.empty()) continue;
        if (atom.size() < 7)
          fail(where(), "an atom is id type diameter density x y z (atom_style granular)",
               fmt::format("{} words", atom.size()), "7 or more");
        add(number(atom, 4, "x"), number(atom, 5, "y"), number(atom, 6, "z"),
            0.5 * over_zero(atom, 2, "diameter"), material_of_type(number(atom, 1, "type")));
        ++k;
      }
      return;
    }
    fail(path_, "is no packing", {}, formats);
  }

  std::string path_;
  std::ifstream in_;
  const Materials& materials_;
  const Words& by_type_;
  PackingFile out_;
  std::string line_;
  int number_ = 0;
  double count_ = 0;
  std::array<double, 3> low_{}, high_{};
};

}  // namespace

PackingFile read_packing(const std::string& path, const Materials& materials,
                         const std::vector<std::string>& by_type)
{
  return Reader(path, materials, by_type).read();
}

}  // namespace granulaw
