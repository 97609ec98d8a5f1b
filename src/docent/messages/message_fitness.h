#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "docent/messages/calibration_messages.h"
#include "docent/messages/cdr.h"
#include "docent/messages/localization_messages.h"
#include "docent/messages/operation_messages.h"
#include "docent/messages/people_messages.h"
#include "docent/messages/sensing_messages.h"
#include "docent/messages/standard_messages.h"

// What comes from outside, by DDS or from a file, decodes and may yet hold what no sensor ever measured: numbers that
// are none, places beyond the Earth, a million beams. It is looked at once, where it comes in (Bus::subscribe,
// RosLaserLogBuilder); behind that, nobody needs to.

namespace docent {

inline constexpr double kMostAnything = 1e7;             ///< any number; in [m] a quarter of the way round the Earth
inline constexpr double kFarthestReading = 1000.0;       ///< [m] of any sensor's reach
inline constexpr double kFastest = 100.0;                ///< [m/s], [rad/s] of any base
inline constexpr double kWidestPose = 10.0;              ///< [m] standard deviation; wider names no place
inline constexpr std::size_t kMostBeams = 10000;         ///< of one scan
inline constexpr std::size_t kMostBelievedCells = 8192;  ///< architecture 10.5
inline constexpr std::size_t kMostItems = 1000000;       ///< of any list
inline constexpr std::size_t kMostText = 100000;         ///< [bytes]
inline constexpr std::size_t kMostPictureBytes = 2'000'000;  ///< of a compressed picture
inline constexpr std::size_t kMostImageBytes = 64'000'000;   ///< of one that is not compressed
inline constexpr std::size_t kLongestFrame = 255;            ///< [bytes] of a frame's name

/// What is wrong with a message; both null: nothing.
struct MessageFault {
  const char* field = nullptr;
  const char* what = nullptr;
  explicit operator bool() const { return field != nullptr; }
  [[nodiscard]] std::string text() const { return std::string{field} + " " + what; }
};

/// Beams that no scanner has: not in order, more than twice round, or without a reach. The readings themselves may be
/// anything: what is not between the least and the greatest range is none.
[[nodiscard]] MessageFault fault_of(const sensor_msgs::LaserScan& scan);
/// Of virtual measurements, which are one scan of two turns: a distance in each direction to the hazards, which bind
/// the robot's body, then in each to the area's border, which binds its centre. A scan of one turn would be one without
/// a border, and one with a gap would be free there.
[[nodiscard]] MessageFault fault_of_virtual_scan(const sensor_msgs::LaserScan& scan);
/// Of a place that the robot is told: in the map's frame, and so sure of it that it names a place. Of the covariance x,
/// y and yaw count.
[[nodiscard]] MessageFault fault_of_initial_pose(const geometry_msgs::PoseWithCovarianceStamped& pose);
/// Of a place to go to: in the map's frame.
[[nodiscard]] MessageFault fault_of_goal_pose(const geometry_msgs::PoseStamped& pose);
/// Likewise the reading itself may be anything.
[[nodiscard]] MessageFault fault_of(const sensor_msgs::Range& range);
/// Only the charge counts: drivers leave what they do not measure at any value.
[[nodiscard]] MessageFault fault_of(const sensor_msgs::BatteryState& battery);
/// A file of some size, also an empty one, as markers hold; whether it is a picture, pictures/jpeg knows.
[[nodiscard]] MessageFault fault_of(const sensor_msgs::CompressedImage& picture);
/// Rows that fill it; whether the page can show it, modules/web knows.
[[nodiscard]] MessageFault fault_of(const sensor_msgs::Image& picture);
[[nodiscard]] MessageFault fault_of(const docent_msgs::CameraView& view);
[[nodiscard]] MessageFault fault_of(const docent_msgs::Steering& steering);
/// Likewise covariances are not looked at.
[[nodiscard]] MessageFault fault_of(const nav_msgs::Odometry& odometry);
[[nodiscard]] MessageFault fault_of(const nav_msgs::OccupancyGrid& map);
[[nodiscard]] MessageFault fault_of(const builtin_interfaces::Time& time);
[[nodiscard]] MessageFault fault_of(const std_msgs::Header& header);
/// Of length 1.
[[nodiscard]] MessageFault fault_of(const geometry_msgs::Quaternion& rotation);
[[nodiscard]] MessageFault fault_of(const docent_msgs::Belief& belief);
[[nodiscard]] MessageFault fault_of(const docent_msgs::PersonBeams& beams);
[[nodiscard]] MessageFault fault_of(const docent_msgs::LiveMapUpdate& update);
[[nodiscard]] MessageFault fault_of(const docent_msgs::Limits& limits);
/// Mounts on a robot, and scales of some base.
[[nodiscard]] MessageFault fault_of(const docent_msgs::Calibration& calibration);
/// Any other message: each number is one and not beyond `kMostAnything`, no list and no text is endless.
template <Message T>
[[nodiscard]] MessageFault fault_of(const T& message);

/// Visits all fields of a message. O(size of the message), without a branch for each number of a list.
class FitnessCheck {
 public:
  template <class T>
  void operator()(const char* name, const T& field) {
    check(name, field);
  }
  void note(const char* name, const char* what) {
    if (!fault_) fault_ = {name, what};
  }
  [[nodiscard]] MessageFault fault() const { return fault_; }

 private:
  static constexpr const char* kNoNumber = "is no number of this world";

  template <class T>
  static bool is_good(const T& number) {
    if constexpr (std::is_floating_point_v<T>) return std::abs(number) <= static_cast<T>(kMostAnything);
    return true;
  }
  template <class T>
  void check(const char* name, const T& field) {
    if constexpr (Message<T>) {
      if (const MessageFault fault = fault_of(field); fault && !fault_) fault_ = fault;
    } else if (!is_good(field)) {
      note(name, kNoNumber);
    }
  }
  void check(const char* name, const std::string& text) {
    if (text.size() > kMostText) note(name, "is too long");
  }
  template <class T>
  void check(const char* name, const std::vector<T>& items) {
    if (sizeof(T) > 1 && items.size() > kMostItems) return note(name, "has too many entries");
    check_items(name, items);
  }
  template <class T, std::size_t N>
  void check(const char* name, const std::array<T, N>& items) {
    check_items(name, items);
  }
  template <class Items>
  void check_items(const char* name, const Items& items) {
    using Item = typename Items::value_type;
    if constexpr (std::is_floating_point_v<Item>) {
      bool good = true;
      for (const Item item : items) good &= is_good(item);
      if (!good) note(name, kNoNumber);
    } else if constexpr (!std::is_arithmetic_v<Item>) {
      for (const Item& item : items) check(name, item);
    }
  }

  MessageFault fault_;
};

/// The fields alone.
template <Message T>
[[nodiscard]] MessageFault fault_of_fields(const T& message) {
  FitnessCheck check;
  T::visit(message, check);
  return check.fault();
}
template <Message T>
[[nodiscard]] MessageFault fault_of(const T& message) {
  return fault_of_fields(message);
}

}  // namespace docent
