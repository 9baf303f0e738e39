#include "solver/body/stable_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/error.hpp"
#include "solver/body/kernels.hpp"
#include "solver/body/motion.hpp"

namespace granulaw {

namespace {

/// Beyond this the step would fall without end: a film of Y/100 on a core lasts 300000 steps, and impacts at
/// 5000 V_y stay below 45.
constexpr double squeezed = 50;

/// The points come and go among the nodes of an `updated` grid, so its frequencies change all the time.
/// Inside a uniform grid of quadratic splines with lumped masses omega_max = sqrt(3) c/h in two dimensions,
/// which allows dt = 1.15 h/c; nodes with little mass near a surface take half of that off.
double updated_step(const MovingPoints& m)
{
  double fastest = 0, finest = 1;
  for (const Region& region : m.own.regions)
    for (int p = region.begin; p < region.end; ++p)
      fastest = std::max(
          fastest, (region.moduli.bulk + 4.0 / 3.0 * region.moduli.shear) * m.own.volume_p[p] / m.mass[p]);
  for (const SplineAxis* axis : {&m.r_axis, &m.z_axis})
    for (int c = 0; c < axis->cells(); ++c)
      finest = std::min(finest, axis->lines()[c + 1] - axis->lines()[c]);
  return 0.6 * finest / std::sqrt(fastest);
}

/// A field of displacements at random.
NodeField random_field(const Body& body)
{
  NodeField x = body.u_i;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const int entries = static_cast<int>(x.values.size()) / std::max(1, x.nodes);  // three dimensions: 4
  for (int i = 0; i < x.nodes; ++i)
    for (int c = 0; c < entries; ++c) x(i, c) = uniform(random);
  return x;
}

/// omega_max^2 of a body by power iteration on M^-1 K about its displacements. A vector x is a field of
/// displacements; its response is found with displacements no larger than `step` of the finest cell at the
/// surface, where it is linear.
class PowerIteration
{
 public:
  PowerIteration(Body& body, NodeField& x, double step)
      : body_(body), reference_(body.reference()), x_(x), step_(step), start_(body.u_i.values)
  {
    kernels(body_).elastic_response(body_);
    force_ = body_.f_i.values;
  }
  /// The vector that converges fastest alternates in sign.
  double largest_eigenvalue(int iterations)
  {
    hold();
    double eigenvalue = 0;
    for (int n = 0; n < iterations; ++n) {
      const double scale = 1 / std::sqrt(square());
      double largest = 0;
      for (double& value : x_.values) {
        largest = std::max(largest, std::abs(value * scale));
        value *= scale;
      }
      const double finest = reference_.surface.finest;
      respond(step_ * (finest > 0 ? finest : 1) / largest);
      eigenvalue = std::sqrt(square());  // |M^-1 K x| for |x| = 1, in the mass norm: from below
      hold();
    }
    body_.u_i.values = start_;
    return eigenvalue;
  }

 private:
  /// In the mass norm.
  double square() const
  {
    double sum = 0;
    for (int i = 0; i < x_.nodes; ++i) {
      double of_node = 0;
      for (int c = 0; c < x_.components; ++c) of_node += x_(i, c) * x_(i, c);
      sum += reference_.mass_i[i] * of_node;
    }
    return sum;
  }
  /// x becomes M^-1 K x.
  void respond(double step)
  {
    for (std::size_t k = 0; k < x_.values.size(); ++k) body_.u_i.values[k] = start_[k] + step * x_.values[k];
    kernels(body_).elastic_response(body_);
    for (int i = 0; i < x_.nodes; ++i) {
      const double mass = reference_.mass_i[i], per_mass = mass > 0 ? 1 / mass : 0;
      for (int c = 0; c < x_.components; ++c)
        x_(i, c) = -(body_.f_i(i, c) - force_[x_.at(i, c)]) / step * per_mass;
    }
  }
  void hold()
  {
    for (std::size_t k = 0; k < x_.values.size(); ++k)
      if (reference_.inverse_mass_i.values[k] == 0) x_.values[k] = 0;
  }

  Body& body_;
  const Reference& reference_;
  NodeField& x_;
  double step_;
  AlignedVector<double> start_, force_;
};

}  // namespace

StableStep::StableStep(Body& body)
{
  if (body.moving)
    omega_ = 2 / updated_step(*body.moving);
  else {  // in three dimensions an iteration costs most of a run's start
    NodeField x = random_field(body);
    omega_ =
        1.01 *
        std::sqrt(PowerIteration(body, x, 1e-7).largest_eigenvalue(body.reference().is_spatial() ? 30 : 80));
  }
}

double StableStep::limit(const Body& body) const
{
  const Growth now = kernels(body).growth(body);
  if (!(now.least_volume > 0) || now.largest > squeezed * squeezed)
    fail("solver",
         fmt::format(
             "a cell was {}: more than a reference grid can follow (over 0.4 R? a soft layer on a hard core? "
             "planes from all sides beyond a nominal density of 1.1?); stay below this depth, or take --grid "
             "updated (bodies of revolution) or a finer grid",
             now.least_volume > 0 ? "squeezed to a fiftieth of its size" : "turned inside out"));
  // At the surface a cut lets the frequencies be up to twice those of a filled cell: there they grow from the
  // highest of the body at rest.
  return 2 / std::max(omega_ * std::sqrt(std::max(1.0, now.cut)), std::sqrt(now.filled_omega2));
}

MeasuredStep::MeasuredStep(const Body& body, const MeasuredStep* kept, const Eigen::Matrix3d& turn)
    : x_(kept ? kept->x_ : random_field(body))
{
  if (!kept) return;
  for (int i = 0; i < x_.nodes; ++i) {
    const Vector3 turned = turn * at(x_, i);
    for (int c = 0; c < 3; ++c) x_(i, c) = turned[c];
  }
}

double MeasuredStep::limit(Body& body, int iterations)
{
  // bodies lie far from the origin: a larger step keeps digits
  return 2 / std::sqrt(PowerIteration(body, x_, 1e-5).largest_eigenvalue(iterations));
}

}  // namespace granulaw
