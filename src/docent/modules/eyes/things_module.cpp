#include "docent/modules/eyes/things_module.h"

#include <Eigen/Core>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "docent/base/files.h"
#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/modules/eyes/camera_messages.h"
#include "docent/modules/eyes/eye_places.h"
#include "docent/modules/eyes/picture_watch.h"
#include "docent/modules/shared/pose_tracker.h"
#include "docent/modules/shared/sensor_time.h"
#include "docent/pictures/jpeg/jpeg.h"
#include "docent/pictures/jpeg/raw_pixels.h"
#include "docent/vision/things/thing_sight.h"

namespace docent::modules {
namespace {

constexpr const char* kDepthSource = "depth_camera";
constexpr const char* kFrontSource = "front_camera";
constexpr Duration kTellThings = std::chrono::milliseconds{500};

class ThingsModule final : public Module {
 public:
  ThingsModule(const ModuleContext& context, ThingsParams params, const EyePlace& depth_place,
               std::optional<vision::ObjectBook> book)
      : bus_{context.bus},
        params_{std::move(params)},
        depth_place_{depth_place},
        sight_{params_.floor, params_.map, std::move(book)},
        depth_watch_{bus_.now()},
        front_watch_{bus_.now()},
        pose_{reach_of(context.config.body())},
        things_{bus_.publisher(topics::kSeenThings)} {
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const auto& odometry) {
      pose_.on_odometry(odometry, sensor_time_.of(odometry));
      turning_ = std::abs(odometry.twist.twist.angular.z);
    });
    bus_.subscribe<docent_msgs::Belief>(topics::kBelief, [this](const auto& belief) {
      pose_.on_belief(belief);
      if (belief.hypotheses.empty()) return;
      for (std::size_t i = 0; i < belief.hypotheses.front().covariance.size(); ++i)
        pose_covariance_(static_cast<int>(i) / 3, static_cast<int>(i) % 3) = belief.hypotheses.front().covariance[i];
    });
    bus_.subscribe<sensor_msgs::CameraInfo>(topics::kDepthInfo, [this](const auto& info) { know_depth(info); });
    bus_.subscribe<sensor_msgs::CameraInfo>(topics::kFrontInfo, [this](const auto& info) { know_front(info); });
    bus_.subscribe<sensor_msgs::Image>(topics::kFrontImage, [this](const auto& image) { see_front(image); });
    bus_.subscribe<sensor_msgs::Image>(topics::kDepthImage, [this](const auto& image) { see_depth(image); });
    bus_.every(kTellThings, [this] { tell(); });
  }

  [[nodiscard]] ModuleHealth health() const override {
    const std::string depth = depth_watch_.complaint(bus_.now()), front = front_watch_.complaint(bus_.now());
    if (!depth.empty()) return {"degraded", "depth camera: " + depth};
    if (!front.empty()) return {"degraded", "front camera: " + front};
    if (!fault_.empty()) return {"degraded", fault_};
    if (!sight_.has_book() && params_.keep.empty())
      return {"degraded", "nobody has taught it anything: docent learn-objects"};
    return {};
  }

 private:
  void know_depth(const sensor_msgs::CameraInfo& info) {
    if (known_depth_ && is_same_lens(*known_depth_, info)) return;
    known_depth_ = info;
    const auto camera = depth_camera_of(info, depth_place_.depth_mount());
    fault_ = camera ? "" : "depth camera: " + camera.error().message;
    if (camera) sight_.set_depth_camera(*camera);
  }

  void know_front(const sensor_msgs::CameraInfo& info) {
    if (known_front_ && is_same_lens(*known_front_, info)) return;
    known_front_ = info;
    auto lens = lens_of(info).and_then([](const vision::LensParams& read) { return vision::Lens::make(read); });
    fault_ = lens ? "" : "front camera: " + lens.error().message;
    const auto mount = params_.place.camera_mount();
    sight_.set_front_camera(lens ? std::optional{vision::FrontCamera{*lens, mount.position, mount.robot_from_camera}}
                                 : std::nullopt);
  }

  /// Nothing: the robot is lost, or the picture is blurred by its turn.
  [[nodiscard]] std::optional<vision::ThingViewpoint> viewpoint(Time taken) const {
    const auto map_from_base = pose_.map_from_base_at(taken);
    if (!map_from_base || !pose_.localized() || turning_ > params_.turning) return std::nullopt;
    return vision::ThingViewpoint{taken, *map_from_base, pose_covariance_};
  }

