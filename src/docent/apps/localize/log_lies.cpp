#include "docent/apps/localize/log_lies.h"

#include <array>
#include <cstdio>
#include <limits>
#include <map>

#include "docent/collision_avoidance/plausibility/scanner_watch.h"

namespace docent::apps::localize_command {
namespace {

using collision_avoidance::ScannerWatch;

constexpr double kBlindWithin = 0.02;  // [m]: a log does not say what its lasers are blind to

collision_avoidance::SensorSweep watched_sweep_of(const recording::LoggedScan& scan, double max_range) {
  collision_avoidance::SensorSweep sweep{
      scan.time,         scan.base_from_laser, scan.first_bearing.radians(),
      scan.bearing_step, kBlindWithin,         scan.max_range > 0.0 ? scan.max_range : max_range,
      scan.ranges};
  for (float& range : sweep.ranges)
    if (range >= static_cast<float>(sweep.max_range)) range = std::numeric_limits<float>::infinity();
  return sweep;
}

struct LogFault {
  Time first;
  Time last;
  int scans = 0;
};

}  // namespace

std::vector<std::string> lies_in(const recording::LaserLog& log, const LogLiesParams& params) {
  const collision_avoidance::BaseLimits limits;
  std::array<ScannerWatch, 2> watches{ScannerWatch{"front laser", limits, nullptr},
                                      ScannerWatch{"rear laser", limits, nullptr}};
  std::array<int, 2> scans{};
  std::array<std::map<std::string, LogFault>, 2> faults;
  for (const recording::LoggedScan& scan : log.scans) {
    const std::size_t laser = scan.rear ? 1 : 0;
    const std::array others{watches[1 - laser].word()};
    (void)watches[laser].judge(watched_sweep_of(scan, log.max_range), scan.odom_from_base, true, others);
    ++scans[laser];
    const auto complaint = watches[laser].complaint();
    if (!complaint) continue;
    LogFault& fault = faults[laser].try_emplace(complaint->reason, LogFault{scan.time, scan.time, 0}).first->second;
    fault.last = scan.time;
    ++fault.scans;
  }
  std::vector<std::string> notes;
  for (std::size_t laser = 0; laser < faults.size(); ++laser) {
    for (const auto& [what, fault] : faults[laser]) {
      if (fault.scans < params.least_scans || to_seconds(fault.last - fault.first) < params.least_time) continue;
      std::array<char, 96> when{};
      std::snprintf(when.data(), when.size(), ": from %.1f s on, in %d of %d scans",
                    to_seconds(fault.first - log.scans.front().time), fault.scans, scans[laser]);
      notes.push_back(what + when.data());
    }
  }
  return notes;
}

}  // namespace docent::apps::localize_command
