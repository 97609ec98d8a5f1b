#pragma once

#include <string>
#include <vector>

#include "docent/apps/shared/robot_maker.h"
#include "docent/base/result.h"
#include "docent/evaluation/social_score.h"
#include "docent/geometry/pose2.h"
#include "docent/messages/driving_messages.h"
#include "docent/messages/truth_messages.h"
#include "docent/pictures/figure.h"
#include "docent/simulator/hall/hall.h"

namespace docent::apps::crowd_command {

struct CrowdTrialOptions {
  std::uint64_t seed = 1;  ///< of the hall, its crowd and the sensors' noise; never of the method
  double density = 0.8;    ///< [1/m2] persons a square metre of free floor
  double ignoring = 0.5;   ///< share who walk and stand as if no robot were there
  double settle_s = 30.0;  ///< the crowd takes its places before the robot has a goal
  double limit_s = 120.0;  ///< then the trial is over
  double max_speed = 0.7;  ///< [m/s] open mode
  double goal_radius = 0.6;
  std::vector<std::string> settings;  ///< section.key=value over robot.yaml's defaults
  std::shared_ptr<RobotMaker> robot_maker = std::make_shared<RobotMaker>();
};

struct CrowdTrialOutcome {
  evaluation::SocialReport report;
  int people = 0;
  double free_area = 0.0;  ///< [m2]
  double walking = 0.0;    ///< share of the people who moved faster than 0.2 m/s, mean over the trial
  int horns = 0;
  std::string config_hash;
  std::string crippled;  ///< RobotMaker::crippled
  simulator::Hall hall;
  /// Once a second, and at the end.
  struct Moment {
    double time = 0.0;
    Pose2 robot;
    double speed = 0.0;
    docent_msgs::AvoidState avoid;  ///< as it says itself
    std::vector<docent_msgs::TruePerson> people;
    std::vector<Point2> way;  ///< [m], world: as planned
  };
  std::vector<Moment> moments;
};

/// One crossing of a crowded hall by the robot as it is: all modules that drive it but localization, with the simulated
/// lasers, sonars and odometry and a survey of the hall. Where it is, which localization would say, and the order to go
/// come from here. Nothing else of the robot's sees the truth; the score does. Deterministic.
[[nodiscard]] Result<CrowdTrialOutcome> run_crowd_trial(const CrowdTrialOptions& options);

/// The hall at the end of a trial, the way driven (a dot a second, redder where it stood), the people there.
[[nodiscard]] pictures::Figure draw_crowd_trial(const CrowdTrialOutcome& outcome);

/// The hall at every `every`th of the moments, four in a row: where the robot and the people were, and the way it had
/// planned.
/// @pre every > 0
[[nodiscard]] pictures::Figure draw_crowd_strip(const CrowdTrialOutcome& outcome, std::size_t every);

}  // namespace docent::apps::crowd_command
