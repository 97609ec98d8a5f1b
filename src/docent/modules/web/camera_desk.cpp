#include "docent/modules/web/camera_desk.h"

#include <cstdio>
#include <utility>

#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/pictures/jpeg/jpeg.h"
#include "docent/pictures/jpeg/raw_pixels.h"

namespace docent::modules {
namespace {

constexpr const char* kRobotPath = "/camera/robot.jpg";
constexpr const char* kScenePath = "/camera/scene.jpg";
constexpr Duration kTolerance = std::chrono::milliseconds{300};  // of the moments of a pair
constexpr Duration kAlone = std::chrono::seconds{2};             // without a pair for so long, each is shown by itself
constexpr int kLongestSide = 4096;                               // [pixels] of a side
// Of what comes without being compressed: often enough for a page, and some hundredths of a processor.
constexpr Duration kEncodingPeriod = std::chrono::milliseconds{200};
constexpr int kQuality = 75;

}  // namespace

CameraDesk::CameraDesk(transport::Bus& bus, std::shared_ptr<telepresence::Site> site)
    : bus_{bus}, site_{std::move(site)}, pairs_{kTolerance} {
  for (const char* path : {kRobotPath, kScenePath})
    site_->set_changing(path, "image/jpeg", std::make_shared<const std::string>(), "");
  bus_.subscribe<sensor_msgs::CompressedImage>(topics::kCamera, [this](const auto& image) {
    compressed_at_[topics::kCamera.name] = bus_.now();
    take_robot(image);
  });
  bus_.subscribe<sensor_msgs::CompressedImage>(topics::kSceneCamera, [this](const auto& image) {
    compressed_at_[topics::kSceneCamera.name] = bus_.now();
    take_scene(image);
  });
  bus_.subscribe<sensor_msgs::Image>(topics::kCameraImage,
                                     [this](const auto& image) { compress(topics::kCamera, image); });
  bus_.subscribe<sensor_msgs::Image>(topics::kSceneCameraImage,
                                     [this](const auto& image) { compress(topics::kSceneCamera, image); });
}

void CameraDesk::take_robot(const sensor_msgs::CompressedImage& image) {
  auto picture = checked(topics::kCamera.name, image);
  if (!picture) return;
  pairs_.add_robot(*picture);
  show(kRobotPath, *picture);
}

void CameraDesk::take_scene(const sensor_msgs::CompressedImage& image) {
  auto picture = checked(topics::kSceneCamera.name, image);
  if (!picture) return;
  pairs_.add_scene(*picture);
  show(kScenePath, *picture);
}

void CameraDesk::compress(const Topic<sensor_msgs::CompressedImage>& instead_of, const sensor_msgs::Image& image) {
  const Time now = bus_.now();
  const auto is_recent = [&](const std::map<std::string, Time>& times, Duration within) {
    const auto found = times.find(instead_of.name);
    return found != times.end() && now - found->second < within;
  };
  if (is_recent(compressed_at_, kAlone) || is_recent(encoded_at_, kEncodingPeriod)) return;
  encoded_at_[instead_of.name] = now;
  const auto picture = pictures::image_of({static_cast<int>(image.width), static_cast<int>(image.height), image.step,
                                           image.encoding, image.is_bigendian != 0, image.data},
                                          kLongestSide);
  if (!picture) {
    fault_ = std::string{instead_of.name} + ": " + picture.error().message;
    return;
  }
  const sensor_msgs::CompressedImage compressed{image.header, "jpeg", pictures::encode_jpeg(*picture, kQuality)};
  if (&instead_of == &topics::kCamera) {
    take_robot(compressed);
  } else {
    take_scene(compressed);
  }
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
