#include "docent/modules/eyes/dock_eye.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "docent/modules/eyes/camera_messages.h"
#include "docent/pictures/jpeg/jpeg.h"

namespace docent::modules {
namespace {

constexpr double kHalfPixel = 0.5;  // a lens calls the middle of the first pixel 0, 0; a tag's corners its corner

/// What is left of a lens once its pixels are straightened.
vision::TagCamera straight(const vision::LensParams& lens) {
  return {lens.focal_x, lens.centre_x + kHalfPixel, lens.centre_y + kHalfPixel, 0.0};
}

/// The tag as a camera without distortion that is not turned about its axis would see it. nullopt: not ahead.
std::optional<vision::SeenTag> straightened(vision::SeenTag tag, const vision::Lens& lens, Angle roll,
                                            const vision::TagCamera& to) {
  const double c = std::cos(roll.radians()), s = std::sin(roll.radians());
  for (vision::Pixel& corner : tag.corners) {
    const auto ray = lens.ray_of({corner.column - kHalfPixel, corner.row - kHalfPixel});
    constexpr double kAhead = 0.05;
    if (!ray || ray->z() < kAhead) return std::nullopt;
    corner = to.pixel_of({c * ray->x() - s * ray->y(), s * ray->x() + c * ray->y(), ray->z()});
  }
  return tag;
}

}  // namespace

void DockEye::know(const sensor_msgs::CameraInfo& info) {
  if (known_ && is_same_lens(*known_, info)) return;
  known_ = info;
  line_.reset();
  lens_.reset();
  auto lens = lens_of(info).and_then([](const vision::LensParams& read) { return vision::Lens::make(read); });
  fault_ = lens ? "" : lens.error().message;
  if (!lens) return;
  lens_ = std::move(*lens);
  const EyePlace& at = params_.place;
  const vision::DockCamera camera{straight(lens_->params()), at.x, at.y, at.z, Angle::degrees(at.pan),
                                  Angle::degrees(-at.tilt)};
  line_.emplace(camera, params_.line());
}

void DockEye::add_odometry(Time stamp, const Pose2& odom_from_base) {
  if (line_) line_->add_odometry(stamp, odom_from_base);
  if (way_.last) way_.driven += distance(way_.last->position(), odom_from_base.position());
  way_.last = odom_from_base;
}

bool DockEye::see(Time now, Time taken, const sensor_msgs::Image& image) {
  if (!watch_.hear(now, taken, image.data) || !line_) return false;
  auto grey = grey_of(image);
  fault_ = grey ? "" : grey.error().message;
  if (!grey) return false;
  return find(now, taken, static_cast<int>(image.width), static_cast<int>(image.height), std::move(*grey));
}

bool DockEye::see(Time now, Time taken, const sensor_msgs::CompressedImage& picture) {
  if (!line_) {
    (void)watch_.hear(now, taken, picture.data);
    return false;
  }
  const auto image = pictures::decode_jpeg(picture.data);
  fault_ = image ? "" : image.error().message;
  if (!image) return false;
  std::vector<std::uint8_t> grey = grey_of(*image);
  if (!watch_.hear(now, taken, grey)) return false;
  return find(now, taken, image->width(), image->height(), std::move(grey));
}

bool DockEye::find(Time now, Time taken, int columns, int rows, std::vector<std::uint8_t> grey) {
  if (columns != lens_->params().columns || rows != lens_->params().rows) {
    fault_ = "its pictures have another size than camera_info says";
    return false;
  }
  const vision::TagCamera to = straight(lens_->params());
  std::vector<vision::SeenTag> tags;
  for (const vision::SeenTag& tag : finder_.find({columns, rows, std::move(grey)}))
    if (const auto seen = straightened(tag, *lens_, Angle::degrees(params_.place.roll), to)) tags.push_back(*seen);
  if (!line_->add_tags(taken, tags)) return false;
  way_.seen = now;
  way_.driven = 0.0;
  return true;
}

void DockEye::expect(const Pose2& odom_from_tag) {
  constexpr double kPlace = 0.15, kHeading = 6.0 * std::numbers::pi / 180.0;  // [m], [rad]: of a map and a belief
  if (line_) line_->expect(odom_from_tag, kPlace, kHeading);
}

void DockEye::forget() {
  if (line_) line_->forget();
}

std::optional<vision::DockLineEstimate> DockEye::line(Time now) const {
  if (!line_ || !line_->estimate() || !line_->estimate()->is_sure) return std::nullopt;
  if (way_.driven > params_.held_m || now - way_.seen > seconds(params_.held_s)) return std::nullopt;
  return line_->estimate();
}

std::string DockEye::complaint(Time now) const {
  std::string reason = watch_.complaint(now);
  if (reason.empty()) reason = fault_;
  if (reason.empty() && !lens_ && now - begun_ > PictureWatch::kSilent) reason = "no camera_info";
  return reason.empty() ? "" : "front camera: " + reason;
}

}  // namespace docent::modules
