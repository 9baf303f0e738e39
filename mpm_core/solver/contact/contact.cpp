#include "solver/contact/contact.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/state_archive.hpp"

namespace granulaw {

namespace {

/// Opposite walls must still be seen from each other in the direction they were in at the start.
void check_pores(const Body& b)
{
  const Markers& s = b.reference().pore_walls;
  for (int m = 0; m + 1 < s.count; m += 2) {
    const auto &here = s.place[m], &there = s.place[m + 1];
    const Vector3 across(there[0] - here[0], there[1] - here[1], there[2] - here[2]);
    if (!(across.dot(across + carried(b.u_i, s, m + 1) - carried(b.u_i, s, m)) > 0))
      fail("solver",
           fmt::format("the pore at r = {:.4g}, z = {:.4g} (in radii of the first particle) has closed, and "
                       "contact of its walls is not computed; stay below this depth or fill the pore",
                       0.5 * (here[0] + there[0]), 0.5 * (here[2] + there[2])));
  }
}

}  // namespace

RowNodes nodes_of(Body& body)
{
  return {body.u_i.values.data(), body.v_i.values.data(), body.f_i.values.data(),
          body.reference().inverse_mass_i.values.data(), body.u_i.per_component};
}

const RowKernels& row_kernels(bool three_dimensions)
{
  static const RowKernels* const cells[] = {&isa_generic::cell_rows, &isa_avx2::cell_rows,
                                            &isa_avx512::cell_rows};
  static const RowKernels* const corners[] = {&isa_generic::corner_rows, &isa_avx2::corner_rows,
                                              &isa_avx512::corner_rows};
  return *(three_dimensions ? cells : corners)[static_cast<int>(instruction_set())];
}

void Contact::visit_state(StateArchive& a)
{
  a.value(dissipated_);
  if (pull_) pull_->visit_state(a);
}

void Pull::visit_state(StateArchive& a)
{
  a.value(taken_), a.value(work_);
}

Vector3 Pull::velocity_before(const Body& body, int marker, double kick)
{
  const Reference& reference = body.reference();
  const Markers& surface = reference.surface;
  Vector3 v = carried(body.v_i, surface, marker);
  for (int k = 0; k < surface.corners; ++k) {
    const int i = surface.node(marker, k);
    const double share = kick * surface.weights(marker)[k];
    for (int c = 0; c < body.f_i.components; ++c) v[body.f_i.direction(c)] -= share * reference.inverse_mass_i(i, c) * body.f_i(i, c);
  }
  return v;
}

void Pull::push_marker(Body& body, int marker, const Vector3& impulse, double kick)
{
  const Reference& reference = body.reference();
  const Markers& surface = reference.surface;
  for (int k = 0; k < surface.corners; ++k) {
    const int i = surface.node(marker, k);
    for (int c = 0; c < body.f_i.components; ++c) {
      const double p = surface.weights(marker)[k] * impulse[body.f_i.direction(c)];
      body.f_i(i, c) += p / kick;
      body.v_i(i, c) += p * reference.inverse_mass_i(i, c);
    }
  }
}

double RowContact::correct(std::span<Body> bodies, double kick, double dt)
{
  const double pulled = pull(bodies, kick);
  nodes_.clear();
  for (Body& body : bodies) {
    check_pores(body);
    nodes_.push_back(nodes_of(body));
  }
  rows_.resize(side_->most_rows());
  count_ = side_->add_rows(bodies, nodes_.data(), kick, dt, rule_.recovery, rows_.data());
  const RowKernels& kernels = row_kernels(bodies.front());
  kernels.start(nodes_.data(), rows_.data(), count_);
  for (int n = 0; n < rule_.most && kernels.sweep(nodes_.data(), rows_.data(), count_) > rule_.small_change;
       ++n) {
  }
  return pulled + side_->finish(bodies, rows(), dt);
}

void RowContact::account(std::span<const Body> bodies)
{
  Contact::account(bodies);
  const RowKernels& kernels = row_kernels(bodies.front());
  for (const ContactRow& row : rows()) {
    const Vector3 p = vector_in(row.impulse);
    if (p == Vector3::Zero()) continue;
    double now[4];
    kernels.velocity(nodes_.data(), row, now);
    const double by_plane = row.speed * vector_in(row.along).dot(p);
    dissipated_ += by_plane - 0.5 * p.dot(vector_in(row.before) + vector_in(now));
    work_ += by_plane;
  }
}

void RowContact::visit_state(StateArchive& a)
{
  Contact::visit_state(a);
  a.value(work_);
  side_->visit_state(a);
}

}  // namespace granulaw
