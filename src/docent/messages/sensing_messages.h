#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "docent/messages/standard_messages.h"

// What a body reports that no standard message holds.

namespace docent::docent_msgs {

/// The tactile ring: one byte a segment, counter-clockwise from the front; 1 = pressed, 255 = no reading.
struct Tactile {
  static constexpr const char* kType = "docent_msgs/msg/Tactile";
  std_msgs::Header header;  ///< frame base_link
  std::vector<std::uint8_t> segments;
  std::uint32_t scan = 0;  ///< count of the ring's own scans, so that a frozen one can be told; 0: it keeps none
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("segments", m.segments);
    v("scan", m.scan);
  }
};

/// A line on the floor that nothing may touch, [m], frame of the message.
struct ObstacleLine {
  static constexpr const char* kType = "docent_msgs/msg/ObstacleLine";
  float x1 = 0, y1 = 0, x2 = 0, y2 = 0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("x1", m.x1);
    v("y1", m.y1);
    v("x2", m.x2);
    v("y2", m.y2);
  }
};

/// Obstacles that a camera saw. A new message replaces the one before of the same source. Sent at a steady rate, also
/// when nothing is seen: a source that falls silent stops the robot.
struct ObstacleLines {
  static constexpr const char* kType = "docent_msgs/msg/ObstacleLines";
  std_msgs::Header header;  ///< frame base_link, when the picture was taken
  std::string source;       ///< which camera
  double lifetime_s = 1.0;  ///< [s] the lines count for so long after the stamp, at most 5
  std::vector<ObstacleLine> lines;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("source", m.source);
    v("lifetime_s", m.lifetime_s);
    v("lines", m.lines);
  }
};

/// Where a camera on a pan-tilt-zoom mount shall look; sent again now and then, so that a mount that woke up late
/// follows.
struct CameraView {
  static constexpr const char* kType = "docent_msgs/msg/CameraView";
  std_msgs::Header header;   ///< frame map: the mount's zero looks along its x
  double pan = 0;            ///< [rad] to the left
  double tilt = 0;           ///< [rad] upwards
  double field_of_view = 1;  ///< [rad] from the picture's left edge to its right edge: smaller is nearer
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("pan", m.pan);
    v("tilt", m.tilt);
    v("field_of_view", m.field_of_view);
  }
};

}  // namespace docent::docent_msgs
