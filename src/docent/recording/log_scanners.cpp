#include "docent/recording/log_scanners.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <vector>

#include "docent/messages/scanners/own_body.h"
#include "docent/messages/scanners/zero_meaning.h"

namespace docent::recording {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();
constexpr float kNoReading = std::numeric_limits<float>::quiet_NaN();
constexpr double kLeastWay = 2.0;          // [m] driven, before what stays is the robot itself
constexpr std::size_t kFewestSweeps = 30;  // likewise
constexpr float kNearest = 0.7F;           // [m] farther off no robot sees itself
constexpr float kStays = 0.05F;            // [m]
constexpr float kSamePart = 0.1F;          // [m] of a neighbouring beam: of the same part
constexpr double kStayShare = 0.95;        // of the sweeps
constexpr double kMostOfBody = 0.25;       // of the beams
constexpr double kShortOfReach = 0.8;      // of what the driver says

using Scans = std::vector<LoggedScan*>;

bool take_zeros(const Scans& scans, double max_range) {
  ZeroMeaning meaning;
  for (const LoggedScan* const scan : scans) {
    meaning.add(scan->ranges, std::abs(scan->bearing_step), 0.0, max_range);
    if (meaning.found() != ZeroMeans::find_out) break;
  }
  const bool is_nothing = meaning.found() == ZeroMeans::nothing;
  for (LoggedScan* const scan : scans)
    std::replace(scan->ranges.begin(), scan->ranges.end(), 0.0F, is_nothing ? kNothing : kNoReading);
  return is_nothing;
}

/// [beams] what each reads all the time, if it is near; 0: it does not.
std::vector<float> fixed_readings(const Scans& scans) {
  std::vector<float> fixed(scans.front()->ranges.size(), 0.0F);
  std::vector<float> readings;
  for (std::size_t beam = 0; beam < fixed.size(); ++beam) {
    readings.clear();
    for (const LoggedScan* const scan : scans)
      if (std::isfinite(scan->ranges[beam])) readings.push_back(scan->ranges[beam]);
    if (static_cast<double>(readings.size()) < kStayShare * static_cast<double>(scans.size())) continue;
    const auto middle = readings.begin() + static_cast<std::ptrdiff_t>(readings.size() / 2);
    std::nth_element(readings.begin(), middle, readings.end());
    const float median = *middle;
    const auto same = std::count_if(readings.begin(), readings.end(),
                                    [&](float range) { return std::abs(range - median) <= kStays; });
    if (median < kNearest && static_cast<double>(same) >= kStayShare * static_cast<double>(scans.size()))
      fixed[beam] = median;
  }
  return fixed;
}

bool take_out_body(const Scans& scans) {
  const std::size_t beams = scans.front()->ranges.size();
  const bool is_even =
      std::all_of(scans.begin(), scans.end(), [&](const LoggedScan* scan) { return scan->ranges.size() == beams; });
  double way = 0.0;
  for (std::size_t i = 1; i < scans.size(); ++i)
    way += distance(scans[i - 1]->odom_from_base.position(), scans[i]->odom_from_base.position());
  if (!is_even || scans.size() < kFewestSweeps || way < kLeastWay) return false;
  const std::vector<float> fixed = fixed_readings(scans);
  const auto seen = fixed.size() - static_cast<std::size_t>(std::count(fixed.begin(), fixed.end(), 0.0F));
  if (seen == 0 || static_cast<double>(seen) > kMostOfBody * static_cast<double>(beams)) return false;
  const auto is_body = [&](std::size_t beam, float range) {
    for (const std::size_t beside : {beam, beam + 1 < beams ? beam + 1 : 0, beam > 0 ? beam - 1 : beams - 1})
      if (fixed[beside] > 0.0F && std::abs(range - fixed[beside]) <= kSamePart) return true;
    return false;
  };
  std::vector<bool> on_rim(beams);
  for (std::size_t beam = 0; beam < beams; ++beam)
    on_rim[beam] = fixed[beam] > 0.0F || fixed[(beam + 1) % beams] > 0.0F || fixed[(beam + beams - 1) % beams] > 0.0F;
  for (LoggedScan* const scan : scans) {
    for (std::size_t beam = 0; beam < beams; ++beam)
      if (is_body(beam, scan->ranges[beam])) scan->ranges[beam] = kNoReading;
    take_out_grazing(scan->ranges, on_rim);
  }
  return true;
}

/// [m]; 0: it answered from nearly as far as its driver says.
double shorter_reach(const Scans& scans) {
  double said = 0.0, farthest = 0.0;
  bool is_silent = false;
  for (const LoggedScan* const scan : scans) {
    said = std::max(said, scan->max_range);
    for (const float range : scan->ranges) {
      is_silent = is_silent || std::isinf(range);
      if (std::isfinite(range)) farthest = std::max(farthest, static_cast<double>(range));
    }
  }
  constexpr double kSteps = 2.0;  // [1/m] so that recordings of one robot share what is made for a reach
  const bool is_short = said > 0.0 && is_silent && farthest > 0.0 && farthest < kShortOfReach * said;
  return is_short && scans.size() >= kFewestSweeps ? std::ceil(kSteps * farthest) / kSteps : 0.0;
}

}  // namespace

void settle_scanners(LaserLog& log, std::span<const std::string> frames) {
  std::map<std::string, Scans> scanners;
  for (std::size_t i = 0; i < log.scans.size(); ++i) scanners[frames[i]].push_back(&log.scans[i]);
  double farthest = 0.0;
  for (const auto& [frame, scans] : scanners) {
    const std::string name = "the laser '" + frame + "' ";
    if (take_zeros(scans, scans.front()->max_range > 0.0 ? scans.front()->max_range : log.max_range))
      log.notes.push_back(name + "writes 0 where nothing comes back: read so");
    if (take_out_body(scans)) log.notes.push_back(name + "sees the robot itself: left out");
    if (const double reach = shorter_reach(scans); reach > 0.0) {
      log.notes.push_back(name + "never answered from beyond " + std::to_string(reach).substr(0, 4) +
                          " m: taken for its reach");
      for (LoggedScan* const scan : scans) scan->max_range = reach;
    }
    farthest = std::max(farthest, scans.front()->max_range);
  }
  if (farthest > 0.0) log.max_range = std::min(log.max_range, farthest);
}

}  // namespace docent::recording
