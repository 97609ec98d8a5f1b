#include "docent/localization/sonar/evidence/sonar_trust.h"

#include <algorithm>
#include <cmath>

namespace docent::localization {

void SonarTrust::hear(int sonar, double range, const Pose2& odom_from_robot) {
  constexpr double kMoved = 0.3;    // [m]: enough to change what nearly every sonar hears
  constexpr double kTurned = 25.0;  // [deg]: more than the cone
  Ear& ear = ring_[static_cast<std::size_t>(sonar)];
  if (range != ear.range) {
    ear = {range, odom_from_robot, false};
    return;
  }
  const Pose2 motion = inverse(ear.odom_from_robot) * odom_from_robot;
  ear.is_stuck = ear.is_stuck || norm(motion.position()) > kMoved || std::abs(motion.theta.degrees()) > kTurned;
}

void SonarTrust::compare(const Agreement& readings) {
  constexpr double kFewest = 4.0;  // fewer tell nothing
  constexpr double kMemory = 0.1;  // an update's share in the running mean
  constexpr double kTooLittle = 0.1;
  constexpr double kEnough = 0.2;
  // What is too short may be people, however many there are.
  const double all = readings.agrees + readings.longer;
  if (all < kFewest) return;
  agreement_ += kMemory * (readings.agrees / all - agreement_);
  at_odds_ = agreement_ < (at_odds_ ? kEnough : kTooLittle);
}

SonarTrust::State SonarTrust::state() const {
  constexpr std::ptrdiff_t kFewest = 4;
  const auto hear = std::count_if(ring_.begin(), ring_.end(), [](const Ear& ear) { return ear.range >= 0.0; });
  const auto stuck = std::count_if(ring_.begin(), ring_.end(), [](const Ear& ear) { return ear.is_stuck; });
  // Some read alike by chance, along a wall.
  if (stuck >= kFewest && 2 * stuck > hear) return State::frozen;
  return at_odds_ ? State::at_odds : State::well;
}

}  // namespace docent::localization
