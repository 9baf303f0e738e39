#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/box.hpp"
#include "base/scales.hpp"

// A deck's scene as LIGGGHTS holds it in memory, in the deck's units. tools/deck reads it (deck/scene.hpp).
namespace granulaw::plugin::plan {

struct Material
{
  std::optional<double> youngs_modulus, poisson_ratio, yield_stress;
};

/// Particles of one type that one command brings in.
struct Source
{
  std::string where;  ///< "FILE:LINE"
  int type = 1;
  double radius_min = 0, radius_max = 0;
  double density = 0;  ///< mass over the sphere's volume: of a clump's sphere the mass is the body's
  Box centres;
  double speed = 0, count = 0;
  std::vector<std::array<double, 3>> together;  ///< centres, if all are alike and start at rest
};

struct Wall
{
  std::string where, id, model;  ///< of a mesh: its id
  int type = 1;
  Box box;  ///< with all that its motion sweeps
  double speed = 0, drag_speed = 0;
  bool deformable = false;
  double push_speed = 0;  ///< largest part of `speed` along the line of a contact
  double level_push_speed = 0;  ///< largest part of a face's push across gravity
  double lift = 0;        ///< largest rise of a point of it against gravity
};

struct Run
{
  std::string where;
  double steps = 0, time_step = 0, particles = 0;
  bool integrates = true;  ///< a fix moves particles
};

/// A command as LIGGGHTS executed it: variables are replaced, quotes are gone.
struct Command
{
  std::string where;
  std::vector<std::string> words;
  bool operator==(const Command&) const = default;
};

struct Record
{
  std::string units;
  std::array<double, 3> gravity{};
  Box domain;
  std::array<bool, 3> periodic{};
  int dimension = 3, types = 0;
  std::map<int, Material> materials;
  std::optional<double> restitution;  ///< the smallest coefficientRestitution
  std::vector<double> friction;       ///< coefficientFriction, types x types; empty: the deck has none
  std::string model, law;             ///< words of pair_style gran: model, law, materials, stretch
  std::vector<std::string> material_names;
  double stretch = 1;
  std::optional<double> restart_stretch;  ///< of the contacts in the restart file that the deck reads
  double yield_pressure = customary_yield_pressure;  ///< of model thornton, over the yield stress
  std::vector<Source> sources;
  std::vector<Wall> walls;
  std::vector<Run> runs;
  double time_step = 0;
  std::vector<std::string> notes, unknown_particles, unknown_speeds;
  std::vector<Command> commands;  ///< in their order; one that a loop repeats with the same words once
  std::vector<std::string> files_read, files_written;  ///< paths, as the deck has them
  std::string left_loop;  ///< "FILE:LINE" of a run in a loop that only a run's values end; empty: there is none
  std::string stopped_at;  ///< the command that LIGGGHTS refused; empty: it read the deck to its end

  double count() const;
  void note(const std::string& text);
  void ask_speed(const std::string& text);
  void add_command(Command command);
  void add_file(const std::string& path, bool is_written);
  /// All that a plan uses but the runs: what a run that brings nothing new leaves as it is.
  std::vector<double> fingerprint() const;
  std::string json() const;
  /// The record of a process that a signal ended.
  static std::string json_of_stop(const std::string& where);

 private:
  std::map<std::string, std::vector<std::size_t>> places_;  ///< of commands
};

}  // namespace granulaw::plugin::plan
