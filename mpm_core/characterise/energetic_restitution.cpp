#include "characterise/energetic_restitution.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace granulaw {

namespace {

Vector3 vector_of(const std::array<double, 3>& v)
{
  return {v[0], v[1], v[2]};
}

/// Length of the interval whose mean a sample is: times are those of the middles.
double interval(const std::vector<TraceSample>& trace, std::size_t k)
{
  if (trace.size() < 2) return 0;
  const std::size_t low = k > 0 ? k - 1 : 0, high = std::min(k + 1, trace.size() - 1);
  return (trace[high].time - trace[low].time) / static_cast<double>(high - low);
}

}  // namespace

double energetic_restitution(const RunResult& run, const RigidBody& body, double velocity)
{
  const std::vector<PlaneSample>& samples = run.planes.front().samples;
  const Eigen::Matrix3d compliance = body.inertia.inverse();
  Vector3 motion(0, 0, -velocity), angular = Vector3::Zero();
  const double before = 0.5 * body.mass * velocity * velocity;
  double least = before, energy = before;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double time = interval(run.trace, k);
    motion += time / body.mass * vector_of(samples[k].vector);
    angular += time * vector_of(samples[k].torque);
    energy = 0.5 * body.mass * motion.squaredNorm() + 0.5 * angular.dot(compliance * angular);
    least = std::min(least, energy);
  }
  return before > least ? std::sqrt((energy - least) / (before - least)) : 0;
}

}  // namespace granulaw
