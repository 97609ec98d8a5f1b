#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"

namespace docent::recording {

/// When ranges cannot be metres of a laser in a building.
struct RecordedRangesParams {
  double beyond = 8.0;       ///< of its own range_max: no driver states so little, so these are no metres
  double many = 0.1;         ///< of a laser's readings,
  double few = 0.1;          ///< and at most so many within reach
  double farthest = 100.0;   ///< [m] of most readings: no building that a tour guide drives in
  std::size_t several = 20;  ///< different readings: a constant is a driver's way to say "nothing"
};

/// Whether the ranges of a recording can be those of a laser in a building, for each of its lasers.
class RecordedRanges {
 public:
  /// Nothing has been added yet.
  explicit RecordedRanges(const RecordedRangesParams& params = {}) : params_{params} {}

  /// One scan. @param laser  for a person: its topic or frame @param ranges  [m] as they were recorded
  void add(const std::string& laser, std::span<const float> ranges, double range_max);
  /// Error: what is wrong, where no laser is left that can be right. Else what is wrong of single lasers, into `notes`.
  [[nodiscard]] Result<void> judge(std::vector<std::string>& notes) const;

 private:
  struct Laser {
    std::uint64_t scans = 0;
    std::uint64_t readings = 0;
    std::uint64_t answers = 0;  ///< above 0 and below range_max
    std::uint64_t beyond = 0;
    std::uint64_t far = 0;
    std::vector<float> different;  ///< of those beyond, as many as matter
    double range_max = 0.0;
  };
  [[nodiscard]] std::string fault_of(const std::string& name, const Laser& laser) const;

  RecordedRangesParams params_;
  std::map<std::string, Laser> lasers_;
};

}  // namespace docent::recording
