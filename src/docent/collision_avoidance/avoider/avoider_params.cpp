#include "docent/collision_avoidance/avoider/avoider_params.h"

namespace docent::collision_avoidance {
namespace {

constexpr const char* kPlain = "dynamic_window";

}  // namespace

Result<void> AvoiderParams::validate() const {
  if (auto valid = window.validate(); !valid) return valid;
  if (!(lookahead >= 0.3 && lookahead <= 5.0)) return fail("avoid.lookahead must lie between 0.3 and 5 m");
  if (!(lookahead_time >= 0.0 && lookahead_time <= 5.0)) return fail("avoid.lookahead_time must lie in 0..5 s");
  if (auto valid = people.validate(); !valid) return valid;
  if (auto valid = body.validate(); !valid) return valid;
  if (method != "cautious_window" && method != kPlain)
    return fail("avoid.method must be cautious_window or dynamic_window");
  if (!(seen_for >= 0.0 && seen_for <= 60.0)) return fail("avoid.seen_for must lie in 0..60 s");
  if (!(sonar_speed > 0.0)) return fail("avoid.sonar_speed must be > 0 m/s");
  if (!(arrival_deceleration > 0.0)) return fail("avoid.arrival_deceleration must be > 0 m/s2");
  if (!(target_timeout > 0.0 && virtual_timeout > 0.0)) return fail("avoid: timeouts must be > 0 s");
  return {};
}

std::unique_ptr<LocalPlanner> AvoiderParams::make_planner(const BaseLimits& limits) const {
  if (method == kPlain) return std::make_unique<PlainWindow>(limits, window, sharp_turns);
  return std::make_unique<CautiousWindow>(limits, window, sharp_turns);
}

PeopleCaution AvoiderParams::caution(const BaseLimits& limits) const {
  return {limits, window.real_margin, people, UnseenBodies{body, laser_height}, method != kPlain};
}

SurroundingsParams AvoiderParams::surroundings() const {
  return {.real_margin = window.real_margin,
          .surprise = people.surprise,
          .seen_for = seen_for,
          .has_lasers = has_lasers,
          .blind_to_people = blind_to_people,
          .felt = {.remembers = remembers_touch}};
}

VirtualObstaclesParams AvoiderParams::virtual_obstacles() const {
  return {.hazard_margin = window.virtual_margin, .border_margin = window.border_margin};
}

InputWatchesParams AvoiderParams::inputs() const {
  return {.needs_sonar = needs_sonar,
          .has_infrared = has_infrared,
          .has_tactile = has_tactile,
          .virtual_timeout = virtual_timeout};
}

}  // namespace docent::collision_avoidance
