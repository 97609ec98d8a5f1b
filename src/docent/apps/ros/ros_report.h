#pragma once

#include <string>

#include "docent/apps/ros/ros_check.h"

namespace docent::apps::ros {

/// For a person: settings, who is heard, what each topic is worth, what ROS 2's side must be told.
/// @param health  docent/health on the wire: by it Docent's own programs are told from others
[[nodiscard]] std::string text_of(const Check& check, const std::string& health);
/// The same for a program.
[[nodiscard]] std::string json_of(const Check& check, const std::string& health);

}  // namespace docent::apps::ros
