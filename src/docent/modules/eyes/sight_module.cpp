#include "docent/modules/eyes/sight_module.h"

#include <optional>
#include <string>

#include "docent/localization/pose_watch/odometry_trail.h"
#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/modules/eyes/camera_messages.h"
#include "docent/modules/eyes/eye_places.h"
#include "docent/modules/eyes/picture_watch.h"
#include "docent/modules/shared/pose_tracker.h"
#include "docent/modules/shared/sensor_time.h"
#include "docent/vision/depth/depth_sight.h"

namespace docent::modules {
namespace {

constexpr const char* kSource = "depth_camera";
constexpr Duration kTellPeriod = std::chrono::milliseconds{100};
constexpr double kLifetime = 1.0;  // [s] of lines: the layer itself remembers

class SightModule final : public Module {
 public:
  SightModule(const ModuleContext& context, const SightParams& params)
      : bus_{context.bus},
        params_{params},
        watch_{bus_.now()},
        odometry_{reach_of(context.config.body())},
        lines_{bus_.publisher(topics::kObstacleLines)} {
    sight_params_ = params.sight();
    sight_params_.layer.body_radius = context.config.body().radius;
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const auto& odometry) {
      odometry_.add(sensor_time_.of(odometry), from_message(odometry.pose.pose));
    });
    bus_.subscribe<sensor_msgs::CameraInfo>(topics::kDepthInfo, [this](const auto& info) { know(info); });
    bus_.subscribe<sensor_msgs::Image>(topics::kDepthImage, [this](const auto& image) { see(image); });
    bus_.every(kTellPeriod, [this] { tell(); });
  }

  [[nodiscard]] ModuleHealth health() const override {
    std::string reason = watch_.complaint(bus_.now());
    if (reason.empty()) reason = fault_;
    if (reason.empty() && !sight_ && bus_.now() - begun_ > PictureWatch::kSilent) reason = "no camera_info";
    if (reason.empty() && unseen_floor_ >= kUnseenFloor)
      reason = "sees no floor where its place in robot.yaml has it: is it turned, or covered?";
    if (reason.empty()) return {};
    return {"degraded", "depth camera: " + reason};
  }

 private:
  static constexpr int kUnseenFloor = 5;  // pictures in a row

  void know(const sensor_msgs::CameraInfo& info) {
    if (known_ && is_same_lens(*known_, info)) return;
    known_ = info;
    const auto camera = depth_camera_of(info, params_.place.depth_mount());
    fault_ = camera ? "" : camera.error().message;
    sight_.reset();
    if (!camera) return;
    camera_ = *camera;
    sight_.emplace(*camera, sight_params_);
  }

  void see(const sensor_msgs::Image& image) {
    const Time now = bus_.now();
    const Time taken = sensor_time_.of(kSource, image.header);
    if (!watch_.hear(now, taken, image.data) || !sight_) return;
    const auto picture = depth_picture_of(image, camera_);
    fault_ = picture ? "" : picture.error().message;
    const auto odom_from_base = odometry_.at(taken);
    if (!picture || !odom_from_base) return;
    const auto seen = sight_->see(*picture, *odom_from_base);
    if (!seen) fault_ = seen.error().message;
    if (!seen) return;
    unseen_floor_ = (*seen)->ground.is_seen ? 0 : unseen_floor_ + 1;
  }

  /// Goes on when the camera has failed: what was seen is still there.
  void tell() {
    if (!sight_ || odometry_.empty()) return;
    const Time now = bus_.now();
    const auto odom_from_base = odometry_.at(now);
    if (!odom_from_base) return;
    docent_msgs::ObstacleLines message{{to_message(now), "base_link"}, kSource, kLifetime, {}};
    for (const vision::SeenLine& seen : sight_->lines(*odom_from_base))
      message.lines.push_back({static_cast<float>(seen.line.a.x), static_cast<float>(seen.line.a.y),
                               static_cast<float>(seen.line.b.x), static_cast<float>(seen.line.b.y)});
    lines_.publish(std::move(message));
  }

  transport::Bus& bus_;
  SightParams params_;
  vision::DepthSightParams sight_params_;
  PictureWatch watch_;
  localization::OdometryTrail odometry_;
  transport::Publisher<docent_msgs::ObstacleLines> lines_;
  SensorTime sensor_time_{bus_};
  std::optional<sensor_msgs::CameraInfo> known_;
  vision::DepthCamera camera_;
  std::optional<vision::DepthSight> sight_;
  std::string fault_;
  int unseen_floor_ = 0;  ///< pictures in a row
  Time begun_ = bus_.now();
};

/// A robot without such a camera.
class NoSight final : public Module {};

}  // namespace

Result<std::unique_ptr<Module>> make_sight(const ModuleContext& context) {
  auto params = context.config.section<SightParams>("sight");
  if (!params) return tl::unexpected<Error>(params.error());
  if (!params->enabled) return std::make_unique<NoSight>();
  return std::make_unique<SightModule>(context, *params);
}

Result<robot::ParameterRows> parameters_of_sight(const robot::RobotConfig& config) {
  return robot::list_parameters<SightParams>(config, "sight");
}

}  // namespace docent::modules
