#include "docent/visualization/museum_markers.h"

#include <cstdint>

namespace docent::visualization {
namespace {

constexpr double kWidth = 0.05;  // [m] of a line: a cell of the map
constexpr std_msgs::ColorRGBA kBorder{0.3F, 0.7F, 0.3F, 1.0F};
constexpr std_msgs::ColorRGBA kHazard{0.9F, 0.1F, 0.1F, 1.0F};

visualization_msgs::Marker outline(const Polygon& polygon, const char* group, std::size_t id,
                                   const std_msgs::ColorRGBA& color) {
  visualization_msgs::Marker marker;
  marker.header.frame_id = "map";
  marker.ns = group;
  marker.id = static_cast<std::int32_t>(id);
  marker.type = visualization_msgs::Marker::kLineStrip;
  marker.scale = {kWidth, 0.0, 0.0};
  marker.color = color;
  for (const Point2& corner : polygon) marker.points.push_back({corner.x, corner.y, 0.0});
  if (!polygon.empty()) marker.points.push_back(marker.points.front());
  return marker;
}

}  // namespace

visualization_msgs::MarkerArray museum_markers(const museum::Museum& museum) {
  visualization_msgs::MarkerArray array;
  array.markers.push_back(outline(museum.area, "area", 0, kBorder));
  for (std::size_t i = 0; i < museum.hazards.size(); ++i)
    array.markers.push_back(outline(museum.hazards[i].polygon, "hazards", i, kHazard));
  return array;
}

}  // namespace docent::visualization
