#include "docent/visualization/people_markers.h"

#include <cmath>
#include <cstdint>

namespace docent::visualization {
namespace {

constexpr std_msgs::ColorRGBA kAlone{1.0F, 0.55F, 0.1F, 0.8F};
constexpr std_msgs::ColorRGBA kInGroup{0.2F, 0.5F, 1.0F, 0.8F};

builtin_interfaces::Duration duration_of(double seconds) {
  const double whole = std::floor(seconds);
  return {static_cast<std::int32_t>(whole), static_cast<std::uint32_t>((seconds - whole) * 1e9)};
}

}  // namespace

visualization_msgs::MarkerArray people_markers(const docent_msgs::People& people, const PeopleMarkerParams& params) {
  visualization_msgs::MarkerArray array;
  for (std::size_t i = 0; i < people.people.size(); ++i) {
    const docent_msgs::Person& person = people.people[i];
    const geometry_msgs::Point place{static_cast<double>(person.x), static_cast<double>(person.y), 0.0};
    visualization_msgs::Marker body;
    body.header = people.header;
    body.ns = "people";
    body.id = static_cast<std::int32_t>(person.id & 0x7fffffffU);
    body.type = visualization_msgs::Marker::kCylinder;
    body.pose.position = {place.x, place.y, params.height / 2.0};
    body.scale = {params.diameter, params.diameter, params.height};
    body.color = i < people.groups.size() && people.groups[i] != 0 ? kInGroup : kAlone;
    body.lifetime = duration_of(params.lifetime);
    array.markers.push_back(body);
    const auto vx = static_cast<double>(person.vx);
    const auto vy = static_cast<double>(person.vy);
    if (std::hypot(vx, vy) < params.least_speed) continue;
    visualization_msgs::Marker arrow = body;
    arrow.ns = "velocities";
    arrow.type = visualization_msgs::Marker::kArrow;
    arrow.pose = {};
    arrow.points = {place, {place.x + params.arrow_time * vx, place.y + params.arrow_time * vy, 0.0}};
    for (auto& point : arrow.points) point.z = params.height / 2.0;
    arrow.scale = {params.arrow_width, 2.0 * params.arrow_width, 2.0 * params.arrow_width};  // shaft, head, its length
    array.markers.push_back(arrow);
  }
  return array;
}

}  // namespace docent::visualization
