#include "docent/modules/shared/initial_pose.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include "docent/messages/conversions.h"

namespace docent::modules {
namespace {

localization::BeliefMode mode_of(const geometry_msgs::PoseWithCovariance& pose, const InitialPoseParams& params) {
  constexpr std::array<std::size_t, 3> kAxes{0, 1, 5};  // x, y, yaw of six
  localization::BeliefMode mode{from_message(pose.pose), {}, 1.0};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) mode.covariance[i * 3 + j] = pose.covariance[kAxes[i] * 6 + kAxes[j]];
  const double heading = params.least_heading * std::numbers::pi / 180.0;
  mode.covariance[0] = std::max(mode.covariance[0], params.least_position * params.least_position);
  mode.covariance[4] = std::max(mode.covariance[4], params.least_position * params.least_position);
  mode.covariance[8] = std::max(mode.covariance[8], heading * heading);
  return mode;
}

MessageFault fault_in(const OccupancyGrid& map, Point2 place) {
  const CellIndex cell = map.frame.cell_at(place);
  if (!map.frame.holds(cell)) return {"pose", "lies outside the map"};
  if (!map.is_free(cell)) return {"pose", "lies where the map has no free floor"};
  return {};
}

}  // namespace

void subscribe_initial_pose(transport::Bus& bus, const OccupancyGrid& map,
                            std::function<MessageFault(const localization::BeliefMode& mode, Time stamp)> take,
                            const InitialPoseParams& params) {
  bus.subscribe<geometry_msgs::PoseWithCovarianceStamped>(
      topics::kInitialPose, [&bus, &map, take = std::move(take), params](const auto& told) {
        const localization::BeliefMode mode = mode_of(told.pose, params);
        MessageFault fault = fault_in(map, mode.map_from_robot.position());
        if (!fault) fault = take(mode, from_message(told.header.stamp));
        if (fault) bus.refuse(topics::kInitialPose.name, fault);
      });
}

}  // namespace docent::modules
