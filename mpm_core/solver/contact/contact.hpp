#pragma once

#include <span>
#include <vector>

#include "solver/body/motion.hpp"
#include "solver/output/trace.hpp"

namespace granulaw {

/// Contact of bodies with each other or with planes: impulses that keep them from passing through. No
/// stiffness, no gap parameter; the force can only push.
class Contact
{
 public:
  virtual ~Contact() = default;
  /// Corrects velocities for a step `dt`, after the nodes were accelerated over `kick`; returns the impulse
  /// on the first body (+z; of planes: of the first plane).
  virtual double correct(std::span<Body> bodies, double kick, double dt) = 0;
  /// To be called when all velocities of the step are final: adds what this contact took from the bodies.
  virtual void account(std::span<const Body> bodies) = 0;
  /// Energy lost so far: -sum p (v_before + v_after)/2 over all impulses p; v: velocity of separation. It
  /// goes with the scheme's own energy balance. Where a gap closes, m v^2/2 of its nodes is lost: the grid's
  /// own loss, proportional to the cell size (3e-3 of the impact energy at V/V_y = 500 with 16 cells, 1e-2 at
  /// 1500).
  double dissipated() const { return dissipated_; }
  /// Radius of the contact edge after the last correct(), 0 if open.
  virtual double edge_radius(std::span<const Body> bodies) const = 0;
  /// Work that moving planes have done on the body.
  virtual double work() const { return 0; }
  /// Adds the forces of each plane over a sample of length `time` to its trace.
  virtual void end_sample(std::span<const Body> /*bodies*/, double /*time*/,
                          std::vector<PlaneTrace>& /*planes*/)
  {
  }
  virtual void visit_state(StateArchive& archive);

 protected:
  double dissipated_ = 0;
};

/// Edge of a contact from the last closed surface point and the next two: where the gap, extrapolated from
/// the two open points as (r - a)^1.5, vanishes.
struct EdgePoint
{
  double r, gap;
};
double edge_between(double closed_r, EdgePoint first, EdgePoint second);

/// The rigid, frictionless plane z = 0 against a body whose surface points are grid nodes:
/// predictor-corrector. A node that would end the step below the plane gets the velocity that puts it there;
/// the nodes do not disturb each other. Nodes inside the body are held above the plane as well: from about
/// 0.2 R on, a cell at the edge of the contact can be sheared so far that its inner nodes pass its own
/// surface, which one point a cell does not see, and the body would run through the plane there (E*/Y = 100,
/// V/V_y = 3000: e .085, .097, .116 at 10, 14, 20 cells, instead of .070, .074, .078 towards .08).
class PlaneContact : public Contact
{
 public:
  double correct(std::span<Body> bodies, double kick, double dt) override;
  void account(std::span<const Body> bodies) override;
  double edge_radius(std::span<const Body> bodies) const override;
  void visit_state(StateArchive& archive) override;

 private:
  struct Push
  {
    int node;
    double impulse, before;  // velocity at the start of the step
  };
  void push(Body& body, int node, double kick, double least);

  std::vector<Push> pushes_;
  double impulse_ = 0;
  int outermost_ = -1;  // index into the surface
};

/// Any surface of revolution against the plane z = 0 or against another body's surface (a polyline through
/// its surface points), which is described in its own frame: pole at the origin, mirrored, so that the gap is
/// the sum of both heights. Non-negative impulses at the first body's surface points, found by Gauss-Seidel
/// sweeps on the condition that no point ends the step below the other surface. Normals are those of the
/// other surface. Walls of pores are not kept apart: correct() throws Error once two of them have passed each
/// other.
class SurfaceContact : public Contact
{
 public:
  double correct(std::span<Body> bodies, double kick, double dt) override;
  void account(std::span<const Body> bodies) override;
  double edge_radius(std::span<const Body> bodies) const override;
  void visit_state(StateArchive& archive) override;

 private:
  /// One possible contact: the velocities it depends on and what they must add up to.
  struct Row
  {
    int point;
    int begin, end;   // entries
    double needed;    // velocity of separation, at least
    double response;  // velocity gained per unit of impulse
    double before;    // velocity of separation at the start of the step
  };
  struct Entry
  {
    double* vr;
    double* vz;
    double wr, wz, inverse_mass;
  };
  void make_rows(std::span<Body> bodies, double kick, double dt);
  double separation(const Row& row) const;
  void push(const Row& row, double impulse);

  std::vector<Row> rows_;
  std::vector<Entry> entries_;
  std::vector<double> impulse_;       // per surface point, of the last step: where the sweeps start
  std::vector<double> gap_, radius_;  // per surface point, before the step
  int outermost_ = -1;
};

}  // namespace granulaw
