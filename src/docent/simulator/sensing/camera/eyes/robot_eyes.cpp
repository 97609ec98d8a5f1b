#include "docent/simulator/sensing/camera/eyes/robot_eyes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::simulator {
namespace {

constexpr double kTypicalDistance = 2.0;  // [m] of what blurs
constexpr int kMostBlur = 6;              // pictures that are averaged

Pose2 moved(const Glimpse& glimpse, double later) {
  const Angle turned = Angle::radians(glimpse.angular * later);
  const Angle middle = glimpse.world_from_base.theta + Angle::radians(0.5 * glimpse.angular * later);
  const Point2 at = glimpse.world_from_base.position() + glimpse.linear * later * unit(middle);
  return {at.x, at.y, glimpse.world_from_base.theta + turned};
}

PictureSensor brightened(PictureSensor sensor, double gain) {
  sensor.gain *= gain;
  return sensor;
}

}  // namespace

RobotEyes::RobotEyes(const RobotEyesParams& params)
    : params_{params},
      told_{told_rig(params.rig)},
      true_{true_rig(told_, Rng{params.seed}.stream("rig"))},
      up_{true_.up.lens},
      front_{true_.front.lens},
      depth_{true_.depth.lens},
      shake_{params.lean * std::numbers::pi / 180.0, params.seed} {}

/// The mean of some views while the shutter is open: as many as the picture moves pixels.
RawPicture RobotEyes::exposed(const Renderer& renderer, const Eye& eye, const RayTable& lens,
                              const Glimpse& glimpse) const {
  const double speed = eye.lens.focal_x * (std::abs(glimpse.linear) / kTypicalDistance + std::abs(glimpse.angular));
  const int count = std::clamp(static_cast<int>(std::ceil(speed * params_.exposure)), 1, kMostBlur);
  std::vector<RawPicture> views;
  for (int k = 0; k < count; ++k) {
    const double later = params_.exposure * ((k + 0.5) / count - 0.5);
    const Viewpoint view = viewpoint_of(eye.mount, moved(glimpse, later), shake_.at(glimpse.time + later));
    views.push_back(renderer.expose(view, lens, glimpse.lighting));
  }
  return mean_of(views);
}

std::vector<std::uint8_t> RobotEyes::look_up(const Renderer& renderer, const Glimpse& glimpse, Rng& rng) const {
  return develop_grey(exposed(renderer, true_.up, up_, glimpse), brightened(params_.up, glimpse.gain), rng);
}

pictures::Image RobotEyes::look_ahead(const Renderer& renderer, const Glimpse& glimpse, Rng& rng) const {
  return develop(exposed(renderer, true_.front, front_, glimpse), brightened(params_.front, glimpse.gain), rng);
}

std::vector<std::uint16_t> RobotEyes::measure_depths(const Renderer& renderer, const Glimpse& glimpse, Rng& rng) const {
  const Viewpoint view = viewpoint_of(true_.depth.mount, glimpse.world_from_base, shake_.at(glimpse.time));
  return measure(renderer.probe(view, depth_, params_.depth.baseline), params_.depth, true_.depth.lens.focal_x, rng);
}

}  // namespace docent::simulator
