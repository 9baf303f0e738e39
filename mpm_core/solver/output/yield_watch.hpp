#pragma once

#include <vector>

#include "solver/body/body.hpp"

namespace granulaw {

class StateArchive;

/// Onset of yield in an elastic body: the overlap at which the von Mises stress first reaches a
/// given yield stress at a point of each material. Solver units.
class YieldWatch
{
 public:
  /// By material; infinity: not watched. Empty: nothing is.
  explicit YieldWatch(std::vector<double> yield_stresses);

  /// To be called at samples of a loading, with the body at the end of a step. Looks at the stresses as soon
  /// as the overlap has grown by 10 %: they grow about as its square root, so that a straight line between
  /// two looks is exact to 1e-3 of the overlap.
  void sample(Body& body, double overlap)
  {
    if (open_ > 0 && overlap >= 1.1 * last_overlap_) look(body, overlap);
  }

  /// By material; infinity: not reached, or not watched.
  const std::vector<double>& overlaps() const { return overlaps_; }

  void visit_state(StateArchive& archive);

 private:
  void look(Body& body, double overlap);

  std::vector<double> yield_stresses_, overlaps_;
  std::vector<double> last_share_;  ///< largest von Mises stress over the yield stress at the last look
  double last_overlap_ = 0;
  int open_ = 0;  ///< materials watched that have not reached it
};

}  // namespace granulaw
