#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/box.hpp"
#include "base/scales.hpp"

// A deck's scene: what LIGGGHTS holds in memory when the deck's runs begin. `liggghts-mpm -plan FILE` writes it as JSON
// (scene_json.hpp) in the deck's units; deck::read_scene (tools/deck) gives it in SI units.
namespace granulaw::deck {

/// Material of one atom type; an empty value is not in the deck.
struct TypeMaterial
{
  std::optional<double> youngs_modulus;  ///< Pa
  std::optional<double> poisson_ratio;
  std::optional<double> yield_stress;  ///< Pa, of `fix property/global yieldStress`
  bool has_moduli() const { return youngs_modulus && poisson_ratio; }
};

/// Particles of one type that one command brings in.
struct Source
{
  std::string where;  ///< "FILE:LINE"
  int type = 1;
  double radius_min = 0, radius_max = 0;  ///< m; 0: not known
  double density = 0;  ///< kg/m^3, mass over the sphere's volume: of a clump's sphere the mass is the body's; 0: not known
  Box centres;         ///< where they may start; empty: not known
  double speed = 0;    ///< m/s, largest speed at the start
  double count = 0;    ///< how many of them the runs bring in; 0: not known
};

/// A wall that particles can hit.
struct Wall
{
  std::string where, id;    ///< of a mesh: its id
  int type = 1;
  Box box;                  ///< m, with all that its motion sweeps in the runs
  double speed = 0;         ///< m/s, largest speed of its points when it moves
  double drag_speed = 0;    ///< m/s, of its surface along itself (conveyor): drags, does not push
  bool deformable = false;  ///< the word `wall deformable` of the plug-in: its material gives way
  std::string model;        ///< its normal model
  double push_speed = 0;    ///< m/s, largest part of `speed` along the line of a contact
  double level_push_speed = 0;  ///< m/s, largest part of a face's push across gravity
  double lift = 0;          ///< m, largest rise of a point of it against gravity
};

/// One `run`.
struct Run
{
  std::string where;
  double steps = 0, time_step = 0, particles = 0;  ///< time step, s; particles: mean of begin and end
  bool integrates = true;                          ///< a fix moves particles
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

struct Scene
{
  std::string units = "lj";  ///< of the deck; LIGGGHTS's default
  Box::Point gravity{};      ///< m/s^2
  Box domain;
  std::array<bool, 3> periodic{};
  int dimension = 3, types = 0;
  std::map<int, TypeMaterial> materials;  ///< by atom type
  std::vector<Source> sources;
  std::vector<Wall> walls;
  std::vector<Run> runs;
  double time_step = 0;                     ///< s, the last one
  std::string model, law_file;              ///< words of pair_style gran: model, law
  std::vector<std::string> material_names;  ///< and materials
  std::string confinement;                  ///< and confinement; empty: off
  /// Largest at the end of a run in which walls or sides of the box come closer: volume of the spheres over that of the closed
  /// box; 0: not known, or nothing presses.
  double solid_volume = 0;
  double stretch = 1;                       ///< and stretch: the time step is this much longer
  std::optional<double> restart_stretch;    ///< of the contacts in the restart file that the deck reads
  double yield_pressure = customary_yield_pressure;  ///< of model thornton, over the yield stress
  std::vector<double> friction;             ///< coefficientFriction, types x types; empty: none
  std::optional<double> restitution;        ///< the smallest coefficientRestitution
  std::string left_loop;   ///< "FILE:LINE" of a run in a loop that only a run's values end; empty: there is none
  std::string stopped_at;  ///< the command that LIGGGHTS refused; empty: it read the deck to its end
  std::vector<std::string> notes;  ///< "FILE:LINE: what was not followed"
  /// Why particles or velocities may be others than those above: "FILE:LINE: reason".
  std::vector<std::string> unknown_particles, unknown_speeds;
  std::vector<DeckCommand> commands;  ///< in their order; one that a loop repeats with the same words once
  std::vector<std::string> files_read, files_written;  ///< paths, as the deck has them

  // by the reader (deck::read_scene), not in the file
  std::string deck;
  std::string folder;  ///< where LIGGGHTS was started; empty: here
  Presets presets;

  /// Particles at the end, at most.
  double count() const
  {
    double sum = 0;
    for (const Source& s : sources) sum += s.count;
    return sum;
  }
};

}  // namespace granulaw::deck
