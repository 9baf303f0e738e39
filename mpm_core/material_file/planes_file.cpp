#include "material_file/planes_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "base/error.hpp"
#include "base/number_in.hpp"
#include "material_file/words.hpp"

namespace granulaw {

namespace {

double number(const std::string& word, const std::string& where, const char* what)
{
  const std::optional<double> value = number_in(word);
  if (!value || !std::isfinite(*value)) fail(where, fmt::format("the {} is no number", what), word);
  return *value;
}

PressPlane plane_of(const std::vector<std::string>& words, const std::string& where)
{
  if (words.size() < 3 || words.size() > 6)
    fail(where, "a plane is nx ny nz [distance speed friction]", fmt::format("{} words", words.size()),
         "3 to 6");
  PressPlane plane;
  double length = 0;
  for (int d = 0; d < 3; ++d) {
    plane.direction[d] = number(words[d], where, "direction");
    length += plane.direction[d] * plane.direction[d];
  }
  if (!(length > 0)) fail(where, "the direction has no length");
  if (words.size() > 3 && words[3] != "touch") plane.distance = number(words[3], where, "distance");
  if (words.size() > 4) plane.speed = number(words[4], where, "speed");
  if (words.size() > 5) plane.friction = number(words[5], where, "friction");
  if (!(std::abs(plane.speed) <= 10))
    fail(where, "the speed is out of range", words[4], "-10 to 10, over --depth");
  if (!(plane.friction >= 0 && plane.friction <= 10))
    fail(where, "the friction is out of range", words[5], "0 to 10");
  return plane;
}

}  // namespace

std::vector<PressPlane> read_planes(const std::string& name, const std::string& option)
{
  std::vector<PressPlane> planes = named_planes(name);
  if (!planes.empty()) return planes;
  std::ifstream in(name);
  if (!in)
    fail(option, "no such arrangement, and no such file", name, "pair, cube, die, bcc, fcc, or a file");
  std::string line;
  for (int n = 1; std::getline(in, line); ++n) {
    const std::vector<std::string> words = words_before_comment(line);
    if (!words.empty()) planes.push_back(plane_of(words, fmt::format("{}:{}", name, n)));
  }
  if (planes.empty()) fail(name, "the file names no plane", {}, "lines nx ny nz [distance speed friction]");
  bool moves = false;
  for (const PressPlane& p : planes) moves = moves || p.speed != 0;
  if (!moves) fail(name, "no plane moves: every speed is 0");
  return planes;
}

}  // namespace granulaw
