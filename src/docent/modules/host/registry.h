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
};

/// Every module of the robot, in the order in which they are started.
[[nodiscard]] std::span<const ModuleEntry> all_modules();
/// Null: there is none of that name.
[[nodiscard]] const ModuleEntry* find_module(std::string_view name);

}  // namespace docent::modules
