#include "docent/recording/recorded_ranges.h"

#include <algorithm>
#include <cmath>

namespace docent::recording {
namespace {

std::string in_metres(double range) {
  std::string digits = std::to_string(range);
  digits.resize(digits.find('.') + 2);
  return digits;
}

}  // namespace

void RecordedRanges::add(const std::string& laser, std::span<const float> ranges, double range_max) {
  Laser& seen = lasers_[laser];
  ++seen.scans;
  seen.readings += ranges.size();
  seen.range_max = range_max;
  for (const float range : ranges) {
    if (!std::isfinite(range) || !(range > 0.0F)) continue;
    if (range < range_max) {
      ++seen.answers;
      if (range > params_.farthest) ++seen.far;
    } else if (range > params_.beyond * range_max) {
      ++seen.beyond;
      if (seen.different.size() < params_.several &&
          std::find(seen.different.begin(), seen.different.end(), range) == seen.different.end())
        seen.different.push_back(range);
    }
  }
}

std::string RecordedRanges::fault_of(const std::string& name, const Laser& laser) const {
  const std::string scans = std::to_string(laser.scans) + (laser.scans == 1 ? " scan" : " scans");
  const bool is_beyond = static_cast<double>(laser.beyond) >= params_.many * static_cast<double>(laser.readings) &&
                         static_cast<double>(laser.answers) <= params_.few * static_cast<double>(laser.readings) &&
                         laser.different.size() >= params_.several;
  if (laser.readings > 0 && is_beyond) {
    const auto [least, most] = std::minmax_element(laser.different.begin(), laser.different.end());
    return "the distances of " + name + " are not in metres: in " + scans + " there are readings like " +
           in_metres(static_cast<double>(*least)) + " and " + in_metres(static_cast<double>(*most)) +
           " where range_max is " + in_metres(laser.range_max);
  }
  if (laser.answers == 0) return "no beam of " + name + " ends anywhere, in " + scans;
  if (2 * laser.far > laser.answers)
    return "the distances of " + name + " are not in metres: most are above " + in_metres(params_.farthest);
  return "";
}

Result<void> RecordedRanges::judge(std::vector<std::string>& notes) const {
  std::vector<std::string> faults;
  for (const auto& [name, laser] : lasers_)
    if (auto fault = fault_of(name, laser); !fault.empty()) faults.push_back(std::move(fault));
  if (!lasers_.empty() && faults.size() == lasers_.size()) return fail(faults.front());
  notes.insert(notes.end(), faults.begin(), faults.end());
  return {};
}

}  // namespace docent::recording
