#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "docent/base/result.h"
#include "docent/messages/standard_messages.h"

namespace docent::recording {

/// Reads a message as ROS 1 wrote it: little endian, packed without gaps, texts without an end, and a number before
/// each header's stamp. The messages that matter here have the same fields in ROS 1 and ROS 2.
class Ros1Reader {
 public:
  explicit Ros1Reader(std::span<const std::uint8_t> bytes) : rest_{bytes} {}

  template <class T>
  void operator()(const char* /*name*/, T& field) {
    read(field);
  }
  [[nodiscard]] bool good() const { return good_; }

 private:
  template <class T>
  void read(T& field) {
    if constexpr (std::is_same_v<T, std_msgs::Header>) {
      std::uint32_t sequence = 0;
      read(sequence);
      T::visit(field, *this);
    } else if constexpr (requires { T::kType; }) {
      T::visit(field, *this);
    } else {
      take(&field, sizeof(T));
    }
  }
  void read(std::string& text) {
    std::uint32_t size = 0;
    read(size);
    if (!good_ || size > rest_.size()) return spoil();
    text.assign(reinterpret_cast<const char*>(rest_.data()), size);
    rest_ = rest_.subspan(size);
  }
  template <class T>
  void read(std::vector<T>& items) {
    std::uint32_t count = 0;
    read(count);
    items.clear();
    if (!good_ || count > rest_.size()) return spoil();  // every element takes at least a byte
    if constexpr (std::is_arithmetic_v<T>) {
      if (count > rest_.size() / sizeof(T)) return spoil();
      items.resize(count);
      if (count > 0) take(items.data(), count * sizeof(T));
    } else {
      for (std::uint32_t i = 0; i < count && good_; ++i) read(items.emplace_back());
    }
  }
  template <class T, std::size_t N>
  void read(std::array<T, N>& items) {
    for (auto& item : items) read(item);
  }
  void take(void* data, std::size_t size) {
    if (!good_ || size > rest_.size()) return spoil();
    std::memcpy(data, rest_.data(), size);
    rest_ = rest_.subspan(size);
  }
  void spoil() { good_ = false; }

  std::span<const std::uint8_t> rest_;
  bool good_ = true;
};

template <class T>
[[nodiscard]] Result<T> decode_ros1(std::span<const std::uint8_t> bytes) {
  Ros1Reader reader{bytes};
  T message;
  T::visit(message, reader);
  if (!reader.good()) return fail(std::string{"damaged "} + T::kType);
  return message;
}

/// A message of ROS 1 as ROS 2 has it.
struct ConvertedMessage {
  const char* type;                ///< ROS 2's name of it; null: not one of those that can be converted
  std::vector<std::uint8_t> data;  ///< CDR; what is damaged stays damaged
};
/// @param type  "sensor_msgs/LaserScan", "nav_msgs/Odometry", "tf/tfMessage", "tf2_msgs/TFMessage", "sensor_msgs/Range"
[[nodiscard]] ConvertedMessage converted_from_ros1(const std::string& type, std::span<const std::uint8_t> bytes);

/// What ROS 2 calls a type of ROS 1: "sensor_msgs/msg/PointCloud2" for "sensor_msgs/PointCloud2". One of
/// ROS 2 stays.
[[nodiscard]] std::string ros2_name_of(const std::string& type);

}  // namespace docent::recording
