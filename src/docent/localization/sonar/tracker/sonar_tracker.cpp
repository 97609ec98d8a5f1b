#include "docent/localization/sonar/tracker/sonar_tracker.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::localization {
namespace {

constexpr double kWallGate = 3.0;         // deviations
constexpr double kWallCorrelation = 1.5;  // sonars beside each other see the same wall
constexpr double kLeastRange = 0.1;       // [m]
constexpr double kDoubtPosition = 0.05;   // [m] a contradiction adds
constexpr double kDoubtHeading = 0.01;    // [rad]
constexpr double kSure = 0.998;           // without a contradiction
constexpr double kTrust = 0.85;           // that one contradiction leaves
constexpr int kMostContradictions = 8;    // that are kept: as many matches in a row end the doubt
constexpr double kSideways = 0.6;         // cosine limit: sonars that look along the way see no wall beside it

}  // namespace

Result<void> SonarTrackerParams::validate() const {
  for (const auto& valid : {motion.validate(), drift.validate(), walls.validate(), match.validate()}) {
    if (!valid) return valid;
  }
  if (!(sweep_length > 0.0)) return fail("sweep_length must be > 0");
  if (!(sweep_turn > 0.0)) return fail("sweep_turn must be > 0");
  if (!(sweep_echoes >= 15)) return fail("sweep_echoes must be >= 15");
  if (!(rectangular >= 0.0 && rectangular <= 1.0)) return fail("rectangular must be 0..1");
  return {};
}

SonarTracker::SonarTracker(const OccupancyGrid& map, const SonarTrackerParams& params, int sonars)
    : params_{params}, map_{map}, filter_{params.motion, params.drift}, walls_{params.walls, sonars} {}

void SonarTracker::start_at(const Pose2& map_from_robot, double position, double heading) {
  const double p = position * position;
  filter_.start_at(map_from_robot, {p, 0.0, 0.0, 0.0, p, 0.0, 0.0, 0.0, heading * heading});
  sweep_.clear();
  walls_.forget();
  way_ = turn_ = 0.0;
  contradictions_ = 0;
}

void SonarTracker::move(const Pose2& odom_from_robot) {
  if (odom_from_robot_) {
    const Pose2 step = filter_.move(inverse(*odom_from_robot_) * odom_from_robot);
    track_from_robot_ = track_from_robot_ * step;
    way_ += norm(step.position());
    turn_ += std::abs(step.theta.radians());
  }
  odom_from_robot_ = odom_from_robot;
  if (way_ >= params_.sweep_length || turn_ >= params_.sweep_turn * kDegree) match_now();
}

void SonarTracker::hear(const SonarEcho& echo, const Pose2& odom_from_robot) {
  if (!odom_from_robot_ || std::isnan(echo.range)) return;
  const Pose2 now_from_then = inverse(*odom_from_robot_) * odom_from_robot;
  const Pose2 track_from_sonar = track_from_robot_ * now_from_then * echo.robot_from_sonar;
  const bool heard = echo.range < echo.max_range && echo.range >= kLeastRange;
  if (params_.use_walls && std::abs(std::cos(echo.robot_from_sonar.theta.radians())) < kSideways) {
    const auto wall = walls_.add(echo.sonar, track_from_sonar, heard ? std::optional{echo.range} : std::nullopt);
    if (wall) use_wall(*wall);
  }
  if (heard && echo.range < params_.match.max_range) sweep_.push_back({track_from_sonar, echo.range});
}

void SonarTracker::use_wall(const WallAngle& wall) {
  const auto main = map_.main_direction();
  if (!main || main->share < params_.rectangular) return;
  // The wall as the filter's pose turns it, against the nearest of the building's four directions.
  const Angle normal_in_map = filter_.map_from_robot().theta + (wall.normal - track_from_robot_.theta);
  const double off = std::remainder((normal_in_map - main->heading).radians(), kRightAngle);
  const double deviation = kWallCorrelation * wall.deviation;
  const double expected = std::sqrt(filter_.covariance()[8] + deviation * deviation);
  if (std::abs(off) > kWallGate * expected || std::abs(off) > 0.5 * kRightAngle) {
    ++tally_.walls_refused;
    return;
  }
  ++tally_.walls;
  filter_.correct_heading(filter_.map_from_robot().theta - Angle::radians(off), deviation);
}

double SonarTracker::p_lost() const { return 1.0 - kSure * std::pow(kTrust, contradictions_); }

void SonarTracker::match_now() {
  way_ = turn_ = 0.0;
  std::vector<PlacedEcho> echoes;
  echoes.reserve(sweep_.size());
  const Pose2 robot_from_track = inverse(track_from_robot_);
  const std::size_t most = std::min(sweep_.size(), static_cast<std::size_t>(params_.sweep_echoes));
  for (std::size_t i = 0; i < most; ++i) {
    const Heard& heard = sweep_[i * sweep_.size() / most];
    echoes.push_back({robot_from_track * heard.track_from_sonar, heard.range});
  }
  sweep_.clear();
  if (!params_.use_matches) return;
  const SweepMatch match = match_sweep(params_.match, map_, echoes, filter_.map_from_robot(), filter_.covariance());
  switch (match.outcome) {
    case MatchOutcome::matched:
      ++tally_.matched;
      contradictions_ = std::max(0, contradictions_ - 1);  // one match may be by chance: doubt goes as it came
      filter_.correct_pose(match.map_from_robot, match.covariance);
      return;
    case MatchOutcome::too_few_echoes:
      ++tally_.too_few;
      return;
    case MatchOutcome::ambiguous:
      ++tally_.ambiguous;
      return;
    case MatchOutcome::unlike_the_map:
      ++tally_.unlike;
      break;
    case MatchOutcome::too_far_off:
      ++tally_.too_far;
      break;
  }
  contradictions_ = std::min(contradictions_ + 1, kMostContradictions);
  filter_.widen(kDoubtPosition, kDoubtHeading);
}

}  // namespace docent::localization
