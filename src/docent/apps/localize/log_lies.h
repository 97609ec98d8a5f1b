#pragma once

#include <string>
#include <vector>

#include "docent/recording/laser_log.h"

namespace docent::apps::localize_command {

struct LogLiesParams {
  double least_time = 1.0;  ///< [s] for which something is wrong before it is a note: a moment is no lie
  int least_scans = 5;      ///< likewise, scans
};

/// What the scanners of a recording say that cannot be, as a robot would name it in its drive: for a person, a line a
/// fault, with when and how often: "the front laser repeats old sweeps: from 12.3 s on, in 85 of 900 scans".
/// O(scans * beams).
[[nodiscard]] std::vector<std::string> lies_in(const recording::LaserLog& log, const LogLiesParams& params = {});

}  // namespace docent::apps::localize_command
