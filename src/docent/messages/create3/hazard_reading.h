#pragma once

#include <cstdint>
#include <vector>

#include "docent/base/time.h"
#include "docent/geometry/polygon.h"
#include "docent/geometry/pose2.h"
#include "docent/messages/create3/create3_messages.h"

namespace docent {

struct HazardReadingParams {
  double edge_ahead = 0.03;     ///< [m] before the body, where the floor's edge is taken to be: the sensors look down
                                ///< from the body's rim
  double edge_width = 0.24;     ///< [m] of the floor's edge that one sensor stands for
  double edge_memory = 300.0;   ///< [s] that an edge is remembered: the base backs off, and no other sensor sees it
  double same_edge = 0.08;      ///< [m] between the middles of two edges that are one
  double back_margin = 0.05;    ///< [m] behind the body, where a base that backs no farther is taken to have a wall
  std::size_t most_edges = 64;  ///< remembered, the newest
};

/// What a vector of hazards says in the robot's own terms.
struct HazardReading {
  std::vector<std::uint8_t> segments;  ///< of a ring round the body, as docent_msgs/Tactile has them
  std::vector<Segment> edges;          ///< [m] robot frame: what the body may not cross
  bool is_lifted = false;              ///< somebody carries it: nothing that it feels means anything
  bool is_touched = false;             ///< one of the segments is pressed
};

/// Reads the hazards of a Create 3: five bumpers in front, four cliff sensors, wheels that drop. Remembers the edges of
/// the floor in odometry's frame, because a base that has backed off feels them no more. Deterministic.
class HazardReader {
 public:
  static constexpr std::size_t kSegments = 20;  ///< of 18 degrees: two for each of the five bumpers

  /// @param radius  [m] of the body
  explicit HazardReader(double radius) : HazardReader(radius, HazardReadingParams{}) {}
  HazardReader(double radius, const HazardReadingParams& params) : radius_{radius}, params_{params} {}

  /// @param speed  [m/s] that the robot drives: what stalls its wheels stands where it drives to
  [[nodiscard]] HazardReading read(const irobot_create_msgs::HazardDetectionVector& hazards, bool is_kidnapped,
                                   const Pose2& odom_from_base, double speed, Time now);
  [[nodiscard]] std::size_t edges_remembered() const { return edges_.size(); }

 private:
  struct Edge {
    Segment in_odom;
    Time seen;
  };
  void remember(const Segment& in_odom, Time now);

  double radius_;
  HazardReadingParams params_;
  std::vector<Edge> edges_;  ///< the oldest first
};

}  // namespace docent
