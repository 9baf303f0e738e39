// LIGGGHTS's multisphere file.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hpp"
#include "solver/shape/clump_solid.hpp"

namespace granulaw {

namespace {

/// The ball of one line without its comment.
ClumpBall read_ball(const std::string& line, const std::string& where)
{
  std::istringstream words(line);
  ClumpBall ball{};
  std::string rest;
  if (!(words >> ball.centre[0] >> ball.centre[1] >> ball.centre[2] >> ball.radius) || words >> rest)
    fail(where, "is no sphere of a clump", cut(line), "four numbers: x y z r");
  if (!(ball.radius > 0 && std::isfinite(ball.radius) && ball.centre.allFinite()))
    fail(where, "is no sphere of a clump", cut(line), "finite numbers, and r over 0");
  return ball;
}

}  // namespace

std::vector<ClumpBall> read_clump(const std::string& path, double scale)
{
  std::error_code ignored;
  std::ifstream in(path);
  if (!in || !std::filesystem::is_regular_file(path, ignored)) fail(path, "the clump's file cannot be read");
  std::vector<ClumpBall> balls;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    line.resize(std::min(line.size(), line.find('#')));
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    ClumpBall ball = read_ball(line, fmt::format("{}:{}", path, number));
    ball.centre *= scale;
    ball.radius *= scale;
    balls.push_back(ball);
    if (balls.size() > 10000) fail(path, "the clump has too many spheres", "over 10000");
  }
  return balls;
}

}  // namespace granulaw
