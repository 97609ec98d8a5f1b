#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

// The ROS 2 messages that Docent speaks, field for field. Each type says its name and visits its fields in the order of
// the wire; encoding, schemas and IDL all come from that one visit.

namespace docent {

namespace builtin_interfaces {
struct Time {
  static constexpr const char* kType = "builtin_interfaces/msg/Time";
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("sec", m.sec);
    v("nanosec", m.nanosec);
  }
};
}  // namespace builtin_interfaces

namespace std_msgs {
struct Header {
  static constexpr const char* kType = "std_msgs/msg/Header";
  builtin_interfaces::Time stamp;
  std::string frame_id;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("stamp", m.stamp);
    v("frame_id", m.frame_id);
  }
};
}  // namespace std_msgs

namespace geometry_msgs {
struct Point {
  static constexpr const char* kType = "geometry_msgs/msg/Point";
  double x = 0.0, y = 0.0, z = 0.0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("x", m.x);
    v("y", m.y);
    v("z", m.z);
  }
};
struct Vector3 {
  static constexpr const char* kType = "geometry_msgs/msg/Vector3";
  double x = 0.0, y = 0.0, z = 0.0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("x", m.x);
    v("y", m.y);
    v("z", m.z);
  }
};
struct Quaternion {
  static constexpr const char* kType = "geometry_msgs/msg/Quaternion";
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("x", m.x);
    v("y", m.y);
    v("z", m.z);
    v("w", m.w);
  }
};
struct Pose {
  static constexpr const char* kType = "geometry_msgs/msg/Pose";
  Point position;
  Quaternion orientation;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("position", m.position);
    v("orientation", m.orientation);
  }
};
struct PoseStamped {
  static constexpr const char* kType = "geometry_msgs/msg/PoseStamped";
  std_msgs::Header header;
  Pose pose;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("pose", m.pose);
  }
};
struct PoseWithCovariance {
  static constexpr const char* kType = "geometry_msgs/msg/PoseWithCovariance";
  Pose pose;
  std::array<double, 36> covariance{};  ///< row-major x y z roll pitch yaw
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("pose", m.pose);
    v("covariance", m.covariance);
  }
};
struct PoseWithCovarianceStamped {
  static constexpr const char* kType = "geometry_msgs/msg/PoseWithCovarianceStamped";
  std_msgs::Header header;
  PoseWithCovariance pose;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("pose", m.pose);
  }
};
struct Twist {
  static constexpr const char* kType = "geometry_msgs/msg/Twist";
  Vector3 linear;
  Vector3 angular;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("linear", m.linear);
    v("angular", m.angular);
  }
};
struct TwistStamped {
  static constexpr const char* kType = "geometry_msgs/msg/TwistStamped";
  std_msgs::Header header;
  Twist twist;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("twist", m.twist);
  }
};
struct TwistWithCovariance {
  static constexpr const char* kType = "geometry_msgs/msg/TwistWithCovariance";
  Twist twist;
  std::array<double, 36> covariance{};
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("twist", m.twist);
    v("covariance", m.covariance);
  }
};
struct Transform {
  static constexpr const char* kType = "geometry_msgs/msg/Transform";
  Vector3 translation;
  Quaternion rotation;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("translation", m.translation);
    v("rotation", m.rotation);
  }
};
struct TransformStamped {
  static constexpr const char* kType = "geometry_msgs/msg/TransformStamped";
  std_msgs::Header header;
  std::string child_frame_id;
  Transform transform;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("child_frame_id", m.child_frame_id);
    v("transform", m.transform);
  }
};
}  // namespace geometry_msgs

namespace tf2_msgs {
struct TFMessage {
  static constexpr const char* kType = "tf2_msgs/msg/TFMessage";
  std::vector<geometry_msgs::TransformStamped> transforms;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("transforms", m.transforms);
  }
};
}  // namespace tf2_msgs

