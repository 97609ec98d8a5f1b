#pragma once

#include <fastcdr/Cdr.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

// Messages of ROS 2 as their .msg files have them, put into bytes by Fast CDR: nothing here comes from Docent, so that
// a mistake in Docent's messages or its CDR is not made twice.

namespace second_vendor {

/// Of a message T whose `fields` hands over its fields in their order: what Fast CDR asks for.
template <class T>
struct OnWire {
  void serialize(eprosima::fastcdr::Cdr& cdr) const {
    T::fields(static_cast<const T&>(*this), [&cdr](const auto&... field) { (void(cdr << field), ...); });
  }
  void deserialize(eprosima::fastcdr::Cdr& cdr) {
    T::fields(static_cast<T&>(*this), [&cdr](auto&... field) { (void(cdr >> field), ...); });
  }
};

struct Time : OnWire<Time> {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  template <class Self, class F>
  static void fields(Self& m, F&& f) {
    f(m.sec, m.nanosec);
  }
};
struct Header : OnWire<Header> {
  Time stamp;
  std::string frame_id;
  template <class Self, class F>
  static void fields(Self& m, F&& f) {
    f(m.stamp, m.frame_id);
  }
};
/// Point and Vector3: they look alike on the wire.
struct Vector3 : OnWire<Vector3> {
  double x = 0.0, y = 0.0, z = 0.0;
  template <class Self, class F>
  static void fields(Self& m, F&& f) {
    f(m.x, m.y, m.z);
  }
};
struct Quaternion : OnWire<Quaternion> {
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
  template <class Self, class F>
  static void fields(Self& m, F&& f) {
    f(m.x, m.y, m.z, m.w);
  }
};
/// Pose and Transform.
struct Pose : OnWire<Pose> {
  Vector3 position;
  Quaternion orientation;
  template <class Self, class F>
  static void fields(Self& m, F&& f) {
    f(m.position, m.orientation);
  }
};
struct PoseWithCovariance : OnWire<PoseWithCovariance> {
  Pose pose;
  std::array<double, 36> covariance{};
  template <class Self, class F>
  static void fields(Self& m, F&& f) {
    f(m.pose, m.covariance);
  }
};

/// A topic's type says its DDS name and the type hash that ROS 2 (Iron and later) prints for it
/// (`ros2 topic info --verbose`).
struct Twist : OnWire<Twist> {
  static constexpr const char* kName = "geometry_msgs::msg::dds_::Twist_";
  static constexpr const char* kHash = "RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a";
  Vector3 linear;
  Vector3 angular;
  template <class Self, class F>
  static void fields(Self& m, F&& f) {
    f(m.linear, m.angular);
  }
};
struct TwistStamped : OnWire<TwistStamped> {
  static constexpr const char* kName = "geometry_msgs::msg::dds_::TwistStamped_";
  static constexpr const char* kHash = "RIHS01_5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64";
  Header header;
  Twist twist;
  template <class Self, class F>
  static void fields(Self& m, F&& f) {
    f(m.header, m.twist);
  }
};
struct Odometry : OnWire<Odometry> {
  static constexpr const char* kName = "nav_msgs::msg::dds_::Odometry_";
  static constexpr const char* kHash = "RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0";
  Header header;
  std::string child_frame_id;
  PoseWithCovariance pose;
  Twist twist;
  std::array<double, 36> twist_covariance{};
  template <class Self, class F>
  static void fields(Self& m, F&& f) {
    f(m.header, m.child_frame_id, m.pose, m.twist, m.twist_covariance);
  }
};
struct LaserScan : OnWire<LaserScan> {
  static constexpr const char* kName = "sensor_msgs::msg::dds_::LaserScan_";
  static constexpr const char* kHash = "RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828";
  Header header;
  float angle_min = 0, angle_max = 0, angle_increment = 0, time_increment = 0, scan_time = 0;
  float range_min = 0, range_max = 0;
  std::vector<float> ranges;
  std::vector<float> intensities;
  template <class Self, class F>
  static void fields(Self& m, F&& f) {
    f(m.header, m.angle_min, m.angle_max, m.angle_increment, m.time_increment, m.scan_time, m.range_min, m.range_max,
      m.ranges, m.intensities);
  }
};
struct BatteryState : OnWire<BatteryState> {
  static constexpr const char* kName = "sensor_msgs::msg::dds_::BatteryState_";
  static constexpr const char* kHash = "RIHS01_4bee5dfce981c98faa6828b868307a0a73f992ed0789f374ee96c8f840e69741";
  Header header;
  float voltage = 0, temperature = 0, current = 0, charge = 0, capacity = 0, design_capacity = 0, percentage = 0;
  std::uint8_t status = 0, health = 0, technology = 0;
  bool present = false;
  std::vector<float> cell_voltage, cell_temperature;
  std::string location, serial_number;
  template <class Self, class F>
  static void fields(Self& m, F&& f) {
    f(m.header, m.voltage, m.temperature, m.current, m.charge, m.capacity, m.design_capacity, m.percentage, m.status,
      m.health, m.technology, m.present, m.cell_voltage, m.cell_temperature, m.location, m.serial_number);
  }
};
struct TransformStamped : OnWire<TransformStamped> {
  Header header;
  std::string child_frame_id;
  Pose transform;
  template <class Self, class F>
  static void fields(Self& m, F&& f) {
    f(m.header, m.child_frame_id, m.transform);
  }
};
struct TFMessage : OnWire<TFMessage> {
  static constexpr const char* kName = "tf2_msgs::msg::dds_::TFMessage_";
  static constexpr const char* kHash = "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087";
  std::vector<TransformStamped> transforms;
  template <class Self, class F>
  static void fields(Self& m, F&& f) {
    f(m.transforms);
  }
};
struct OccupancyGrid : OnWire<OccupancyGrid> {
  static constexpr const char* kName = "nav_msgs::msg::dds_::OccupancyGrid_";
  static constexpr const char* kHash = "";  // nobody here says it
  Header header;
  Time map_load_time;
  float resolution = 0;
  std::uint32_t width = 0, height = 0;
  Pose origin;
  std::vector<std::int8_t> data;
  template <class Self, class F>
  static void fields(Self& m, F&& f) {
    f(m.header, m.map_load_time, m.resolution, m.width, m.height, m.origin, m.data);
  }
};

}  // namespace second_vendor
