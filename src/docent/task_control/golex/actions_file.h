#pragma once

#include <string>

namespace docent::task_control {

/// The text of actions.yaml, as it was at the build (see CMakeLists.txt).
[[nodiscard]] const std::string& actions_file();

}  // namespace docent::task_control
