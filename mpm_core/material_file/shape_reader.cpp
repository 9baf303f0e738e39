#include "material_file/shape_reader.hpp"

#include <filesystem>
#include <limits>

namespace granulaw {

namespace {

std::string with_unit(const std::string& text, const char* unit)
{
  return *unit ? fmt::format("{} {}", text, unit) : text;
}

std::string range_of(const ShapeKey& key)
{
  return with_unit(key.most == std::numeric_limits<double>::max()
                       ? "over 0"
                       : fmt::format("{:g} to {:g}", key.least, key.most),
                   key.unit);
}

std::vector<double> numbers_of(const Section& s, const ShapeKey& key)
{
  const bool list = key.form == ShapeKey::Form::numbers;
  const std::vector<double> values =
      list ? s.numbers(key.name, key.unit) : std::vector{s.number(key.name, key.unit)};
  if (values.size() != key.count)
    fail(s.where(s.node(key.name)), fmt::format("'{}' must hold {}", key.name, key.holds),
         fmt::format("{} numbers", values.size()), fmt::format("{}", key.count));
  for (const double value : values)
    if (!(value >= key.least && value <= key.most)) {
      std::string found;
      for (const double v : values) found += fmt::format("{}{:g}", found.empty() ? "" : ", ", v);
      fail(s.where(s.node(key.name)), fmt::format("'{}' is out of range", key.name),
           with_unit(list ? fmt::format("[{}]", found) : found, key.unit), range_of(key));
    }
  return values;
}

std::vector<double> points_of(const Section& s, const ShapeKey& key)
{
  const auto rows = s.rows(key.name, key.count, "[[0, 0, 0], [1e-3, 0, 0], ...] in m");
  if (!(rows.size() >= key.least && rows.size() <= key.most))
    fail(s.where(s.node(key.name)), fmt::format("'{}' must hold {}", key.name, key.holds),
         fmt::format("{}", rows.size()), fmt::format("{:g} to {:g}", key.least, key.most));
  std::vector<double> values;
  for (const std::vector<double>& row : rows) values.insert(values.end(), row.begin(), row.end());
  return values;
}

std::string path_of(const Section& s, const ShapeKey& key, const std::string& folder)
{
  const std::filesystem::path file(s.text(key.name));
  return file.is_absolute() ? file.string() : (std::filesystem::path(folder) / file).string();
}

ShapeValues values_of(const Section& s, const std::vector<ShapeKey>& keys, const std::string& folder,
                      double radius)
{
  ShapeValues values;
  values.radius = radius;
  values.where = [s](const char* key) { return *key ? s.where(s.node(key)) : s.where(); };
  for (const ShapeKey& key : keys)
    if (key.form == ShapeKey::Form::path)
      values.path = path_of(s, key, folder);
    else if (key.required || s.has(key.name))
      values.numbers[key.name] = key.form == ShapeKey::Form::points ? points_of(s, key) : numbers_of(s, key);
  return values;
}

/// Names of the profiles, or of the shapes in three dimensions.
Words names(bool profiles)
{
  Words found;
  for (const ShapeKind& kind : shape_kinds())
    if ((kind.profile != nullptr) == profiles) found.push_back(kind.name);
  return found;
}

/// {WORD = "NAME", key = value, ...} with the keys that the kind has.
NamedShape read_named(const Section& s, const char* word, bool profile, const std::string& folder,
                      double radius)
{
  const std::string name = s.text(word);
  for (const ShapeKind& kind : shape_kinds()) {
    if (kind.name != name || (kind.profile != nullptr) != profile) continue;
    Words keys{word};
    for (const ShapeKey& key : kind.keys) keys.push_back(key.name);
    s.check_keys(keys);
    return {&kind, values_of(s, kind.keys, folder, radius)};
  }
  fail_unknown(s.where(s.node(word)), profile ? "no shape" : "no kind of shape", name, names(profile),
               profile ? ", or points = [[r, z], ...]" : "");
}

}  // namespace

NamedShape read_shape(const Section& table, const std::string& folder, double radius)
{
  return read_named(table, "kind", false, folder, radius);
}

NamedShape read_profile(const Section& table, double radius)
{
  return read_named(table, "shape", true, {}, radius);
}

std::string names_of_shapes()
{
  return list_of(names(false));
}

}  // namespace granulaw
