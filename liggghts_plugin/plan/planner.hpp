#pragma once

#include <chrono>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "liggghts_plugin/engine/liggghts.hpp"
#include "liggghts_plugin/plan/mesh_motion.hpp"
#include "liggghts_plugin/plan/record.hpp"
#include "liggghts_plugin/plan/waiting_loops.hpp"

// `liggghts-mpm -plan FILE -in DECK`: LIGGGHTS reads the deck and sets up every run, but takes two of its
// steps alone, the first and the last. No force acts in contact: no law is needed to plan. What is in memory
// goes to FILE (Record).
namespace granulaw::plugin {

struct Options;

namespace plan {

/// Follows one deck from command to command and from run to run.
class Planner
{
 public:
  Planner(LAMMPS_NS::LAMMPS* lmp, std::string file);

  /// The one of this process; null: it does not plan.
  static Planner* current();

  /// The next command of the deck, as it stands there: all before it have been executed.
  void begin_line(const std::string& where, const std::string& text);
  /// The value that LIGGGHTS goes by where its own of a condition is `value`.
  double decide(double value) { return loops_.decide(value); }
  /// A file is opened.
  void note_file(const std::string& path, bool is_written) { record_.add_file(path, is_written); }
  /// A run that is set up, before its first step.
  void begin_run();
  /// Meshes go where their motion takes them but for the last step.
  void move_meshes(double steps);
  void hold_insertions();
  /// At its last step.
  void end_run(int steps);
  void add_run(int steps);
  /// The process ends: writes the record. True: the deck was read to its end.
  bool finish(int status);
  /// A signal ends the process: writes the command that is executed, by calls that a signal may make.
  void note_crash() const;

  /// Words of a command; `wall` is null for the pair style.
  void note_style(const LAMMPS_NS::FixWallGran* wall, const std::string& model, const Options& options);
  void forget_style(const LAMMPS_NS::FixWallGran* wall) { styles_.erase(wall); }

 private:
  struct Style
  {
    std::string model;
    bool deformable = false;
  };
  /// An insertion, and how many particles its runs have brought in.
  struct Insertion
  {
    std::vector<std::size_t> sources;
    std::vector<double> shares;  ///< of the number of particles
    double spheres = 1;          ///< of one particle, in the mean
    bool began = false;
    int before = 0;  ///< particles that it had inserted when the run began
    LAMMPS_NS::bigint next = 0;
  };
  struct Atom
  {
    int type;
    double radius, density;
    std::array<double, 3> x, v;
  };

  void after_command();
  void drop_written_histories();
  void record_command();
  void find_settings();
  void find_materials();
  void find_walls();
  void add_mesh_wall(const LAMMPS_NS::FixWallGran& wall, LAMMPS_NS::FixMeshSurface& mesh);
  void add_primitive_wall(LAMMPS_NS::FixWallGran& wall);
  void find_forces();
  void find_atoms();
  void find_insertions();
  /// Volume of the spheres over that of the box whose sides are plane walls, a cylinder or periodic; 0: it is none.
  double filled() const;
  void record_without_run();
  Insertion& insertion_of(LAMMPS_NS::FixInsert& fix);
  void look_at_meshes(bool moving);
  void begin_branch(const std::string& value, bool jumps);
  WaitingLoops::Places places_now() const;
  void stop_where_nothing_is_new();
  void stop_where_late();
  Box::Point upward() const;
  Atom atom(int i) const;
  std::string where(const LAMMPS_NS::Fix& fix) const;
  Wall& wall(const std::string& where, const std::string& id);
  template <class Visit>
  void each_fix(Visit&& visit) const;

  LAMMPS_NS::LAMMPS* lmp_;
  std::string file_, where_, crash_;
  Record record_;
  std::map<const LAMMPS_NS::Fix*, std::pair<std::string, std::string>> places_;  ///< id and where of each fix
  std::map<const LAMMPS_NS::FixWallGran*, Style> styles_;
  std::map<std::string, MeshMotion> motions_;
  std::map<std::string, Insertion> insertions_;
  std::unordered_map<int, Atom> atoms_;        ///< by tag, when the last run ended
  std::string atoms_where_;
  LAMMPS_NS::bigint natoms_ = 0;
  std::vector<double> fingerprint_;
  int runs_without_news_ = 0;
  WaitingLoops loops_;
  double count_ = 0;    ///< particles when the run began
  double cleared_ = 0;  ///< particles that `clear` took away
  bool has_box_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace plan
}  // namespace granulaw::plugin
