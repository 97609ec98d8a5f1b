#pragma once

#include <span>
#include <string>
#include <vector>

#include "docent/geometry/pose2.h"

namespace docent::simulator {

/// Time between two points of every track [s]: what the annotated recordings have.
inline constexpr double kTrackStep = 0.4;
/// Radius of a recorded person [m]: nobody measured theirs.
inline constexpr double kRecordedRadius = 0.22;

/// Where one recorded person was, every kTrackStep.
struct Track {
  double start = 0.0;          ///< [s] since the recording's begin
  std::vector<Point2> points;  ///< [m], at least two

  [[nodiscard]] double end() const { return start + kTrackStep * static_cast<double>(points.size() - 1); }
  /// On the straight line between two points; before the start and after the end the first and the last one. O(1).
  [[nodiscard]] Point2 at(double time) const;
};

/// People whom a camera followed. They know nothing of the robot.
struct Recording {
  std::string name;       ///< small letters, digits, '-' and '_'
  double duration = 0.0;  ///< [s], > 0; when it is replayed in a loop the next one begins then
  std::vector<Track> tracks;

  /// People who are there at a time, on average.
  [[nodiscard]] double mean_people() const;
};

/// The sum over all of them.
[[nodiscard]] double mean_people(std::span<const Recording> recordings);

}  // namespace docent::simulator
