#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "deck/scene.hpp"
#include "law/law.hpp"

namespace granulaw::deck {

/// Two bodies of the scene that may touch: type `a`, of particles, and type `b`, of particles or a wall.
struct Meeting
{
  int a = 1, b = 1;
  bool wall = false;           ///< b is a wall
  bool deformable = false;     ///< ... whose material gives way; else it is rigid for the normal law
  std::string name_a, name_b;  ///< of the materials; of a rigid wall "wall"
  LawMaterial yields;          ///< the body that yields (the weaker), or the softer of two elastic ones
  PairMapping mapping;
  bool known_yield = false;  ///< whether the yield stress is known, be it infinite

  /// Density, kg/m^3, of the sphere of radius lambda R* and mass lambda m* that stands for the pair on a
  /// rigid wall: its damage number and its V_y are the pair's (law/pair.hpp).
  double one_body_density(double r_eff, double m_eff) const;
};

/// A collision as a law computes it.
struct Collision
{
  double depth = 0;        ///< largest overlap/(lambda R*)
  double restitution = 1;  ///< e
};
/// The collision of two bodies at the relative speed `speed` (m/s); empty: no law at hand.
using Collide =
    std::function<std::optional<Collision>(const Meeting&, double r_eff, double m_eff, double speed)>;

/// What the deck does not say, or says otherwise; SI units.
struct PlanOptions
{
  std::optional<double> drop_height;                      ///< m, of every particle to the lowest wall
  std::optional<double> radius_min, radius_max, density;  ///< of particles whose own are not known
  std::optional<double> speed;                            ///< m/s, largest approach speed of any contact
  std::optional<double> particles;                        ///< number, for the cost
  double rate = 2e6;                                      ///< particle-steps a second
  std::map<int, LawMaterial> materials;                   ///< by atom type, where a name is known for it
  Collide collide;
};

/// What a run visited (JSON of fix granulaw/stats).
struct Visited
{
  struct Range
  {
    double speed = 0, overlap = 0, damage_number = 0;  ///< m/s; over R*; rho V^2/Y
    bool met = false;
  };
  std::string path;
  std::optional<Range> pair, wall;
  std::map<std::pair<int, int>, Range> pairs, walls;  ///< by types, the particle's first; pairs: a <= b
};

/// Reads as much as the file holds. Throws Error.
Visited read_visited(const std::string& path);
/// By this much may a run like the visited one exceed it: seeds and ranks shuffle the single fastest impact.
inline constexpr double visited_margin = 1.25;

/// What one pair of the scene needs.
struct PairPlan
{
  Meeting meeting;
  double speed = 0;           ///< m/s, largest approach speed
  std::string speed_basis;    ///< "fall", "shielded fall" (deck/shielding.hpp), "given" or "visited"
  double onset = 0;           ///< m/s, where yield begins, the least over the sizes; infinity: never
  double yield_velocity = 0;  ///< m/s, customary V_y, the least over the sizes; infinity: elastic
  double damage_number = 0;   ///< largest I = rho V^2/Y of the pair's one body
  double overlap = 0;         ///< largest, over R*, of the real contact: the deck's over its stretch
  double depth = 0;           ///< largest, over lambda R*: the table's own coordinate
  std::string overlap_basis;  ///< "law", "Hertz" or "visited"
  double contact_time = 0;    ///< s, shortest: Hertz at the largest speed, smallest particles
  bool needs_table = false;   ///< it yields; false: Hertz suffices
  bool visited = true;        ///< false: a run did not meet it
};

/// A thing the deck does not tell, and the option that does.
struct Question
{
  std::string what, option;
};

struct Plan
{
  std::vector<PairPlan> pairs;
  std::vector<Question> questions;
  double fall = 0;                        ///< m, largest height a particle may fall
  double radius_min = 0, radius_max = 0;  ///< m
  double mass_min = 0, mass_max = 0;      ///< kg
  double time_step = 0;  ///< s, that resolves the shortest contact, stretched as the deck says
  double particle_steps = 0, hours = 0;
  double depth = 0, damage_number = 0;  ///< that the table needs, margins included; 0: no table
  bool axis_matters = false;            ///< the velocity axis
  bool complete() const { return questions.empty(); }
};

/// Below this I inertia takes less than 1 % of e: the law needs no velocity axis (docs/method.md).
inline constexpr double negligible_damage_number = 0.002;
/// Time steps in the shortest contact.
inline constexpr double steps_per_contact = 25;

/// Plans a scene. Bound of the speeds: each particle starts at its source and falls to the lowest point of
/// the wall, losing nothing; a wall that moves at U gives it up to 2U more (an elastic rebound), one that
/// drags its surface U; two particles meet at most with the sum of their speeds. The floor under a cloud of
/// equal spheres at rest is shielded by the lowest of them: `landing_speed`.
Plan make_plan(const Scene& scene, const PlanOptions& options, const Visited* visited = nullptr);

/// `mpm table` states a pair's error up to this ratio of radii.
inline constexpr double largest_radius_ratio = 10;
/// The largest ratio of radii at which such bodies meet, as far as a law is asked about it: a deformable
/// plane counts as the largest.
double radius_ratio(const Plan& plan, const Meeting& meeting);

/// The words behind `mpm table` that build what the plan needs; empty: no table is needed, or it cannot be
/// said yet.
std::string table_command(const Plan& plan, const std::string& materials_file);

/// Hertz's collision of m* at `speed`: largest overlap, m, and duration, s.
double hertz_overlap(double e_star, double r_eff, double m_eff, double speed);
double hertz_time(double e_star, double r_eff, double m_eff, double speed);

}  // namespace granulaw::deck
