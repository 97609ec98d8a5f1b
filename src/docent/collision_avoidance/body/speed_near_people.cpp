#include "docent/collision_avoidance/body/speed_near_people.h"

#include <algorithm>
#include <cmath>

namespace docent::collision_avoidance {

namespace {

/// How much nearer [m] a surprise may have brought somebody after `time`.
double surprise_after(double time, const PeopleCautionParams& params) {
  const double gathering = params.surprise / params.spurt;
  if (time < gathering) return 0.5 * params.spurt * time * time;
  return params.surprise * (time - 0.5 * gathering);
}

}  // namespace

Result<void> PeopleCautionParams::validate() const {
  if (!(surprise >= 0.0 && surprise <= 3.0)) return fail("avoid.people.surprise must lie between 0 and 3 m/s");
  if (!(spurt >= 0.5 && spurt <= 100.0)) return fail("avoid.people.spurt must lie between 0.5 and 100 m/s2");
  if (!(reaction >= 0.0 && reaction <= 2.0)) return fail("avoid.people.reaction must lie between 0 and 2 s");
  if (!(harmless > 0.0 && harmless <= 0.3)) return fail("avoid.people.harmless must lie in (0, 0.3] m/s");
  return {};
}

BrakingWay::BrakingWay(double speed, double curvature, const BaseLimits& limits, const PeopleCautionParams& params)
    : speed_{speed}, end_{params.reaction + speed / limits.deceleration}, params_{params} {
  const auto along = [&](double way) {
    return curvature == 0.0 ? Point2{1.0, 0.0} : unit(Angle::radians(curvature * way));
  };
  steps_.reserve(static_cast<std::size_t>(end_ / params.step) + 2);
  for (double time = 0.0; time < end_; time += params.step) {
    const double braking = std::max(0.0, time - params.reaction);
    const double way = speed * time - 0.5 * limits.deceleration * braking * braking;
    // The middle of a short arc lies along half its turn.
    steps_.push_back({time, speed - limits.deceleration * braking, way * along(0.5 * way), along(way),
                      surprise_after(time, params)});
  }
}

bool BrakingWay::is_forgivable(const PersonPoint& person) const {
  // Too far for any meeting: most people are.
  if (norm(person.at) - person.reach > (speed_ + params_.surprise + norm(person.velocity)) * end_) return true;
  return std::none_of(steps_.begin(), steps_.end(), [&](const Step& step) {
    const Point2 offset = person.at + step.time * person.velocity - step.at;
    const double apart = norm(offset);
    if (apart - person.reach >= step.surprise) return false;
    return step.speed * dot(step.ahead, offset) > params_.harmless * apart;
  });
}

}  // namespace docent::collision_avoidance
