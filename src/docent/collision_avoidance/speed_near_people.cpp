#include "docent/collision_avoidance/speed_near_people.h"

#include <algorithm>
#include <cmath>

namespace docent {

namespace {

constexpr double kTimeStep = 0.05;   // [s]
constexpr double kSpeedStep = 0.05;  // [m/s]

/// Nowhere before the robot stands can it meet the person faster than harmless.
bool is_forgivable(const PersonPoint& person, double speed, double deceleration, const PeopleCautionParams& params) {
  const double end = params.reaction + speed / deceleration;
  for (double time = 0.0; time < end; time += kTimeStep) {
    const double braking = std::max(0.0, time - params.reaction);
    const double now = speed - deceleration * braking;
    const double way = speed * time - 0.5 * deceleration * braking * braking;
    const Point2 offset = person.at + time * person.velocity - Point2{way, 0.0};
    const double apart = norm(offset);
    if (now * offset.x > params.harmless * apart && apart - person.reach < params.surprise * time) return false;
  }
  return true;
}

}  // namespace

Result<void> PeopleCautionParams::validate() const {
  if (!(surprise >= 0.0 && surprise <= 3.0)) return fail("avoid.people.surprise must lie between 0 and 3 m/s");
  if (!(reaction >= 0.0 && reaction <= 2.0)) return fail("avoid.people.reaction must lie between 0 and 2 s");
  if (!(harmless > 0.0 && harmless <= 0.3)) return fail("avoid.people.harmless must lie in (0, 0.3] m/s");
  return {};
}

double speed_near_person(const PersonPoint& person, double cap, const BaseLimits& limits,
                         const PeopleCautionParams& params) {
  // Too far for any speed up to the cap: most people are.
  const double end = params.reaction + cap / limits.deceleration;
  if (norm(person.at) - person.reach > (cap + params.surprise + norm(person.velocity)) * end) return cap;
  double speed = cap;
  while (speed > params.harmless && !is_forgivable(person, speed, limits.deceleration, params)) speed -= kSpeedStep;
  return std::max(speed, std::min(cap, params.harmless));
}

}  // namespace docent
