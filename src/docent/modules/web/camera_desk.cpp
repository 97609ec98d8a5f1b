#include "docent/modules/web/camera_desk.h"

#include <cstdio>
#include <utility>

#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/pictures/jpeg/jpeg.h"

namespace docent::modules {
namespace {

constexpr const char* kRobotPath = "/camera/robot.jpg";
constexpr const char* kScenePath = "/camera/scene.jpg";
constexpr Duration kTolerance = std::chrono::milliseconds{300};  // of the moments of a pair
constexpr Duration kAlone = std::chrono::seconds{2};             // without a pair for so long, each is shown by itself
constexpr int kLongestSide = 4096;                               // [pixels] of a side

}  // namespace

CameraDesk::CameraDesk(transport::Bus& bus, std::shared_ptr<telepresence::Site> site)
    : bus_{bus}, site_{std::move(site)}, pairs_{kTolerance} {
  for (const char* path : {kRobotPath, kScenePath})
    site_->set_changing(path, "image/jpeg", std::make_shared<const std::string>(), "");
  bus_.subscribe<sensor_msgs::CompressedImage>(topics::kCamera, [this](const auto& image) {
    auto picture = checked(topics::kCamera.name, image);
    if (!picture) return;
    pairs_.add_robot(*picture);
    show(kRobotPath, *picture);
  });
  bus_.subscribe<sensor_msgs::CompressedImage>(topics::kSceneCamera, [this](const auto& image) {
    auto picture = checked(topics::kSceneCamera.name, image);
    if (!picture) return;
    pairs_.add_scene(*picture);
    show(kScenePath, *picture);
  });
}

std::optional<vision::Picture> CameraDesk::checked(const char* camera, const sensor_msgs::CompressedImage& image) {
  const auto size = pictures::jpeg_size(image.data);
  fault_.clear();
  if (!size) fault_ = std::string{camera} + ": " + size.error().message;
  if (size && (size->width > kLongestSide || size->height > kLongestSide))
    fault_ = std::string{camera} + ": a side over 4096 pixels";
  if (!fault_.empty()) return std::nullopt;
  return vision::Picture{from_message(image.header.stamp),
                         std::make_shared<const std::vector<std::uint8_t>>(image.data)};
}

void CameraDesk::show(const char* path, const vision::Picture& picture) {
  const auto pair = pairs_.newest();
  if (pair && (!shown_ || pair->robot.file != shown_->robot.file || pair->scene.file != shown_->scene.file)) {
    put(kRobotPath, pair->robot);
    put(kScenePath, pair->scene);
    shown_ = pair;
    paired_at_ = bus_.now();
  } else if (!shown_ || bus_.now() - paired_at_ > kAlone) {
    put(path, picture);
  }
}

void CameraDesk::put(const char* path, const vision::Picture& picture) {
  char taken[32];
  std::snprintf(taken, sizeof taken, "%.3f", to_seconds(picture.stamp - Time{}));
  site_->set_changing(path, "image/jpeg",
                      std::make_shared<const std::string>(picture.file->begin(), picture.file->end()), taken);
}

}  // namespace docent::modules
