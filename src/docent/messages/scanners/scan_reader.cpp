#include "docent/messages/scanners/scan_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace docent {
namespace {

constexpr float kOtherUnit = 8.0F;  // of the reach: no driver states so little

std::string metres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f m", value);
  return text;
}

}  // namespace

void ScanReader::put_in_order(const DriverScan& written) {
  const double side = traits_.is_upside_down ? -1.0 : 1.0;
  ranges_.assign(written.ranges.begin(), written.ranges.end());
  scan_ = written;
  scan_.first_bearing = side * written.first_bearing;
  scan_.bearing_step = side * written.bearing_step;
  if (scan_.bearing_step < 0.0 && !ranges_.empty()) {
    scan_.first_bearing += scan_.bearing_step * static_cast<double>(ranges_.size() - 1);
    scan_.bearing_step = -scan_.bearing_step;
    std::reverse(ranges_.begin(), ranges_.end());
  }
}

const DriverScan& ScanReader::read(const DriverScan& written) {
  put_in_order(written);
  said_reach_ = written.max_range;
  if (traits_.max_range > 0.0) scan_.max_range = std::min(scan_.max_range, traits_.max_range);
  if (traits_.zero == ZeroMeans::find_out) zeros_.add(ranges_, scan_.bearing_step, scan_.min_range, written.max_range);
  body_.take_out(ranges_, scan_.first_bearing, scan_.bearing_step, scan_.min_range);
  const bool zero_is_nothing = zero() == ZeroMeans::nothing;
  const auto reach = static_cast<float>(scan_.max_range);
  for (float& range : ranges_) {
    // What lies so far beyond is no metre at all, and stays for those who look at units.
    const bool is_other_unit = std::isfinite(range) && range > kOtherUnit * static_cast<float>(said_reach_);
    if ((range >= reach && !is_other_unit) || (range == 0.0F && zero_is_nothing)) range = reach;
    if (!(range > 0.0F)) range = std::numeric_limits<float>::quiet_NaN();
  }
  scan_.ranges = ranges_;
  note_answers();
  return scan_;
}

void ScanReader::note_answers() {
  constexpr double kMemory = 0.05;  // a sweep's share in the running mean
  const auto reach = static_cast<float>(scan_.max_range);
  const auto fit = std::count_if(ranges_.begin(), ranges_.end(), [](float range) { return !std::isnan(range); });
  const auto met = std::count_if(ranges_.begin(), ranges_.end(), [reach](float range) { return range < reach; });
  if (fit > 0) answered_ += kMemory * (static_cast<double>(met) / static_cast<double>(fit) - answered_);
}

std::string ScanReader::hindrance() const {
  constexpr double kLittle = 0.25;  // halls in which one place looks like another for a scanner of 4 m are so
  if (answered_ >= kLittle) return {};
  return "meets something in " + std::to_string(std::lround(100.0 * answered_)) +
         " % of its directions only: little stands within its " + metres(scan_.max_range);
}

std::vector<std::string> ScanReader::notes() const {
  constexpr double kSameReach = 0.05;  // of the reach
  std::vector<std::string> notes;
  if (traits_.max_range > 0.0 && said_reach_ > 0.0 &&
      std::abs(said_reach_ - traits_.max_range) > kSameReach * traits_.max_range)
    notes.push_back("says that it looks " + metres(said_reach_) + " far, body.scanners says " +
                    metres(traits_.max_range));
  if (const std::string where = body_.where(); !where.empty())
    notes.push_back("sees the robot itself at " + where + " degrees: left out");
  if (body_.is_too_much()) notes.emplace_back("sees much inside body.radius: it is covered, or that is too large");
  if (traits_.zero == ZeroMeans::find_out && zeros_.found() == ZeroMeans::nothing)
    notes.emplace_back("writes 0 where nothing comes back: read so");
  return notes;
}

}  // namespace docent
