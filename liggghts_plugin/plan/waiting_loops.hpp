#pragma once

#include <map>
#include <string>

#include "base/box.hpp"

namespace granulaw::plugin::plan {

/// Loops of a deck that a value of a run ends, as a force on a plate: a dry run has none, and would never leave
/// them. One is left where a run has nothing more to bring: all meshes that move have passed the particles, or
/// move away from them, or nothing is new.
class WaitingLoops
{
 public:
  /// Boxes of the meshes that move, by id, and of the centres of all particles.
  struct Places
  {
    std::map<std::string, Box> meshes;
    Box centres;
  };

  /// An `if` with a jump, which a run's value decides, behind so many runs. True: this is its second time.
  bool arrive(const std::string& where, std::size_t runs, const Places& places);
  /// Many runs have brought nothing new.
  void find_nothing_new() { nothing_new_ = inside(); }
  /// The deck is in such a loop.
  bool inside() const { return passes_ > 0; }
  /// The next line stands there: another `if` decides for itself.
  void pass_on() { leaves_ = false; }
  /// Value of the condition that LIGGGHTS is to go by.
  double decide(double value);
  /// A mesh moves so many times the way of a run in this pass: long ways take few passes.
  double stride() const { return stride_; }

 private:
  void follow(const Places& places);

  std::map<std::string, std::size_t> runs_;  ///< by place of the `if`
  std::string where_;
  int passes_ = 0;  ///< of the loop of where_
  bool leaves_ = false, nothing_new_ = false;
  double stride_ = 1;
  std::map<std::string, double> least_;  ///< distance to the particles, by mesh
  Places before_;
};

}  // namespace granulaw::plugin::plan
