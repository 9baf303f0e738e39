#pragma once

#include <memory>

#include "base/scales.hpp"
#include "solver/contact/scene.hpp"
#include "solver/loading/drives.hpp"
#include "solver/runs.hpp"

namespace granulaw {

/// The bodies of a run before their grids are chosen; solver units.
class Setup
{
 public:
  virtual ~Setup() = default;
  const Scales& scale() const { return scale_; }
  /// Cells across the contact block for overlaps up to `deepest`. Throws Error if the options' own cannot be
  /// used.
  virtual int cells(const RunOptions& options, double deepest) const = 0;
  /// Cells across the block of the grid that build() makes: more where thin layers ask for it.
  virtual int cells_made(double /*deepest*/, int cells) const { return cells; }
  /// Largest overlap that an impact can be expected to reach, about; up to 0.9.
  virtual double expected_overlap(double velocity) const = 0;
  /// Smallest yield stress of the materials, Pa; infinity if none yields.
  virtual double yield_stress() const = 0;
  /// 1/(1/E*_1 + 1/E*_2); 1 against what is rigid.
  virtual double e_star() const { return 1; }
  /// Bodies at rest, touching, for an overlap up to `deepest`, with `cells` across the contact block; grid
  /// lines shifted by `shift` of a cell.
  virtual Scene build(double deepest, int cells, double shift) const = 0;
  /// The way in which a press moves them.
  virtual std::unique_ptr<Drive> drive() const = 0;
  /// Brings the traces of planes into the order in which the caller gave them.
  virtual void give_planes(std::vector<PlaneTrace>& /*planes*/) const {}

 protected:
  explicit Setup(const Scales& scale) : scale_(scale) {}
  /// Attraction in units of the run. Throws Error if cells of the length `cell` do not divide the zone over which an edge parts.
  Attraction in_run_units(Attraction attraction, double cell) const;
  Scales scale_;
};

/// `options.resolution` if it is given and lies between 6 and `most`, else `standard`; times
/// `options.refine`.
int cells_of(const RunOptions& options, double standard, int most, const char* where);

/// Checks of the options that no grid changes.
void check_options(const RunOptions& options, const Particle& particle);

/// True if a run is one of three dimensions; `needed`: the reason beside shape and grid, null for none.
bool in_three_dimensions(const Particle& particle, const Partner& partner, const RunOptions& options,
                         const char* needed);

/// Direction of length 1. `where` leads the sentence of Error about a vector that has none.
Vector3 unit_direction(const std::array<double, 3>& v, const char* where);

}  // namespace granulaw
