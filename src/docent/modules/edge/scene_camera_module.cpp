#include "docent/modules/edge/scene_camera_module.h"

#include <algorithm>
#include <cmath>

#include "docent/messages/conversions.h"
#include "docent/modules/shared/pose_tracker.h"
#include "docent/vision/pan_tilt_zoom.h"

namespace docent::modules {
namespace {

constexpr Duration kPeriod = std::chrono::milliseconds{500};

/// Section `scene_camera`: how the camera in the hall follows the robot.
struct SceneCameraParams : vision::PanTiltZoomParams {
  template <class V>
  void visit(V& v) {
    PanTiltZoomParams::visit(v);
  }
  [[nodiscard]] Result<void> validate() const {
    if (auto valid = vision::PanTiltZoomParams::validate(); !valid)
      return fail("scene_camera." + valid.error().message);
    return {};
  }
};

class SceneCameraModule final : public Module {
 public:
  SceneCameraModule(const ModuleContext& context, const museum::SceneCamera& camera, const SceneCameraParams& params)
      : bus_{context.bus},
        camera_{{camera.position, camera.height}, middle_of(context.museum.area), params},
        views_{bus_.publisher(topics::kSceneCameraView)},
        pose_{reach_of(context.config.body())} {
    bus_.subscribe<docent_msgs::Belief>(topics::kBelief, [this](const auto& belief) {
      pose_.on_belief(belief);
      deviation_ = belief.hypotheses.empty() ? 0.0 : deviation_of(belief.hypotheses.front());
    });
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry,
                                       [this](const auto& odometry) { pose_.on_odometry(odometry); });
    bus_.every(kPeriod, [this] { look(); });
  }

 private:
  static Point2 middle_of(const Polygon& area) {
    Point2 sum;
    for (const Point2 corner : area) sum = sum + corner;
    return area.empty() ? sum : (1.0 / static_cast<double>(area.size())) * sum;
  }
  /// [m] along the worse axis.
  static double deviation_of(const docent_msgs::Hypothesis& best) {
    const double mean = 0.5 * (best.covariance[0] + best.covariance[4]);
    const double half = 0.5 * (best.covariance[0] - best.covariance[4]);
    return std::sqrt(std::max(0.0, mean + std::hypot(half, best.covariance[1])));
  }
  void look() {
    const auto robot = pose_.localized() ? pose_.map_from_base() : std::nullopt;
    const auto& view = camera_.follow(robot ? std::optional{robot->position()} : std::nullopt, deviation_);
    views_.publish({{to_message(bus_.now()), "map"}, view.pan, view.tilt, view.field_of_view});
  }

  transport::Bus& bus_;
  vision::PanTiltZoom camera_;
  transport::Publisher<docent_msgs::CameraView> views_;
  PoseTracker pose_;
  double deviation_ = 0.0;
};

class NoSceneCamera final : public Module {};

}  // namespace

Result<std::unique_ptr<Module>> make_scene_camera(const ModuleContext& context) {
  auto params = context.config.section<SceneCameraParams>("scene_camera");
  if (!params) return tl::unexpected<Error>(params.error());
  if (!context.museum.scene_camera) return std::make_unique<NoSceneCamera>();
  return std::make_unique<SceneCameraModule>(context, *context.museum.scene_camera, *params);
}

Result<robot::ParameterRows> parameters_of_scene_camera(const robot::RobotConfig& config) {
  return robot::list_parameters<SceneCameraParams>(config, "scene_camera");
}

}  // namespace docent::modules
