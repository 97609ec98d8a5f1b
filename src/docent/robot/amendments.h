#pragma once

#include <functional>
#include <map>
#include <typeindex>
#include <utility>
#include <vector>

namespace docent::robot {

/// What somebody outside the robot changes in its parts when they are made: functions by the type that they change. A
/// robot has none; a laboratory has, to compare it with what it is not.
class Amendments {
 public:
  template <class Part>
  void add(std::function<void(Part&)> amendment) {
    by_type_[typeid(Part)].push_back(
        [amendment = std::move(amendment)](void* part) { amendment(*static_cast<Part*>(part)); });
  }
  /// All that were added for exactly this type, in their order.
  template <class Part>
  void apply(Part& part) const {
    const auto found = by_type_.find(typeid(Part));
    if (found == by_type_.end()) return;
    for (const auto& amendment : found->second) amendment(&part);
  }

 private:
  std::map<std::type_index, std::vector<std::function<void(void*)>>> by_type_;
};

}  // namespace docent::robot
