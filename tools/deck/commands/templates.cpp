#include "deck/commands/templates.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "deck/commands/reading.hpp"

namespace granulaw::deck {

namespace {

struct Range
{
  double low = 0, high = 0;
};

/// `KEYWORD constant X`, `uniform LOW HIGH` or `gaussian MEAN SIGMA`, the latter to three sigma.
Range range(const Words& words, const char* keyword)
{
  auto w = words.after(keyword);
  if (!w) return {};
  if (w->take("constant")) {
    const double value = w->value();
    return {value, value};
  }
  if (w->take("uniform")) {
    const double low = w->value(), high = w->value();
    return {low, high};
  }
  if (w->take("gaussian")) {
    if (!w->take("number")) w->take("mass");
    const double mean = w->value(), sigma = w->value();
    return {std::max(0.1 * mean, mean - 3 * sigma), mean + 3 * sigma};
  }
  misread(fmt::format("the {} '{}' is not understood", keyword, w->peek()));
}

}  // namespace

double Template::mean_volume() const
{
  return ball_volume(0.5 * (radius_min + radius_max));
}

void follow_template(Reading& reading, const Fix& fix, Words w)
{
  if (fix.style != "particletemplate/sphere")
    reading.scene.unknown_particles.push_back(
        fmt::format("{}: {}: only spheres are understood", w.where(), fix.style));
  Template t;
  if (auto type = w.after("atom_type")) t.type = type->atom_type();
  const Range radius = range(w, "radius"), density = range(w, "density");
  if (radius.low < 0 || radius.high < 0 || density.high < 0) misread("radius and density must be positive");
  t.radius_min = radius.low;
  t.radius_max = radius.high;
  t.density = density.high;
  reading.templates.put(fix.id, t);
}

void follow_distribution(Reading& reading, const Fix& fix, Words w)
{
  w.value();  // seed
  Distribution distribution;
  for (std::size_t n = w.count(); n > 0; --n) {
    const std::string part = w.word();
    distribution.parts.emplace_back(part, w.value());
  }
  reading.distributions.put(fix.id, distribution);
}

}  // namespace granulaw::deck
