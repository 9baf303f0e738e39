#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/scales.hpp"
#include "deck/geometry.hpp"

namespace granulaw::deck {

/// Material of one atom type; an empty value is not in the deck.
struct TypeMaterial
{
  std::optional<double> youngs_modulus;  ///< Pa
  std::optional<double> poisson_ratio;
  std::optional<double> yield_stress;  ///< Pa, of `fix property/global yieldStress`
  bool has_moduli() const { return youngs_modulus && poisson_ratio; }
};

/// Particles that the deck brings in at one place.
struct Source
{
  std::string where;  ///< "FILE:LINE"
  int type = 1;
  double radius_min = 0, radius_max = 0;  ///< m; 0: not known
  double density = 0;                     ///< kg/m^3; 0: not known
  Box centres;                            ///< where they may start; empty: not known
  double speed = 0;                       ///< m/s, largest speed at the start
  double count = 0;                       ///< how many of them the runs bring in; 0: not known
  /// m, every centre, where all start at once, at rest, and are of one radius and density; else empty.
  std::vector<Vec3> together;
};

/// A wall that particles can hit.
struct Wall
{
  std::string where, id;
  int type = 1;
  Box box;                  ///< m, with all that its motion sweeps in the runs
  double speed = 0;         ///< m/s, largest speed of its points when it moves
  double drag_speed = 0;    ///< m/s, of its surface along itself (conveyor): drags, does not push
  bool deformable = false;  ///< the word `wall deformable` of the plug-in: its material gives way
  std::string model{};      ///< its normal model
  double push_speed = 0;    ///< m/s, largest part of `speed` along the line of a contact
  double level_push_speed = 0;  ///< m/s, largest part of a face's push across gravity
  double lift = 0;          ///< m, largest rise of a point of it against gravity
};

/// One `run`.
struct Run
{
  std::string where;
  double steps = 0, time_step = 0, particles = 0;  ///< time step, s; particles: mean of begin and end
  bool integrates = true;                          ///< something moves the particles
};

/// A command as LIGGGHTS executed it: variables are replaced, quotes are gone.
struct DeckCommand
{
  std::string file;  ///< as the deck calls it
  int line = 0;      ///< of its first line, from 1
  std::vector<std::string> words;
};

/// Variables that are set before the deck, as liggghts -var does.
using Presets = std::vector<std::pair<std::string, std::vector<std::string>>>;

/// Content of a deck, SI units.
struct Scene
{
  std::string deck;
  std::string units = "lj";  ///< of the deck; LIGGGHTS's default
  Vec3 gravity{0, 0, 0};     ///< m/s^2
  Box domain;
  std::array<bool, 3> periodic{};
  int dimension = 3;
  int types = 0;
  std::map<int, TypeMaterial> materials;  ///< by atom type
  std::vector<Source> sources;
  std::vector<Wall> walls;
  std::vector<Run> runs;
  double time_step = 0;                     ///< s, the last one
  std::string model, law_file;              ///< words of pair_style gran: model, law
  std::vector<std::string> material_names;  ///< and materials
  double stretch = 1;                       ///< and stretch: the time step is this much longer
  std::optional<double> restart_stretch;    ///< of the contacts in the restart file that the deck reads
  double yield_pressure = customary_yield_pressure;  ///< of model thornton, over the yield stress
  std::vector<double> friction;             ///< coefficientFriction, types x types; empty: none
  std::optional<double> restitution;        ///< the smallest coefficientRestitution of the deck
  std::string left_loop;                    ///< "FILE:LINE" of a run in a loop that the plan left; empty: none
  std::vector<std::string> notes;           ///< "FILE:LINE: what was not followed"
  /// Why particles, heights or velocities may be others than those above: "FILE:LINE: reason".
  std::vector<std::string> unknown_particles, unknown_heights, unknown_speeds;
  Presets presets;
  std::string folder;                  ///< where LIGGGHTS was started; empty: here
  std::vector<DeckCommand> commands;   ///< one that a loop repeats with the same words once
  std::vector<std::string> files_read, files_written;  ///< paths, as the deck has them

  /// Particles at the end, at most.
  double count() const;
};

/// LIGGGHTS's own sentence of what it said, without the place in its source.
std::string complaint(const std::string& said);
/// As LIGGGHTS takes them: -in DECK -var NAME VALUE...
std::vector<std::string> words_of(const std::string& deck, const Presets& presets);

/// LIGGGHTS reads the deck (`liggghts-mpm -plan`). Throws Error where that program is missing, or with LIGGGHTS's own
/// sentence where the deck, or a file that it needs, cannot be used.
Scene read_scene(const std::string& deck, const Presets& presets = {});

}  // namespace granulaw::deck
