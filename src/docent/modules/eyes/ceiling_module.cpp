#include "docent/modules/eyes/ceiling_module.h"

#include <optional>
#include <string>
#include <utility>

#include "docent/localization/pose_watch/odometry_trail.h"
#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/modules/eyes/camera_messages.h"
#include "docent/modules/eyes/eye_places.h"
#include "docent/modules/eyes/picture_watch.h"
#include "docent/modules/shared/pose_tracker.h"
#include "docent/modules/shared/sensor_time.h"
#include "docent/vision/ceiling/localizer/ceiling_localizer.h"
#include "docent/vision/ceiling/mosaic_file.h"

namespace docent::modules {
namespace {

constexpr const char* kCeilingSource = "ceiling";

class CeilingModule final : public Module {
 public:
  CeilingModule(const ModuleContext& context, const CeilingParams& params, vision::CeilingMosaic mosaic)
      : bus_{context.bus},
        params_{params},
        mosaic_{std::move(mosaic)},
        watch_{bus_.now()},
        odometry_{reach_of(context.config.body())},
        fixes_{bus_.publisher(topics::kPoseFix)} {
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const auto& odometry) {
      odometry_.add(sensor_time_.of(odometry), from_message(odometry.pose.pose));
    });
    bus_.subscribe<sensor_msgs::CameraInfo>(topics::kCeilingInfo, [this](const auto& info) { know(info); });
    bus_.subscribe<sensor_msgs::Image>(topics::kCeilingImage, [this](const auto& image) { see(image); });
  }

  [[nodiscard]] ModuleHealth health() const override {
    std::string reason = watch_.complaint(bus_.now());
    if (reason.empty()) reason = fault_;
    if (reason.empty() && !localizer_ && bus_.now() - begun_ > PictureWatch::kSilent) reason = "no camera_info";
    if (!reason.empty()) return {"degraded", "ceiling camera: " + reason};
    if (unlike_ >= kUnlike) return {"degraded", "ceiling camera: what it sees is not the ceiling that was mapped"};
    return {};
  }

 private:
  static constexpr int kUnlike = 10;  // pictures in a row that look like no place

  void know(const sensor_msgs::CameraInfo& info) {
    if (known_ && is_same_lens(*known_, info)) return;
    known_ = info;
    localizer_.reset();
    auto lens = lens_of(info).and_then([](const vision::LensParams& read) { return vision::Lens::make(read); });
    fault_ = lens ? "" : lens.error().message;
    if (!lens) return;
    vision::CeilingLocalizerParams params;
    params.steepest = params_.steepest;
    localizer_.emplace(mosaic_, vision::CeilingCamera{*lens, params_.place.camera_mount()}, params);
  }

  void see(const sensor_msgs::Image& image) {
    const Time taken = sensor_time_.of(kCeilingSource, image.header);
    if (!watch_.hear(bus_.now(), taken, image.data) || !localizer_) return;
    const auto odom_from_base = odometry_.at(taken);
    if (!odom_from_base) return;
    const auto picture = grey_of(image);
    fault_ = picture ? "" : picture.error().message;
    if (!picture) return;
    if (image.width != known_->width || image.height != known_->height) {
      fault_ = "its pictures have another size than camera_info says";
      return;
    }
    const auto fix =
        localizer_->see({static_cast<int>(image.width), static_cast<int>(image.height), *picture}, *odom_from_base);
    constexpr double kUnlikely = 0.5;
    unlike_ = fix && fix->p_wrong < kUnlikely ? 0 : unlike_ + 1;
    if (fix) publish(*fix, taken);
  }

  void publish(const vision::CeilingLocalizer::Fix& fix, Time taken) {
    docent_msgs::PoseFix message;
    message.header = {to_message(taken), "map"};
    message.source = kCeilingSource;
    message.x = fix.map_from_robot.x, message.y = fix.map_from_robot.y;
    message.theta = fix.map_from_robot.theta.radians();
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        message.covariance[static_cast<std::size_t>(3 * row + column)] = fix.covariance(row, column);
    message.p_wrong = fix.p_wrong;
    fixes_.publish(std::move(message));
  }

  transport::Bus& bus_;
  CeilingParams params_;
  vision::CeilingMosaic mosaic_;
  PictureWatch watch_;
  localization::OdometryTrail odometry_;
  transport::Publisher<docent_msgs::PoseFix> fixes_;
  SensorTime sensor_time_{bus_};
  std::optional<sensor_msgs::CameraInfo> known_;
  std::optional<vision::CeilingLocalizer> localizer_;
  std::string fault_;
  int unlike_ = 0;  ///< pictures in a row
  Time begun_ = bus_.now();
};

/// A robot without such a camera, or under a ceiling that nobody has mapped.
class NoCeiling final : public Module {
 public:
  explicit NoCeiling(std::string reason) : reason_{std::move(reason)} {}
  [[nodiscard]] ModuleHealth health() const override {
    return reason_.empty() ? ModuleHealth{} : ModuleHealth{"degraded", reason_};
  }

 private:
  std::string reason_;
};

}  // namespace

Result<std::unique_ptr<Module>> make_ceiling(const ModuleContext& context) {
  auto params = context.config.section<CeilingParams>("ceiling");
  if (!params) return tl::unexpected<Error>(params.error());
  if (!params->enabled) return std::make_unique<NoCeiling>("");
  const std::filesystem::path file =
      params->mosaic.empty() ? context.museum.folder / "ceiling.yaml" : std::filesystem::path{params->mosaic};
  if (params->mosaic.empty() && !std::filesystem::exists(file))
    return std::make_unique<NoCeiling>("nobody has mapped the ceiling: docent map-ceiling does");
  auto mosaic = vision::read_ceiling(file);
  if (!mosaic) return tl::unexpected<Error>(mosaic.error());
  return std::make_unique<CeilingModule>(context, *params, std::move(*mosaic));
}

Result<robot::ParameterRows> parameters_of_ceiling(const robot::RobotConfig& config) {
  return robot::list_parameters<CeilingParams>(config, "ceiling");
}

}  // namespace docent::modules
