#pragma once

#include <string>

#include "docent/grid/occupancy_grid.h"
#include "docent/recording/laser_log.h"
#include "docent/robot/robot_config.h"

namespace CLI {
class App;
}

namespace docent::apps {

/// The options that choose among the topics of a recording of ROS; without `has_robot` that of a robot is not among
/// them.
void add_topic_options(CLI::App& command, recording::WantedTopics& topics, bool has_robot = true);
/// Where the times of a recording of ROS come from: --times stamps, or index.
void add_times_option(CLI::App& command, std::string& times);
/// What that option says.
[[nodiscard]] recording::LogTimes times_of(const std::string& times);

/// Of a log's readings, that end on people who walk: a crowd. Busy museums have 0.03 to 0.05; logs of ordinary
/// buildings 0 to 0.028 (Wean hall by day), and these are localized well without.
inline constexpr double kCrowdShare = 0.035;

/// Sets what a recorded log of some robot in some building wants otherwise than a robot of ours in a surveyed museum,
/// in section `localize`. `max_range` [m] of the log's laser; 0: unknown. `moving_share`: of its readings, that end on
/// what walks, see moving_share in `localize`: from kCrowdShare on shapes of people are taken for people.
[[nodiscard]] Result<void> set_log_defaults(robot::RobotConfig& config, const OccupancyGrid& map, double max_range,
                                            bool times_are_invented = false, double moving_share = 0.0);

/// How far [m] a laser's readings are used that reach `max_range` (0: unknown).
[[nodiscard]] double reach_of_log(double max_range);

}  // namespace docent::apps
