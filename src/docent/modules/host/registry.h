#pragma once

#include <span>
#include <string_view>

#include "docent/modules/shared/module.h"

namespace docent::modules {

struct ModuleEntry {
  const char* name;
  ModuleFactory make;
  ModuleParameters parameters;
  bool is_urgent = false;    ///< runs at higher priority (architecture 10.15)
  bool sees_truth = false;   ///< record alone (architecture 10.1)
  bool keeps_cache = false;  ///< uses ModuleContext::cache
  bool explores = false;     ///< runs also while the robot maps a building by itself
  bool guides = true;        ///< runs in a museum that has a map
};

/// Every module of the robot, in the order in which they are started.
[[nodiscard]] std::span<const ModuleEntry> all_modules();
/// Whether it runs while the robot explores, or else while it guides.
[[nodiscard]] constexpr bool runs(const ModuleEntry& entry, bool is_exploring) {
  return is_exploring ? entry.explores : entry.guides;
}
/// Null: there is none of that name.
[[nodiscard]] const ModuleEntry* find_module(std::string_view name);

}  // namespace docent::modules