namespace sensor_msgs {
struct LaserScan {
  static constexpr const char* kType = "sensor_msgs/msg/LaserScan";
  std_msgs::Header header;
  float angle_min = 0, angle_max = 0, angle_increment = 0;  ///< [rad]
  float time_increment = 0, scan_time = 0;                  ///< [s]
  float range_min = 0, range_max = 0;                       ///< [m]
  std::vector<float> ranges;                                ///< [m]; no return = range_max; invalid = NaN
  std::vector<float> intensities;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("angle_min", m.angle_min);
    v("angle_max", m.angle_max);
    v("angle_increment", m.angle_increment);
    v("time_increment", m.time_increment);
    v("scan_time", m.scan_time);
    v("range_min", m.range_min);
    v("range_max", m.range_max);
    v("ranges", m.ranges);
    v("intensities", m.intensities);
  }
};
struct Range {
  static constexpr const char* kType = "sensor_msgs/msg/Range";
  std_msgs::Header header;
  std::uint8_t radiation_type = 0;  ///< 0 ultrasound, 1 infrared
  float field_of_view = 0;          ///< [rad]
  float min_range = 0, max_range = 0, range = 0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("radiation_type", m.radiation_type);
    v("field_of_view", m.field_of_view);
    v("min_range", m.min_range);
    v("max_range", m.max_range);
    v("range", m.range);
  }
};
struct BatteryState {
  static constexpr const char* kType = "sensor_msgs/msg/BatteryState";
  std_msgs::Header header;
  float voltage = 0, temperature = 0, current = 0, charge = 0, capacity = 0, design_capacity = 0;
  float percentage = 0;                  ///< 0..1
  std::uint8_t power_supply_status = 0;  ///< 1 charging, 2 discharging, 4 full
  std::uint8_t power_supply_health = 0;
  std::uint8_t power_supply_technology = 0;
  bool present = true;
  std::vector<float> cell_voltage;
  std::vector<float> cell_temperature;
  std::string location;
  std::string serial_number;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("voltage", m.voltage);
    v("temperature", m.temperature);
    v("current", m.current);
    v("charge", m.charge);
    v("capacity", m.capacity);
    v("design_capacity", m.design_capacity);
    v("percentage", m.percentage);
    v("power_supply_status", m.power_supply_status);
    v("power_supply_health", m.power_supply_health);
    v("power_supply_technology", m.power_supply_technology);
    v("present", m.present);
    v("cell_voltage", m.cell_voltage);
    v("cell_temperature", m.cell_temperature);
    v("location", m.location);
    v("serial_number", m.serial_number);
  }
};
struct JointState {
  static constexpr const char* kType = "sensor_msgs/msg/JointState";
  std_msgs::Header header;
  std::vector<std::string> name;
  std::vector<double> position;  ///< [rad] of each name; empty: not known
  std::vector<double> velocity;  ///< [rad/s] likewise
  std::vector<double> effort;    ///< [Nm] likewise
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("name", m.name);
    v("position", m.position);
    v("velocity", m.velocity);
    v("effort", m.effort);
  }
};
struct CompressedImage {
  static constexpr const char* kType = "sensor_msgs/msg/CompressedImage";
  std_msgs::Header header;         ///< frame of the camera: x to the right, y down, z into the picture
  std::string format;              ///< "jpeg", or what OpenCV's bridge writes: "bgr8; jpeg compressed bgr8"
  std::vector<std::uint8_t> data;  ///< the file
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("format", m.format);
    v("data", m.data);
  }
};
struct Image {
  static constexpr const char* kType = "sensor_msgs/msg/Image";
  std_msgs::Header header;              ///< frame of the camera: x to the right, y down, z into the picture
  std::uint32_t height = 0, width = 0;  ///< [pixels]
  std::string encoding;                 ///< of a pixel: rgb8, bgr8, rgba8, bgra8, mono8, …
  std::uint8_t is_bigendian = 0;        ///< matters where a channel has more than a byte
  std::uint32_t step = 0;               ///< [bytes] of a row
  std::vector<std::uint8_t> data;       ///< row by row from the top
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("height", m.height);
    v("width", m.width);
    v("encoding", m.encoding);
    v("is_bigendian", m.is_bigendian);
    v("step", m.step);
    v("data", m.data);
  }
};
/// The part of a sensor's picture that a camera hands out.
struct RegionOfInterest {
  static constexpr const char* kType = "sensor_msgs/msg/RegionOfInterest";
  std::uint32_t x_offset = 0, y_offset = 0;  ///< [pixels]
  std::uint32_t height = 0, width = 0;       ///< [pixels]; 0: all
  bool do_rectify = false;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("x_offset", m.x_offset);
    v("y_offset", m.y_offset);
    v("height", m.height);
    v("width", m.width);
    v("do_rectify", m.do_rectify);
  }
};
/// How a camera's lens bends light, sent beside its pictures.
struct CameraInfo {
  static constexpr const char* kType = "sensor_msgs/msg/CameraInfo";
  std_msgs::Header header;              ///< of the picture
  std::uint32_t height = 0, width = 0;  ///< [pixels] at which it was calibrated
  std::string distortion_model;         ///< plumb_bob, equidistant, …
  std::vector<double> d;                ///< coefficients of the model
  std::array<double, 9> k{};            ///< row-major fx 0 cx, 0 fy cy, 0 0 1 [pixels]; all 0: nobody has calibrated it
  std::array<double, 9> r{};            ///< rectification
  std::array<double, 12> p{};           ///< row-major, of the rectified picture [pixels]
  std::uint32_t binning_x = 0, binning_y = 0;  ///< [pixels] of the sensor in one of the picture; 0 as 1
  RegionOfInterest roi;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("height", m.height);
    v("width", m.width);
    v("distortion_model", m.distortion_model);
    v("d", m.d);
    v("k", m.k);
    v("r", m.r);
    v("p", m.p);
    v("binning_x", m.binning_x);
    v("binning_y", m.binning_y);
    v("roi", m.roi);
  }
};
}  // namespace sensor_msgs

