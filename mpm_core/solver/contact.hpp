#pragma once

#include <span>
#include <vector>

#include "solver/body.hpp"

namespace granulaw {

/// Contact of the first body's surface with the rigid, frictionless plane z = 0 or with the second body,
/// which is described in its own frame: pole at the origin, mirrored, so that the gap is the sum of both
/// heights. No stiffness, no gap parameter; the force can only push.
class Contact
{
 public:
  virtual ~Contact() = default;
  /// Corrects velocities for a step `dt`; returns the impulse on the first body (+z), which the second feels
  /// too.
  virtual double correct(std::span<Body> bodies, double dt) = 0;
  /// Radius of the contact edge after the last correct(), 0 if open: where the gap, extrapolated from the
  /// first two open surface points as (r - a)^1.5 beside the last closed one, vanishes.
  virtual double edge_radius(std::span<const Body> bodies) const = 0;
};

/// Edge of a contact from the last closed surface point and the next two, as above.
struct EdgePoint
{
  double r, gap;
};
double edge_between(double closed_r, EdgePoint first, EdgePoint second);

/// A plane against a body whose surface points are grid nodes: predictor-corrector. A node that would end the
/// step below the plane gets the velocity that puts it there; the nodes do not disturb each other.
class PlaneContact : public Contact
{
 public:
  double correct(std::span<Body> bodies, double dt) override;
  double edge_radius(std::span<const Body> bodies) const override;

 private:
  int outermost_ = -1;  // index into the surface
};

/// Any surface against the plane or against another body's surface (a polyline through its surface points):
/// non-negative impulses at the first body's surface points, found by Gauss-Seidel sweeps on the condition
/// that no point ends the step below the other surface. Normals are those of the other surface.
/// Walls of pores are not kept apart: correct() throws Error once two of them have passed each other.
class SurfaceContact : public Contact
{
 public:
  double correct(std::span<Body> bodies, double dt) override;
  double edge_radius(std::span<const Body> bodies) const override;

 private:
  /// One possible contact: the velocities it depends on and what they must add up to.
  struct Row
  {
    int point;
    int begin, end;   // entries
    double needed;    // velocity of separation, at least
    double response;  // velocity gained per unit of impulse
  };
  struct Entry
  {
    double* vr;
    double* vz;
    double wr, wz, inverse_mass;
  };
  void make_rows(std::span<Body> bodies, double dt);
  double separation(const Row& row) const;
  void push(const Row& row, double impulse);

  std::vector<Row> rows_;
  std::vector<Entry> entries_;
  std::vector<double> impulse_;       // per surface point, of the last step: where the sweeps start
  std::vector<double> gap_, radius_;  // per surface point, before the step
  int outermost_ = -1;
};

}  // namespace granulaw
