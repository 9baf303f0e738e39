#include "characterise/shape/energetic_restitution.hpp"

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

double ContactWork::restitution() const
{
  return taken > 0 ? std::sqrt(given_back / taken) : 0;
}

ContactWork contact_work(const RunResult& run, const RigidBody& body, const RigidMotion& before)
{
  const std::vector<PlaneSample>& samples = run.planes.front().samples;
  const Eigen::Matrix3d compliance = body.inertia.inverse();
  Vector3 motion = before.velocity, spin = before.spin;
  double work = 0, most = 0, first_touch = -1, last_touch = 0, duration = 0;
  ContactWork found;
  bool ended = false;
  // a contact has ended where the body stays free for this part of the first one's duration
  constexpr double gap = 0.1;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double time = interval(run.trace, k), at = run.trace[k].time;
    const Vector3 place = vector_of(samples[k].centre);
    const auto approach = [&] { return -(motion + spin.cross(place)).z(); };
    const double before_step = approach();
    motion += time / body.mass * vector_of(samples[k].vector);
    spin += time * (compliance * vector_of(samples[k].torque));
    if (!(samples[k].force > 0)) continue;
    if (first_touch < 0) first_touch = last_touch = at;
    if (work < most && at - last_touch > gap * duration) {
      ended = true;
      ++found.contacts;
    }
    last_touch = at;
    if (ended) continue;
    duration = at - first_touch;
    work += samples[k].force * time * 0.5 * (before_step + approach());
    most = std::max(most, work);
    found.taken = most, found.given_back = most - work;
  }
  found.velocity_after = motion;
  return found;
}

double energetic_restitution(const RunResult& run, const RigidBody& body, double velocity)
{
  return contact_work(run, body, {Vector3(0, 0, -velocity), Vector3::Zero()}).restitution();
}

}  // namespace granulaw
