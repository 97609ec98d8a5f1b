#pragma once

#include <span>
#include <string>
#include <vector>

#include "docent/geometry/polygon.h"
#include "docent/geometry/pose2.h"
#include "docent/messages/scanners/own_body.h"
#include "docent/messages/scanners/zero_meaning.h"

namespace docent {

/// One sweep of a laser scanner, in the order of its beams.
struct DriverScan {
  std::span<const float> ranges;  ///< [m]
  double first_bearing = 0.0;     ///< [rad] of ranges[0], about the scanner's own axis
  double bearing_step = 0.0;      ///< [rad], below 0: clockwise
  double min_range = 0.0;         ///< [m]
  double max_range = 0.0;         ///< [m] this or more, and +infinity: nothing came back
};

/// What the owner of a scanner says of it.
struct ScannerTraits {
  Pose2 base_from_sensor{};              ///< the drawing's
  bool is_upside_down = false;           ///< it hangs: its axis points to the floor
  double max_range = 0.0;                ///< [m] that it looks at most; 0: as its messages say
  ZeroMeans zero = ZeroMeans::find_out;  ///< what its driver means by 0
  double body_radius = 0.0;              ///< [m] what it sees inside is the robot itself; 0: nobody looks
  Polygon body_outline{};                ///< [m] likewise, where the body is no disc; convex
};

/// Reads the sweeps of one scanner as drivers write them into what all of Docent takes them for: beams
/// counter-clockwise about an axis that points up, "nothing came back" as the greatest range, and NaN for what is no
/// reading of the world: failures, and the robot itself. Remembers what it has found out. Deterministic.
class ScanReader {
 public:
  explicit ScanReader(const ScannerTraits& traits)
      : traits_{traits}, body_{traits.base_from_sensor, traits.body_radius, traits.body_outline} {}

  /// The sweep is good until the next call. O(beams)
  const DriverScan& read(const DriverScan& written);

  /// [beams] those of the newest sweep that ended on the robot itself; empty: none did.
  [[nodiscard]] const std::vector<bool>& own_body() const { return body_.taken_out(); }

  /// What a technician should know of this scanner, a clause each; empty: nothing.
  [[nodiscard]] std::vector<std::string> notes() const;
  /// What of its sight keeps a robot from finding its place, a clause; empty: nothing. It comes and goes.
  [[nodiscard]] std::string hindrance() const;
  /// What its driver means by 0, as its owner says or as far as one knows.
  [[nodiscard]] ZeroMeans zero() const { return traits_.zero == ZeroMeans::find_out ? zeros_.found() : traits_.zero; }

 private:
  void put_in_order(const DriverScan& written);
  void note_answers();

  ScannerTraits traits_;
  ZeroMeaning zeros_;
  OwnBody body_;
  std::vector<float> ranges_;
  DriverScan scan_;
  double said_reach_ = 0.0;  ///< [m] of the newest message
  double answered_ = 1.0;    ///< share of its readings that end on something, running mean
};

}  // namespace docent
