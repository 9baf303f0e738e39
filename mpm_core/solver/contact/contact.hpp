#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solver/body/motion.hpp"
#include "solver/contact/rows.hpp"
#include "solver/output/trace.hpp"

namespace granulaw {

/// Fields of a body's nodes as the kernels of rows take them.
RowNodes nodes_of(Body& body);

inline Vector3 vector_in(const double* four)
{
  return {four[0], four[1], four[2]};
}

/// Attraction between the surfaces of a contact.
class Pull
{
 public:
  virtual ~Pull() = default;
  /// Adds the attraction to the nodes' forces, and what it adds over `kick` to their velocities; returns the impulse on the first body.
  virtual double pull(std::span<Body> bodies, double kick) = 0;
  /// To be called when all velocities of the step are final.
  virtual void account(std::span<const Body> bodies) = 0;
  /// Energy taken so far: the work to part the surfaces less what they gave back.
  double taken() const { return taken_; }
  /// Work that moving planes have done by it.
  double work() const { return work_; }
  void visit_state(StateArchive& archive);

 protected:
  /// Velocity of a marker, less what its nodes' forces added over `kick`.
  static Vector3 velocity_before(const Body& body, int marker, double kick);
  /// Adds an impulse to the velocities of a marker's nodes, and to their forces what it is over the kick.
  static void push_marker(Body& body, int marker, const Vector3& impulse, double kick);
  double taken_ = 0, work_ = 0;
};

/// Contact of bodies with each other or with planes: impulses that keep them from passing through. No
/// stiffness, no gap parameter; the force can only push, but for the attraction of surfaces that have one.
class Contact
{
 public:
  explicit Contact(std::unique_ptr<Pull> pull = nullptr) : pull_(std::move(pull)) {}
  virtual ~Contact() = default;
  /// Corrects velocities for a step `dt`, after the nodes were accelerated over `kick`; returns the impulse
  /// on the first body (+z; of planes: of the first plane).
  virtual double correct(std::span<Body> bodies, double kick, double dt) = 0;
  /// To be called when all velocities of the step are final: adds what this contact took from the bodies.
  virtual void account(std::span<const Body> bodies)
  {
    if (pull_) pull_->account(bodies);
  }
  /// Energy lost so far: -sum p (v_before + v_after)/2 over all impulses p; v: velocity of separation. It
  /// goes with the scheme's own energy balance. Where a gap closes, m v^2/2 of its nodes is lost: the grid's
  /// own loss, proportional to the cell size (3e-3 of the impact energy at V/V_y = 500 with 16 cells, 1e-2 at
  /// 1500).
  double dissipated() const { return dissipated_; }
  /// Energy that attraction between the surfaces has taken: the work to part them less what they gave back.
  double attracted() const { return pull_ ? pull_->taken() : 0; }
  /// Radius of the contact edge after the last correct(), 0 if open.
  virtual double edge_radius(std::span<const Body> bodies) const = 0;
  /// Work that moving planes have done on the body.
  virtual double work() const { return pull_ ? pull_->work() : 0; }
  /// Adds the forces of each plane over a sample of length `time` to its trace.
  virtual void end_sample(std::span<const Body> /*bodies*/, double /*time*/,
                          std::vector<PlaneTrace>& /*planes*/)
  {
  }
  virtual void visit_state(StateArchive& archive);

 protected:
  double pull(std::span<Body> bodies, double kick) { return pull_ ? pull_->pull(bodies, kick) : 0; }
  double dissipated_ = 0;

 private:
  std::unique_ptr<Pull> pull_;  // null: none
};

/// A side of a contact: markers of the first body's surface against planes or against another body.
class Side
{
 public:
  virtual ~Side() = default;
  /// Rows of the markers that might touch in a step `dt`, each with its impulse of the last step; how many.
  /// `rows` has room for most_rows().
  virtual int add_rows(std::span<Body> bodies, const RowNodes* nodes, double kick, double dt, double recovery,
                       ContactRow* rows) = 0;
  virtual std::size_t most_rows() const = 0;
  /// After the impulses were found; returns that on the first body.
  virtual double finish(std::span<const Body> bodies, std::span<const ContactRow> rows, double dt) = 0;
  virtual double edge_radius(std::span<const Body> bodies) const = 0;
  virtual void end_sample(std::span<const Body> /*bodies*/, double /*time*/,
                          std::vector<PlaneTrace>& /*planes*/)
  {
  }
  virtual void visit_state(StateArchive& archive) = 0;
};

/// Sweeps over the rows of a step: most of them, the change (as a fraction of the largest impulse) that ends
/// them sooner, and the fraction of its way that a marker behind the other side comes back in a step.
struct SweepRule
{
  int most;
  double small_change, recovery;
};
inline constexpr SweepRule sweeps_of_revolution{30, 1e-7, 1};
/// Sweeps that end early leave markers a little behind a plane: the whole way at once would feed energy (e of
/// a plastic impact 0.5 % too small, elastic vibration growing); by a twentieth e is that of 300 sweeps to
/// 2e-4.
inline constexpr SweepRule sweeps_in_three_dimensions{15, 1e-6, 0.05};

/// Impulses at the markers of a side, found by Gauss-Seidel sweeps that start from those of the last step.
/// After a step no marker may have passed the other side (normal impulse p_n >= 0; V: its own velocity), and
/// it slides only where the friction is spent:
///
///     n.v >= V - gap/dt,  p_n >= 0;    |p_t| <= mu p_n,  p_t opposite to the sliding where equal.
///
/// Walls of pores are not kept apart: correct() throws Error once two of them have passed each other.
class RowContact : public Contact
{
 public:
  RowContact(std::unique_ptr<Side> side, SweepRule rule, std::unique_ptr<Pull> pull = nullptr)
      : Contact(std::move(pull)), side_(std::move(side)), rule_(rule)
  {
  }
  double correct(std::span<Body> bodies, double kick, double dt) override;
  void account(std::span<const Body> bodies) override;
  double edge_radius(std::span<const Body> bodies) const override { return side_->edge_radius(bodies); }
  double work() const override { return work_ + Contact::work(); }
  void end_sample(std::span<const Body> bodies, double time, std::vector<PlaneTrace>& planes) override
  {
    side_->end_sample(bodies, time, planes);
  }
  void visit_state(StateArchive& archive) override;

 private:
  std::span<const ContactRow> rows() const { return {rows_.data(), static_cast<std::size_t>(count_)}; }

  std::unique_ptr<Side> side_;
  SweepRule rule_;
  std::vector<RowNodes> nodes_;   // of the bodies
  std::vector<ContactRow> rows_;  // room for all that there can be; the first count_ count
  int count_ = 0;
  double work_ = 0;
};

}  // namespace granulaw
