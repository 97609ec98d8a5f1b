#include "docent/recording/rosbag/ros1_messages.h"

#include "docent/messages/cdr.h"

namespace docent::recording {
namespace {

template <class T>
ConvertedMessage converted(std::span<const std::uint8_t> bytes) {
  const auto message = decode_ros1<T>(bytes);
  return {T::kType, message ? encode_cdr(*message) : std::vector<std::uint8_t>{}};
}

}  // namespace

ConvertedMessage converted_from_ros1(const std::string& type, std::span<const std::uint8_t> bytes) {
  if (type == "sensor_msgs/LaserScan") return converted<sensor_msgs::LaserScan>(bytes);
  if (type == "nav_msgs/Odometry") return converted<nav_msgs::Odometry>(bytes);
  if (type == "tf/tfMessage" || type == "tf2_msgs/TFMessage") return converted<tf2_msgs::TFMessage>(bytes);
  if (type == "sensor_msgs/Range") return converted<sensor_msgs::Range>(bytes);
  return {nullptr, {}};
}

std::string ros2_name_of(const std::string& type) {
  const std::size_t slash = type.find('/');
  const bool is_of_ros1 = slash != std::string::npos && type.find('/', slash + 1) == std::string::npos;
  return is_of_ros1 ? type.substr(0, slash) + "/msg" + type.substr(slash) : type;
}

}  // namespace docent::recording
