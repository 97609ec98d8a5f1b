#pragma once

#include <span>
#include <string_view>

#include "docent/modules/shared/module.h"
#include "docent/museum/editing/museum_setup.h"

namespace docent::modules {

struct ModuleEntry {
  const char* name;
  ModuleFactory make;
  ModuleParameters parameters;
  bool is_urgent = false;    ///< braking waits for it: it runs before others (architecture 10.15)
  bool is_prompt = false;    ///< driving waits for it, or what it stamps: it runs before those that may wait
  bool sees_truth = false;   ///< record alone (architecture 10.1)
  bool keeps_cache = false;  ///< uses ModuleContext::cache
  bool explores = false;     ///< runs also while the robot maps a building
  bool guides = true;        ///< runs in a museum that has a map
  bool marks = false;        ///< runs also while a technician drives the robot about in it, and marks what is where
};

/// Every module of the robot, in the order in which they are started.
[[nodiscard]] std::span<const ModuleEntry> all_modules();
/// Whether it runs while the robot does that.
[[nodiscard]] constexpr bool runs(const ModuleEntry& entry, museum::SetupWork work) {
  switch (work) {
    case museum::SetupWork::map:
      return entry.explores;
    case museum::SetupWork::mark:
      return entry.marks;
    case museum::SetupWork::guide:
      break;
  }
  return entry.guides;
}
/// Null: there is none of that name.
[[nodiscard]] const ModuleEntry* find_module(std::string_view name);

}  // namespace docent::modules
