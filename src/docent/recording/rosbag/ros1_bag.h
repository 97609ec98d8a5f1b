#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/recording/rosbag/rosbag2_database.h"

namespace docent::recording {

/// Reads a bag of ROS 1 (format 2.0, http://wiki.ros.org/Bags/Format/2.0) as it lies in the file, also one that was
/// never closed, until `handler` returns false. Messages that matter here come as ROS 2 has them, others without their
/// data. Topics whose publisher latched them under ROS 1 and are called tf_static keep their names.
/// @param notes  what was left out: damaged chunks, a bag that ends early
/// Error: "FILE: …": unreadable, no bag, or one of another format.
[[nodiscard]] Result<void> read_ros1_bag(const std::filesystem::path& path,
                                         const std::function<bool(const Rosbag2Message&)>& handler,
                                         std::vector<std::string>& notes);

}  // namespace docent::recording
