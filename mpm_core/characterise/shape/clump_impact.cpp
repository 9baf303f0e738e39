#include "characterise/shape/clump_impact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/larger.hpp"
#include "contact/body_behind.hpp"
#include "law/contact_time.hpp"

namespace granulaw {

namespace {

/// One ball at the wall; SI.
struct BallContact
{
  ClumpBall ball;
  double largest = 0, impact_overlap = 0, compliance = 0;
};

}  // namespace

ClumpAnswer clump_on_wall(const BodyLaw& law, const std::vector<ClumpBall>& balls, const RigidBody& body,
                          const Vector3& direction, double velocity, bool with_body)
{
  const PairLaw pair = wall_pair(law);
  const double behind = far_field(law.material.poisson_ratio) / law.material.e_star();
  std::vector<BallContact> contacts;
  double reach = 0, finest = INFINITY;  // m, from the centre of mass to the wall at first touch; of the smallest ball
  for (const ClumpBall& ball : balls) {
    contacts.push_back({ball});
    reach = std::max(reach, direction.dot(ball.centre) + ball.radius);
    finest = std::min(finest, ball.radius);
  }
  // the replay of one contact has 20000 steps; 5000 give e within 1e-5 of it (clump_impact_test)
  const double dt = customary_contact_time(law.material.e_star(), finest, body.mass, velocity) / 5000;
  const Eigen::Matrix3d compliance = body.inertia.inverse();
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
  Vector3 spin_momentum = Vector3::Zero(), torque = Vector3::Zero();
  const auto spin = [&]() -> Vector3 { return turned * (compliance * (turned.transpose() * spin_momentum)); };
  double height = reach, speed = velocity, force = 0, most = 0, last_touch = 0;
  ClumpAnswer answer;
  constexpr long longest = 500000;
  for (long step = 0; step < longest; ++step) {
    speed -= 0.5 * dt * force / body.mass;
    spin_momentum += 0.5 * dt * torque;
    height -= dt * speed;
    if (const Vector3 now = spin(); now.norm() > 0) turned = Eigen::AngleAxisd(dt * now.norm(), now.normalized()) * turned;
    force = 0, torque.setZero();
    for (BallContact& c : contacts) {
      const Vector3 arm = turned * c.ball.centre, lever = arm.cross(direction);
      const double radius = c.ball.radius, over = direction.dot(arm) + radius, overlap = over - height;
      if (overlap <= 0) {
        c = {c.ball};
        continue;
      }
      if (c.largest == 0) {
        const double approach = std::max(speed + spin().dot(lever), 0.0);
        const Eigen::Matrix3d now = turned * compliance * turned.transpose();
        c.impact_overlap = pair.impact_overlap(radius, 1 / (1 / body.mass + lever.dot(now * lever)), approach);
        c.compliance = with_body ? behind * reach_behind(radius, over) : 0;
      }
      const auto respond = [&](double x) { return pair.evaluate(radius, x, c.largest, c.impact_overlap); };
      const Answer now = respond(overlap_of_law(overlap, c.compliance, c.largest, respond));
      c.largest = now.delta_max;
      answer.left_range |= c.largest > pair.max_overlap(radius);
      force += now.force;
      torque -= now.force * lever;
    }
    speed -= 0.5 * dt * force / body.mass;
    spin_momentum += 0.5 * dt * torque;
    // nothing but the contacts changes the energy of the rigid motion
    const double work = 0.5 * (body.mass * (velocity * velocity - speed * speed) - spin().dot(spin_momentum));
    most = larger(most, work);
    answer.contact.force_max = larger(answer.contact.force_max, force);
    if (force > 0) last_touch = step;
    // as contact_work: what follows after a tenth of the contact's duration is another impact
    if (work < most && step - last_touch > 0.1 * last_touch) {
      answer.contact.restitution = std::sqrt((most - work) / most);
      return answer;
    }
  }
  fail("the impact of a clump", "it did not end within a hundred times the expected contact time");
}

}  // namespace granulaw
