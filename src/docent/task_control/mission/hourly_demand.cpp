#include "docent/task_control/mission/hourly_demand.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

namespace docent::task_control {
namespace {

constexpr double kLongestGap = 10.0;        // [s] between two looks: more is a time when it was not running
constexpr double kStoreAfter = 1.0 / 60.0;  // [h] of news: a disk is not written twice a second

std::string name_of(std::size_t hour) {
  return {static_cast<char>('0' + hour / 10), static_cast<char>('0' + hour % 10)};
}

}  // namespace

void HourlyDemand::restore(std::span<const LessonRow> rows) {
  for (const LessonRow& row : rows) {
    if (row.key.kind != LessonKind::demand) continue;
    const auto hour = static_cast<std::size_t>(std::atoi(row.key.from.c_str()));
    const bool is_sound = hour < hours_.size() && std::isfinite(row.lesson.count) && std::isfinite(row.lesson.sum) &&
                          row.lesson.count >= 0.0 && row.lesson.sum >= 0.0 && row.lesson.sum <= row.lesson.count;
    if (is_sound) hours_.at(hour) = {row.lesson.count, row.lesson.sum, row.lesson.count};
  }
}

void HourlyDemand::observe(int hour, bool is_wanted, Time now) {
  const double passed_s = observed_ ? to_seconds(now - *observed_) : 0.0;
  observed_ = now;
  if (passed_s <= 0.0 || passed_s > kLongestGap || hour < 0 || hour >= static_cast<int>(hours_.size())) return;
  const auto index = static_cast<std::size_t>(hour);
  Hour& known = hours_.at(index);
  const double passed = passed_s / 3600.0;
  const double kept = std::min(1.0, kMemoryHours / (known.seen + passed));
  known.seen = kept * (known.seen + passed);
  known.wanted = kept * (known.wanted + (is_wanted ? passed : 0.0));
  known.told -= passed;  // of a memory that is full, too
  if (known.seen - known.told < kStoreAfter) return;
  known.told = known.seen;
  unstored_.at(index) = true;
}

double HourlyDemand::share(int hour) const {
  Hour all;
  for (const Hour& known : hours_) {
    all.seen += known.seen;
    all.wanted += known.wanted;
  }
  const double of_all = (kPriorHours * kPrior + all.wanted) / (kPriorHours + all.seen);
  const Hour& known = hours_.at(static_cast<std::size_t>(std::clamp(hour, 0, 23)));
  return (kOthersHours * of_all + known.wanted) / (kOthersHours + known.seen);
}

std::vector<LessonRow> HourlyDemand::unstored() const {
  std::vector<LessonRow> rows;
  for (std::size_t hour = 0; hour < hours_.size(); ++hour) {
    if (!unstored_.at(hour)) continue;
    const Hour& known = hours_.at(hour);
    rows.push_back({{LessonKind::demand, name_of(hour)}, {known.seen, known.wanted, 0.0, 0.0}});
  }
  return rows;
}

}  // namespace docent::task_control
