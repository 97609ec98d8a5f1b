#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "docent/recording/laser_log.h"

namespace docent::recording {

/// Reads a CARMEN text log, plain or gzip: FLASER, RLASER, ROBOTLASER1, ODOM and PARAM lines; others are passed over.
///
/// What such files leave open is settled so, and said in `notes`:
/// - **Beams.** An even number n of beams over 180 degrees has steps of 180/n from -90 degrees, so the last bearing is
/// one
///   step short; an odd number reaches both ends. `laser_front_laser_resolution` overrules where it fits into 180
///   degrees.
/// - **No return.** SICK scanners write several codes near their limit (81.83, 81.91, 8.191, 32.767 m). Readings above
///   80 m, and those within 0.5 % of the greatest one where they form a peak, become +infinity; zero and less, NaN.
/// - **Place of the laser.** The first of the two poses of a line is the laser's. Where its difference to the second
///   (odometry) is the same in the whole file, that is the laser's place; else it is a corrected robot pose, and the
///   laser's place comes from `robot_frontlaser_offset` or is the robot's centre. A rear laser looks backwards.
/// - **Times.** The first time of a line; where all are equal, the logger's time; where those are equal too, even
/// steps.
///   A time that falls is raised to the one before.
/// - **A torn last line** (no line feed: the recorder was killed) is left out; of a gzip file that is cut, what came
///   before is read.
/// - **A line that says less, more or other than its kind must**, a pose that is no number among them, is left out,
/// where
///   it is at most one in ten.
///
/// Error: "FILE:LINE: …" for the first of more such lines; "FILE: …" when no scan is in it.
[[nodiscard]] Result<LaserLog> read_carmen_log(const std::filesystem::path& path);
/// The same from memory; `name` stands where the file's name would.
[[nodiscard]] Result<LaserLog> parse_carmen_log(std::string_view text, const std::string& name);

}  // namespace docent::recording