namespace nav_msgs {
struct Odometry {
  static constexpr const char* kType = "nav_msgs/msg/Odometry";
  std_msgs::Header header;     ///< frame_id "odom"
  std::string child_frame_id;  ///< "base_link"
  geometry_msgs::PoseWithCovariance pose;
  geometry_msgs::TwistWithCovariance twist;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("child_frame_id", m.child_frame_id);
    v("pose", m.pose);
    v("twist", m.twist);
  }
};
struct MapMetaData {
  static constexpr const char* kType = "nav_msgs/msg/MapMetaData";
  builtin_interfaces::Time map_load_time;
  float resolution = 0;  ///< [m/cell]
  std::uint32_t width = 0, height = 0;
  geometry_msgs::Pose origin;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("map_load_time", m.map_load_time);
    v("resolution", m.resolution);
    v("width", m.width);
    v("height", m.height);
    v("origin", m.origin);
  }
};
struct OccupancyGrid {
  static constexpr const char* kType = "nav_msgs/msg/OccupancyGrid";
  std_msgs::Header header;
  MapMetaData info;
  std::vector<std::int8_t> data;  ///< row-major from the lower left; -1 unknown, 0..100
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("info", m.info);
    v("data", m.data);
  }
};
struct Path {
  static constexpr const char* kType = "nav_msgs/msg/Path";
  std_msgs::Header header;
  std::vector<geometry_msgs::PoseStamped> poses;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("poses", m.poses);
  }
};
}  // namespace nav_msgs

namespace diagnostic_msgs {
struct KeyValue {
  static constexpr const char* kType = "diagnostic_msgs/msg/KeyValue";
  std::string key, value;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("key", m.key);
    v("value", m.value);
  }
};
struct DiagnosticStatus {
  static constexpr const char* kType = "diagnostic_msgs/msg/DiagnosticStatus";
  static constexpr const char* kOctetField = "level";  ///< a `byte` to ROS 2, which is another type than uint8
  std::uint8_t level = 0;                              ///< 0 ok, 1 warn, 2 error, 3 stale
  std::string name, message, hardware_id;
  std::vector<KeyValue> values;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("level", m.level);
    v("name", m.name);
    v("message", m.message);
    v("hardware_id", m.hardware_id);
    v("values", m.values);
  }
};
struct DiagnosticArray {
  static constexpr const char* kType = "diagnostic_msgs/msg/DiagnosticArray";
  std_msgs::Header header;
  std::vector<DiagnosticStatus> status;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("status", m.status);
  }
};
}  // namespace diagnostic_msgs

}  // namespace docent