  void see_front(const sensor_msgs::Image& image) {
    const Time taken = sensor_time_.of(kFrontSource, image.header);
    if (!front_watch_.hear(bus_.now(), taken, image.data)) return;
    const auto from = viewpoint(taken);
    if (!from) return;
    auto picture = pictures::image_of({static_cast<int>(image.width), static_cast<int>(image.height), image.step,
                                       image.encoding, image.is_bigendian != 0, image.data});
    fault_ = picture ? "" : "front camera: " + picture.error().message;
    if (picture) sight_.see(std::move(*picture), *from);
  }

  void see_depth(const sensor_msgs::Image& image) {
    const Time taken = sensor_time_.of(kDepthSource, image.header);
    if (!depth_watch_.hear(bus_.now(), taken, image.data) || sight_.depth_camera() == nullptr) return;
    const auto from = viewpoint(taken);
    if (!from) return;
    const auto picture = depth_picture_of(image, *sight_.depth_camera());
    fault_ = picture ? "" : "depth camera: " + picture.error().message;
    if (!picture) return;
    for (const vision::KeptPatch& patch : sight_.see(*picture, *from)) keep(patch);
  }

  void keep(const vision::KeptPatch& kept) {
    constexpr int kMostKept = 20000;
    constexpr int kQuality = 97;
    if (params_.keep.empty() || kept_ >= kMostKept) return;
    char name[96];
    std::snprintf(name, sizeof name, "/%05d_%.2f_%.2f.jpg", kept_++, kept.in_map.x, kept.in_map.y);
    const auto bytes = pictures::encode_jpeg(kept.patch, kQuality);
    const auto written = write_file_atomically(params_.keep + name, std::string{bytes.begin(), bytes.end()});
    if (!written) fault_ = "things.keep: " + written.error().message;
  }

  void tell() {
    docent_msgs::SeenThings message{{to_message(sight_.looked()), "map"}, {}};
    for (const vision::MappedThing& thing : sight_.map().things()) {
      const std::string object = sight_.map().object_of(thing);
      const auto votes = thing.votes.find(object);
      message.things.push_back(
          {thing.id, object, thing.in_map.x, thing.in_map.y, thing.covariance(0, 0), thing.covariance(0, 1),
           thing.covariance(1, 1), thing.width, thing.height, static_cast<std::uint32_t>(thing.looks),
           static_cast<std::uint32_t>(votes == thing.votes.end() ? 0 : votes->second), to_message(thing.last)});
    }
    things_.publish(std::move(message));
  }

  transport::Bus& bus_;
  ThingsParams params_;
  EyePlace depth_place_;
  vision::ThingSight sight_;
  PictureWatch depth_watch_, front_watch_;
  PoseTracker pose_;
  Eigen::Matrix3d pose_covariance_ = Eigen::Matrix3d::Zero();
  double turning_ = 0.0;  ///< [rad/s]
  transport::Publisher<docent_msgs::SeenThings> things_;
  SensorTime sensor_time_{bus_};
  std::optional<sensor_msgs::CameraInfo> known_depth_, known_front_;
  std::string fault_;
  int kept_ = 0;
};

/// A robot without such eyes.
class NoThings final : public Module {};

}  // namespace

Result<std::unique_ptr<Module>> make_things(const ModuleContext& context) {
  auto params = context.config.section<ThingsParams>("things");
  if (!params) return tl::unexpected<Error>(params.error());
  if (!params->enabled) return std::make_unique<NoThings>();
  const auto sight = context.config.section<SightParams>("sight");
  if (!sight) return tl::unexpected<Error>(sight.error());
  if (!sight->enabled) return fail("things.enabled needs a depth camera: sight.enabled");
  const std::filesystem::path path =
      params->book.empty() ? context.museum.folder / "objects.json" : std::filesystem::path{params->book};
  std::optional<vision::ObjectBook> book;
  if (std::error_code none; !params->book.empty() || std::filesystem::exists(path, none)) {
    auto read = vision::ObjectBook::load(path);
    if (!read) return tl::unexpected<Error>(read.error());
    book = std::move(*read);
  }
  return std::make_unique<ThingsModule>(context, *params, sight->place, std::move(book));
}

Result<robot::ParameterRows> parameters_of_things(const robot::RobotConfig& config) {
  return robot::list_parameters<ThingsParams>(config, "things");
}

}  // namespace docent::modules
