#pragma once

#include <string>
#include <vector>

#include "docent/messages/standard_messages.h"

// What the robot has found out about its own body while it drives.

namespace docent::docent_msgs {

/// A scanner, as the others are to take it now.
struct CalibratedMount {
  static constexpr const char* kType = "docent_msgs/msg/CalibratedMount";
  std::string scanner;  ///< its name in robot.yaml
  double x = 0;         ///< [m], robot frame
  double y = 0;
  double heading = 0;         ///< [rad], robot frame
  double delay = 0;           ///< [s] to be taken from its stamps
  double doubt_heading = 0;   ///< [rad], standard deviation of the above
  double doubt_position = 0;  ///< [m], likewise
  bool is_known = false;      ///< the drive has confirmed, or corrected, what robot.yaml says
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("scanner", m.scanner);
    v("x", m.x);
    v("y", m.y);
    v("heading", m.heading);
    v("delay", m.delay);
    v("doubt_heading", m.doubt_heading);
    v("doubt_position", m.doubt_position);
    v("is_known", m.is_known);
  }
};

/// Mounts and delays of the scanners and the scales of odometry, estimated while the robot drives; latched.
struct Calibration {
  static constexpr const char* kType = "docent_msgs/msg/Calibration";
  std_msgs::Header header;
  std::vector<CalibratedMount> mounts;
  double most_speed = 0;  ///< [m/s] until all mounts are known; 0: no limit
  double way_scale = 1;   ///< true metres for each of odometry
  double turn_scale = 1;  ///< likewise of turns
  std::string finding;    ///< what contradicts robot.yaml; empty: nothing
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("mounts", m.mounts);
    v("most_speed", m.most_speed);
    v("way_scale", m.way_scale);
    v("turn_scale", m.turn_scale);
    v("finding", m.finding);
  }
};

}  // namespace docent::docent_msgs
