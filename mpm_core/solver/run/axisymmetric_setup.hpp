#pragma once

#include "base/scales.hpp"
#include "solver/grid/rectilinear_body.hpp"
#include "solver/run/setup.hpp"
#include "solver/runs.hpp"

namespace granulaw {

/// Solver units of a run: the first particle's radius, and E* and density of its body material.
Scales scales_of(const Particle& particle);

/// A material in solver units.
Phase phase_of(const Material& material, const Scales& scale);

/// A particle and its partner as the estimates below and the grids need them; solver units.
class Collision : public Setup
{
 public:
  /// Throws Error if the pair cannot be run as asked.
  Collision(const Particle& particle, const Partner& partner, const RunOptions& options, Support support);

  double e_star() const override { return e_star_; }
  double expected_overlap(double velocity) const override;
  double yield_stress() const override { return yield_; }
  int cells(const RunOptions& options, double deepest) const override;
  int cells_made(double deepest, int cells) const override;

  /// Bodies at rest, touching, for an overlap up to `deepest`, with `cells` across the contact block; grid
  /// lines shifted by `shift` of a cell.
  Scene build(double deepest, int cells, double shift) const override;
  std::unique_ptr<Drive> drive() const override;

 private:
  /// Radius on the reference surface that the contact covers at overlap x. Sets the block only.
  double contact_radius(const Particle& particle, double x) const;
  void check_bodies() const;
  void check_grid() const;
  double block_for(const Particle& particle, double deepest) const;
  double fine_step(const Particle& particle, double block, int cells) const;
  /// Bodies whose fine cells span `block`.
  Body body_of(const Particle& particle, double block, int cells, double shift) const;
  Body fitted_sphere(const Particle& sphere, double block, int cells, double shift) const;
  Body thick_wall(const Material& material, double block, int cells, double shift) const;
  CutSection section_of(const Particle& particle, double block, int cells, double shift) const;

  Particle particle_;
  Partner partner_;
  RunOptions options_;
  Support support_;
  double e_star_ = 1, yield_ = 0, length_ = 1, reduced_mass_ = 0;
};

}  // namespace granulaw
