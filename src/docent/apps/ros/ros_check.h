#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "docent/robot/robot_config.h"
#include "docent/transport/dds_reach.h"
#include "docent/transport/discovery/discovery.h"
#include "docent/transport/discovery/ros_nodes.h"

namespace docent::apps::ros {

/// A topic that Docent's modules read of the base.
struct Need {
  transport::TopicInfo topic;
  bool is_needed = false;            ///< without it the robot stands
  std::string without;               ///< what becomes of the robot
  std::vector<std::string> modules;  ///< that read it
};
/// Which of the robot's eyes are open.
struct Eyes {
  bool sight = false;    ///< sight.enabled: looks ahead and down
  bool ceiling = false;  ///< ceiling.enabled
};
/// Of a robot with that body. @param needs_sonar  avoid.needs_sonar @param is_create3  robot.create3: its bumpers come
/// on hazard_detection
[[nodiscard]] std::vector<Need> needs_of(const robot::RobotBody& body, bool needs_sonar, bool is_create3,
                                         const Eyes& eyes = {});

/// What came on a topic while the command listened.
struct Arrivals {
  std::uint64_t messages = 0;  ///< that can be used
  std::uint64_t refused = 0;   ///< that cannot
  std::string refusal;         ///< why the last of these
};

/// A need, and what was heard of it.
struct Finding {
  Need need;
  std::string topic;  ///< as ROS 2 has it: "/scan_front"
  Arrivals arrivals;
  double rate = 0.0;                ///< [Hz]
  std::vector<std::string> faults;  ///< in a person's words, with what would help
  [[nodiscard]] bool arrives() const { return arrivals.messages > 0; }
};

/// Where Docent's topics are on the wire: a bus, or what a test says.
struct Wire {
  std::function<std::string(const transport::TopicInfo&)> name;
  std::function<std::string(const transport::TopicInfo&)> type;
};

/// All that `docent ros check` has to say.
struct Check {
  transport::DdsReach reach;
  std::vector<transport::NetworkInterface> interfaces;
  std::vector<transport::RosLine> lines;  ///< for ROS 2's side
  transport::Discovered heard;
  std::vector<transport::RosNode> nodes;  ///< that programs say they are
  double seconds = 0.0;                   ///< that it listened
  std::vector<Finding> findings;
  std::vector<std::string> faults;  ///< beside those of the findings: of commands, of Docent's own topics
  std::vector<std::string> notes;   ///< what may be meant so
  /// All that is needed arrives, and nobody is in the way.
  [[nodiscard]] bool is_fine() const;
};

/// Whether it is a program of a robot of Docent's: it tells its health. @param health  that topic on the wire
[[nodiscard]] bool is_docent(const transport::Discovered& heard, const std::string& participant,
                             const std::string& health);

/// One need against what came and what discovery told.
[[nodiscard]] Finding finding_of(const Need& need, const Arrivals& arrivals, double seconds, const Wire& wire,
                                 const transport::Discovered& heard);
/// Whether the base hears commands, and nobody else gives them: adds to faults and notes.
void check_commands(Check& check, const Wire& wire);
/// Readers and writers of others on Docent's own topics that do not come together with them: adds to faults.
void check_others(Check& check, const Wire& wire);

}  // namespace docent::apps::ros
