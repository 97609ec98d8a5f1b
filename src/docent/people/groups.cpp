#include "docent/people/groups.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace docent::people {

Result<void> GroupParams::validate() const {
  if (!(distance > 0.0)) return fail("groups.distance must be > 0");
  if (!(speed > 0.0)) return fail("groups.speed must be > 0");
  if (!(seconds > 0.0)) return fail("groups.seconds must be > 0");
  return {};
}

std::vector<std::uint32_t> Groups::update(std::span<const TrackedPerson> people, Time now) {
  const double passed = std::clamp(to_seconds(now - time_), 0.0, 0.5);
  if (now > time_) time_ = now;
  std::vector<std::size_t> by_id(people.size());
  std::iota(by_id.begin(), by_id.end(), std::size_t{0});
  std::sort(by_id.begin(), by_id.end(), [&](std::size_t a, std::size_t b) { return people[a].id < people[b].id; });
  std::vector<Pair> together;
  std::vector<std::uint32_t> groups(people.size());
  for (std::size_t i = 0; i < people.size(); ++i) groups[i] = people[i].id;
  auto before = together_.begin();
  for (auto i = by_id.begin(); i != by_id.end(); ++i) {
    for (auto j = std::next(i); j != by_id.end(); ++j) {
      const TrackedPerson& one = people[*i];
      const TrackedPerson& other = people[*j];
      const std::pair ids{one.id, other.id};
      while (before != together_.end() && before->ids < ids) ++before;
      const double so_far = before != together_.end() && before->ids == ids ? before->seconds : 0.0;
      const bool is_together = docent::distance(one.position, other.position) < params_.distance &&
                               norm(one.velocity - other.velocity) < params_.speed;
      // Twice the time to join: who leaves is alone soon, a wrong velocity parts nobody.
      const double seconds = std::clamp(so_far + (is_together ? passed : -passed), 0.0, 2.0 * params_.seconds);
      if (seconds <= 0.0) continue;
      together.push_back({ids, seconds});
      if (seconds < params_.seconds) continue;
      const auto [low, high] = std::minmax(groups[*i], groups[*j]);
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

}  // namespace docent::people
