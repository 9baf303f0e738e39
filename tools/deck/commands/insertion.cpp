#include "deck/commands/insertion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "deck/commands/particles.hpp"
#include "deck/commands/reading.hpp"

namespace granulaw::deck {

namespace {

/// The words of the command. Where a number is 0 they do not say it.
struct Request
{
  std::string distribution;
  Region place;
  double speed = 0;
  double number = 0, mass = 0;            // in all
  double number_rate = 0, mass_rate = 0;  // in a unit of time
  // insert/pack fills the region up to these, again at every insertion
  double number_in_region = 0, mass_in_region = 0, solid_fraction = 0;
  double every = 0;  // steps; 0: once
};

/// `vel constant X Y Z`, `uniform` or `gaussian MEAN... SPREAD...`: the largest speed, gaussian to three
/// sigma.
double largest_speed(Words& w)
{
  if (w.take("constant")) return norm(w.vector());
  const bool gaussian = w.take("gaussian");
  if (!gaussian && !w.take("uniform")) return 0;
  const Vec3 mean = w.vector(), spread = w.vector();
  Vec3 most;
  for (std::size_t k = 0; k < 3; ++k) most[k] = std::abs(mean[k]) + (gaussian ? 3 : 1) * std::abs(spread[k]);
  return norm(most);
}

/// A number, or INF: 0.
double amount(Words& w)
{
  return w.take("INF") ? 0 : w.value();
}

Request request(const Reading& reading, Words w)
{
  Request r;
  while (w.more()) {
    const std::string& word = w.word();
    if (word == "distributiontemplate")
      r.distribution = w.word();
    else if (word == "vel")
      r.speed = largest_speed(w);
    else if (word == "region")
      r.place = reading.regions.at(w.word());
    else if (word == "insertion_face")
      r.place.box = reading.meshes.at(w.word()).box;
    else if (word == "nparticles")
      r.number = amount(w);
    else if (word == "mass")
      r.mass = amount(w);
    else if (word == "particlerate" || word == "nflowrate")
      r.number_rate = w.value();
    else if (word == "massrate" || word == "massflowrate")
      r.mass_rate = w.value();
    else if (word == "particles_in_region")
      r.number_in_region = w.value();
    else if (word == "mass_in_region")
      r.mass_in_region = w.value();
    else if (word == "volumefraction_region")
      r.solid_fraction = w.value();
    else if (word == "insert_every")
      r.every = w.take("once") ? 0 : w.value();
  }
  return r;
}

/// The templates of a distribution, and the share of each in the number of particles.
struct Mixture
{
  std::vector<Template> templates;
  std::vector<double> shares;
  double mean_volume = 0, mean_mass = 0;  // of a particle
};

/// The weights of a distribution are shares of mass, LIGGGHTS's default.
Mixture mixture(const Reading& reading, const Distribution& distribution)
{
  Mixture m;
  double sum = 0;
  for (const auto& [id, weight] : distribution.parts) {
    const Template& t = reading.templates.at(id);
    const double mass = t.mean_volume() * t.density;
    const double share = distribution.parts.size() == 1 ? 1 : mass > 0 ? weight / mass : 0;
    m.templates.push_back(t);
    m.shares.push_back(share);
    sum += share;
  }
  for (std::size_t k = 0; k < m.templates.size(); ++k) {
    const Template& t = m.templates[k];
    double& share = m.shares[k];
    share = sum > 0 ? share / sum : 1 / static_cast<double>(m.shares.size());
    m.mean_volume += share * t.mean_volume();
    m.mean_mass += share * t.mean_volume() * t.density;
  }
  return m;
}

Insertion insertion_of(const Request& r, const Mixture& m)
{
  Insertion in;
  in.shares = m.shares;
  in.every = r.every;
  in.total = r.number;
  in.rate = r.number_rate;
  in.each = r.number_in_region;
  if (m.mean_mass > 0) {
    if (r.mass > 0) in.total = r.mass / m.mean_mass;
    if (r.mass_rate > 0) in.rate = r.mass_rate / m.mean_mass;
    if (r.mass_in_region > 0) in.each = r.mass_in_region / m.mean_mass;
  }
  if (r.solid_fraction > 0 && m.mean_volume > 0) in.each = r.solid_fraction * r.place.volume / m.mean_volume;
  if (in.each > 0 && in.every == 0) in.total = in.each;
  return in;
}

void add_sources(Reading& reading, const std::string& where, const Request& r, const Mixture& m,
                 Insertion& insertion)
{
  for (const Template& t : m.templates) {
    Source s;
    s.where = where;
    s.type = t.type;
    s.radius_min = t.radius_min;
    s.radius_max = t.radius_max;
    s.density = t.density;
    s.centres = r.place.box;
    s.speed = r.speed;
    insertion.sources.push_back(reading.scene.sources.size());
    reading.scene.sources.push_back(s);
  }
}

/// How many particles a run adds.
double added_by(const Insertion& in, double steps, double duration)
{
  double number = in.total > 0 ? in.total - in.inserted : Box::infinity;
  if (in.rate > 0) {
    number = std::min(number, in.rate * duration);
  } else if (in.each > 0) {
    const double times = in.every > 0 ? std::floor(steps / in.every) + 1 : 1;
    number = std::min(number, in.each * times);
  }
  return std::isfinite(number) ? number : 0;
}

void insert(Reading& reading, const Fix& fix, const Words& w)
{
  const Request r = request(reading, w);
  const Mixture m = mixture(reading, reading.distributions.at(r.distribution));
  Insertion insertion = insertion_of(r, m);
  add_sources(reading, w.where(), r, m, insertion);
  if (insertion.total == 0 && insertion.rate == 0 && insertion.each == 0)
    reading.scene.unknown_particles.push_back(
        fmt::format("{}: {}: how many particles is not understood", w.where(), fix.style));
  reading.insertions.put(fix.id, insertion);
}

}  // namespace

void follow_insertion(Reading& reading, const Fix& fix, Words w)
{
  bring_particles(reading, w, [&] { insert(reading, fix, w); });
}

void insert_particles(Reading& reading, double steps, double duration)
{
  for (auto& [id, insertion] : reading.insertions) {
    const double number = added_by(insertion, steps, duration);
    insertion.inserted += number;
    for (std::size_t k = 0; k < insertion.sources.size(); ++k)
      reading.scene.sources[insertion.sources[k]].count += number * insertion.shares[k];
  }
}

}  // namespace granulaw::deck
