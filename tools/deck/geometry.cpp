#include "deck/geometry.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hpp"

namespace granulaw::deck {

void Box::include(const Vec3& p)
{
  for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
}

void Box::include(const Box& other)
{
  if (other.empty()) return;
  include(other.low);
  include(other.high);
}

Box Box::within(const Box& other) const
{
  Box result = *this;
  for (std::size_t k = 0; k < 3; ++k) {
    result.low[k] = std::max(low[k], other.low[k]);
    result.high[k] = std::min(high[k], other.high[k]);
  }
  return result;
}

double Box::volume() const
{
  return empty() ? 0.0 : size()[0] * size()[1] * size()[2];
}

std::array<Vec3, 8> Box::corners() const
{
  std::array<Vec3, 8> result;
  for (std::size_t c = 0; c < 8; ++c)
    for (std::size_t k = 0; k < 3; ++k) result[c][k] = (c >> k & 1) != 0 ? high[k] : low[k];
  return result;
}

double Box::top(const Vec3& axis) const
{
  double sum = 0;  // side by side: 0 times an infinite side is 0
  for (std::size_t k = 0; k < 3; ++k)
    if (axis[k] != 0) sum += axis[k] * (axis[k] > 0 ? high[k] : low[k]);
  return sum;
}

double Box::bottom(const Vec3& axis) const
{
  return -top(-1.0 * axis);
}

Vec3 rotated(const Vec3& p, const Vec3& axis, double degrees)
{
  const double length = norm(axis);
  if (length == 0) return p;
  const Vec3 k = 1 / length * axis;
  const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
  const Vec3 cross{k[1] * p[2] - k[2] * p[1], k[2] * p[0] - k[0] * p[2], k[0] * p[1] - k[1] * p[0]};
  return c * p + s * cross + dot(k, p) * (1 - c) * k;  // Rodrigues
}

std::vector<Vec3> mesh_vertices(const std::string& path)
{
  std::error_code ignored;
  std::ifstream in(path, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(path, ignored)) fail(path, "the mesh cannot be read");
  if (std::filesystem::file_size(path, ignored) > 512u << 20)
    fail(path, "the mesh is too large", "over 512 MB");
  std::ostringstream all;
  all << in.rdbuf();
  const std::string text = all.str();

  std::vector<Vec3> vertices;
  const auto keep = [&](const Vec3& p) {
    if (!std::isfinite(p[0] + p[1] + p[2])) fail(path, "a vertex of the mesh is not finite");
    vertices.push_back(p);
  };
  // A binary STL says how long it is; one that begins with "solid" is told from text only by that.
  std::uint32_t count = 0;
  if (text.size() >= 84) std::memcpy(&count, text.data() + 80, 4);
  if (text.size() >= 84 && text.size() == 84 + 50 * static_cast<std::size_t>(count)) {
    for (std::size_t t = 0; t < count; ++t) {
      float corner[9];
      std::memcpy(corner, text.data() + 84 + 50 * t + 12, sizeof corner);
      for (int v = 0; v < 3; ++v) keep({corner[3 * v], corner[3 * v + 1], corner[3 * v + 2]});
    }
  } else {
    std::istringstream words(text);
    std::string word;
    while (words >> word) {
      if (word == "vertex") {
        Vec3 p;
        if (!(words >> p[0] >> p[1] >> p[2]))
          fail(path, "the mesh is damaged: three numbers must follow 'vertex'");
        keep(p);
      } else if (word == "POINTS") {
        std::size_t n = 0;
        words >> n >> word;
        Vec3 p;
        for (std::size_t k = 0; k < n && words >> p[0] >> p[1] >> p[2]; ++k) keep(p);
        break;
      }
    }
  }
  if (vertices.empty()) fail(path, "is no mesh", "no vertices", "STL (text or binary), VTK (text)");
  return vertices;
}

}  // namespace granulaw::deck
