#include "docent/apps/shared/log_defaults.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <string>

namespace docent::apps {

void add_topic_options(CLI::App& command, recording::WantedTopics& topics, bool has_robot) {
  command.add_option("--scan", topics.scans, "topic of scans in a recording of ROS, e.g. /scan; may be repeated")
      ->allow_extra_args(false)
      ->type_name("TOPIC");
  command.add_option("--odom", topics.odometry, "topic of odometry in it, e.g. /odom")->type_name("TOPIC");
  if (has_robot)
    command.add_option("--robot", topics.robot, "name space of one of the robots in it, e.g. /robot1")
        ->type_name("NAME");
}

void add_times_option(CLI::App& command, std::string& times) {
  command
      .add_option("--times", times,
                  "of a recording of ROS: stamps, or index: the order of its messages, where its clocks are of no use")
      ->check(CLI::IsMember({"stamps", "index"}))
      ->capture_default_str();
}

recording::LogTimes times_of(const std::string& times) {
  return times == "index" ? recording::LogTimes::index : recording::LogTimes::stamps;
}

double reach_of_log(double max_range) {
  // Far readings tell one corridor from another; beyond some length the map's headings are too coarse for them.
  constexpr double kMost = 30.0;
  return std::min(max_range > 0.0 ? max_range : kMost, kMost);
}

Result<void> set_log_defaults(robot::RobotConfig& config, const OccupancyGrid& map, double max_range,
                              bool times_are_invented, double moving_share) {
  constexpr double kReadingsOfPart = 5000.0;  // [1/m2]: 12 in a map of 5 cm, 50 in one of 10 cm
  // A map's cells are as coarse as its walls are uncertain.
  const double sigma = std::hypot(0.13, 1.5 * map.frame.resolution);
  for (const std::string& setting : {
           "sensor={max_range: " + std::to_string(reach_of_log(max_range)) + ", sigma: " + std::to_string(sigma) + "}",
           // Whose wheels these were is not known.
           std::string{"motion={rotation_per_metre: 0.0015}"},
           // Corridors repeat: a place must bear out over some metres, turning tells nothing. Hindsight knows the way
           // there.
           std::string{"verdict={here: 0.07, enough_share: 0.8, enough_mass: 0.8, most_contradiction: 0.3, travelled: "
                       "1, turned: 100000}"},
           // Few people walk through a log, and much is not drawn: so many readings it takes to say that a part of such
           // a map is wrong, and it says less than where walls are exact.
           // What is usual in it nobody has measured: it is searched as often as it may be wrong. Whoever tells where a
           // log begins errs now and then by a recess or a room: each place that looks alike has 3 % of its odds.
           "tracks={nats: 2, too_short: 1, given: 3.5, startled_given: 8, search_way_calm: 6, doubt_nats: 1000, "
           "part_beams: " +
               std::to_string(kReadingsOfPart * std::pow(map.frame.resolution, 2)) + "}",
           // How far such a map's walls are off nobody has measured.
           std::string{"exact_walls=false"},
           // Nobody waits for the next scan: states sink later than in a robot.
           std::string{"sea_threshold=0.00001"},
       }) {
    if (auto set = config.set("localize." + setting); !set) return set;
  }
  // Shapes of people were learned in simulated halls: many a building has slim parts that look alike, so they are asked
  // only where a crowd walks through the log.
  if (moving_share < kCrowdShare)
    if (auto set = config.set("localize.person_share=1"); !set) return set;
  // Steps of time that nobody measured say nothing of the time there was for an update.
  return times_are_invented ? config.set("localize.work_per_second=1e15") : Result<void>{};
}

}  // namespace docent::apps
