#include "docent/people/groups.h"

#include <algorithm>

namespace docent {

Result<void> GroupParams::validate() const {
  if (!(distance > 0.0)) return fail("groups.distance must be > 0");
  if (!(speed > 0.0)) return fail("groups.speed must be > 0");
  if (!(seconds > 0.0)) return fail("groups.seconds must be > 0");
  return {};
}

std::vector<std::uint32_t> Groups::update(std::span<const TrackedPerson> people, Time now) {
  const double passed = std::clamp(to_seconds(now - time_), 0.0, 0.5);
  if (now > time_) time_ = now;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> together;
  std::vector<std::uint32_t> groups(people.size());
  for (std::size_t i = 0; i < people.size(); ++i) groups[i] = people[i].id;
  for (std::size_t i = 0; i < people.size(); ++i) {
    for (std::size_t j = i + 1; j < people.size(); ++j) {
      const auto key = std::minmax(people[i].id, people[j].id);
      const auto before = together_.find(key);
      const double so_far = before == together_.end() ? 0.0 : before->second;
      const bool is_together = docent::distance(people[i].position, people[j].position) < params_.distance &&
                               norm(people[i].velocity - people[j].velocity) < params_.speed;
      // Twice the time to join: who leaves is alone soon, a wrong velocity parts nobody.
      const double seconds = std::clamp(so_far + (is_together ? passed : -passed), 0.0, 2.0 * params_.seconds);
      if (seconds <= 0.0) continue;
      together[key] = seconds;
      if (seconds < params_.seconds) continue;
      const auto [low, high] = std::minmax(groups[i], groups[j]);
      const std::uint32_t from = high;
      const std::uint32_t to = low;
      std::replace(groups.begin(), groups.end(), from, to);
    }
  }
  together_ = std::move(together);
  std::vector<std::uint32_t> result(groups);
  for (std::size_t i = 0; i < groups.size(); ++i)
    if (std::count(groups.begin(), groups.end(), groups[i]) == 1) result[i] = 0;
  return result;
}

}  // namespace docent
