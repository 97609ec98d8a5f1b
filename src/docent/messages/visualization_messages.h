#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "docent/messages/standard_messages.h"

// What rviz2, Foxglove and Lichtblick draw: ROS 2's messages as they are from Humble on, field for field.

namespace docent {

namespace builtin_interfaces {
struct Duration {
  static constexpr const char* kType = "builtin_interfaces/msg/Duration";
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
struct ColorRGBA {
  static constexpr const char* kType = "std_msgs/msg/ColorRGBA";
  float r = 0, g = 0, b = 0, a = 0;  ///< 0..1
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("r", m.r);
    v("g", m.g);
    v("b", m.b);
    v("a", m.a);
  }
};
}  // namespace std_msgs

namespace geometry_msgs {
struct PoseArray {
  static constexpr const char* kType = "geometry_msgs/msg/PoseArray";
  std_msgs::Header header;
  std::vector<Pose> poses;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("poses", m.poses);
  }
};
}  // namespace geometry_msgs

namespace visualization_msgs {
struct UVCoordinate {
  static constexpr const char* kType = "visualization_msgs/msg/UVCoordinate";
  float u = 0, v = 0;
  template <class Self, class V>
  static void visit(Self& m, V& visitor) {
    visitor("u", m.u);
    visitor("v", m.v);
  }
};
struct MeshFile {
  static constexpr const char* kType = "visualization_msgs/msg/MeshFile";
  std::string filename;
  std::vector<std::uint8_t> data;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("filename", m.filename);
    v("data", m.data);
  }
};
struct Marker {
  static constexpr const char* kType = "visualization_msgs/msg/Marker";
  static constexpr std::int32_t kArrow = 0, kCylinder = 3, kLineStrip = 4;  ///< of `type`, those that Docent draws
  std_msgs::Header header;
  std::string ns;  ///< with `id` the marker's name: who says it again moves it
  std::int32_t id = 0;
  std::int32_t type = kArrow;
  std::int32_t action = 0;  ///< 0 add or change, 2 delete, 3 delete all
  geometry_msgs::Pose pose;
  geometry_msgs::Vector3 scale;           ///< [m]
  std_msgs::ColorRGBA color;              ///< of alpha 0 nothing is seen
  builtin_interfaces::Duration lifetime;  ///< 0: for ever
  bool frame_locked = false;
  std::vector<geometry_msgs::Point> points;
  std::vector<std_msgs::ColorRGBA> colors;
  std::string texture_resource;
  sensor_msgs::CompressedImage texture;
  std::vector<UVCoordinate> uv_coordinates;
  std::string text;
  std::string mesh_resource;
  MeshFile mesh_file;
  bool mesh_use_embedded_materials = false;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("ns", m.ns);
    v("id", m.id);
    v("type", m.type);
    v("action", m.action);
    v("pose", m.pose);
    v("scale", m.scale);
    v("color", m.color);
    v("lifetime", m.lifetime);
    v("frame_locked", m.frame_locked);
    v("points", m.points);
    v("colors", m.colors);
    v("texture_resource", m.texture_resource);
    v("texture", m.texture);
    v("uv_coordinates", m.uv_coordinates);
    v("text", m.text);
    v("mesh_resource", m.mesh_resource);
    v("mesh_file", m.mesh_file);
    v("mesh_use_embedded_materials", m.mesh_use_embedded_materials);
  }
};
struct MarkerArray {
  static constexpr const char* kType = "visualization_msgs/msg/MarkerArray";
  std::vector<Marker> markers;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("markers", m.markers);
  }
};
}  // namespace visualization_msgs

}  // namespace docent
