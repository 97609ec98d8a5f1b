#include "docent/modules/eyes/camera_messages.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "docent/pictures/jpeg/raw_pixels.h"

namespace docent::modules {
namespace {

constexpr double kUnequal = 0.02;  // share by which the two focal lengths of a depth camera may differ

Result<void> check_whole(const sensor_msgs::CameraInfo& info) {
  if (info.width == 0 || info.height == 0) return fail("camera_info has no size");
  if (!(info.k[0] > 0.0 && info.k[4] > 0.0)) return fail("camera_info has no focal length: calibrate the camera");
  if (info.binning_x > 1 || info.binning_y > 1) return fail("camera_info has binning, which is not read");
  const bool is_part = info.roi.x_offset != 0 || info.roi.y_offset != 0 ||
                       (info.roi.width != 0 && info.roi.width != info.width) ||
                       (info.roi.height != 0 && info.roi.height != info.height);
  if (is_part) return fail("camera_info is of a part of the picture, which is not read");
  return {};
}

/// Of either byte order.
std::uint16_t sixteen(const std::uint8_t* at, bool is_bigendian) {
  return is_bigendian ? static_cast<std::uint16_t>((at[0] << 8U) | at[1])
                      : static_cast<std::uint16_t>((at[1] << 8U) | at[0]);
}

float metres(const std::uint8_t* at, bool is_bigendian) {
  std::uint32_t bits = 0;
  for (int i = 0; i < 4; ++i) bits |= std::uint32_t{at[i]} << (is_bigendian ? 24 - 8 * i : 8 * i);
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

}  // namespace

bool is_same_lens(const sensor_msgs::CameraInfo& a, const sensor_msgs::CameraInfo& b) {
  return a.k == b.k && a.d == b.d && a.width == b.width && a.height == b.height &&
         a.distortion_model == b.distortion_model;
}

Result<vision::LensParams> lens_of(const sensor_msgs::CameraInfo& info) {
  if (auto whole = check_whole(info); !whole) return tl::unexpected<Error>(whole.error());
  vision::LensParams lens;
  std::size_t coefficients = 5;
  if (info.distortion_model == "equidistant") {
    lens.kind = vision::LensParams::Kind::fisheye;
    coefficients = 4;
  } else if (info.distortion_model != "plumb_bob" && !info.distortion_model.empty()) {
    return fail("the distortion model " + info.distortion_model + " is not read: plumb_bob and equidistant are");
  }
  if (!info.d.empty() && info.d.size() != coefficients)
    return fail(info.distortion_model + " has " + std::to_string(coefficients) + " coefficients, not " +
                std::to_string(info.d.size()));
  lens.columns = static_cast<int>(info.width), lens.rows = static_cast<int>(info.height);
  lens.focal_x = info.k[0], lens.focal_y = info.k[4];
  lens.centre_x = info.k[2], lens.centre_y = info.k[5];
  std::copy(info.d.begin(), info.d.end(), lens.bend.begin());
  return lens;
}

sensor_msgs::CameraInfo info_of(const vision::LensParams& lens) {
  const bool is_fisheye = lens.kind == vision::LensParams::Kind::fisheye;
  sensor_msgs::CameraInfo info;
  info.width = static_cast<std::uint32_t>(lens.columns), info.height = static_cast<std::uint32_t>(lens.rows);
  info.distortion_model = is_fisheye ? "equidistant" : "plumb_bob";
  info.d.assign(lens.bend.begin(), lens.bend.end() - (is_fisheye ? 1 : 0));
  info.k = {lens.focal_x, 0.0, lens.centre_x, 0.0, lens.focal_y, lens.centre_y, 0.0, 0.0, 1.0};
  info.r = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.p = {lens.focal_x, 0.0, lens.centre_x, 0.0, 0.0, lens.focal_y, lens.centre_y, 0.0, 0.0, 0.0, 1.0, 0.0};
  return info;
}

Result<std::vector<std::uint8_t>> grey_of(const sensor_msgs::Image& image) {
  if (image.encoding == "mono8" && image.step == image.width &&
      image.data.size() == std::size_t{image.step} * image.height)
    return image.data;
  const auto read = pictures::image_of({static_cast<int>(image.width), static_cast<int>(image.height), image.step,
                                        image.encoding, image.is_bigendian != 0, image.data});
  if (!read) return tl::unexpected<Error>(read.error());
  return grey_of(*read);
}

std::vector<std::uint8_t> grey_of(const pictures::Image& image) {
  std::vector<std::uint8_t> grey;
  grey.reserve(static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()));
  const auto bytes = image.bytes();
  for (std::size_t i = 0; i < bytes.size(); i += 4)  // Rec. 601
    grey.push_back(static_cast<std::uint8_t>((77U * bytes[i] + 150U * bytes[i + 1] + 29U * bytes[i + 2]) >> 8U));
  return grey;
}

int decimation_of(std::uint32_t width) {
  return std::max(1, (static_cast<int>(width) + kWidestDepth - 1) / kWidestDepth);
}

Result<vision::DepthCamera> depth_camera_of(const sensor_msgs::CameraInfo& info,
                                            const vision::DepthCameraMount& mount) {
  const auto lens = lens_of(info);
  if (!lens) return tl::unexpected<Error>(lens.error());
  if (std::any_of(info.d.begin(), info.d.end(), [](double c) { return c != 0.0; }))
    return fail("its pictures are not rectified: camera_info has a distortion");
  if (std::abs(lens->focal_x / lens->focal_y - 1.0) > kUnequal)
    return fail("the focal lengths across and down differ by more than 2 %");
  const int n = decimation_of(info.width);
  vision::DepthCamera camera;
  camera.columns = lens->columns / n, camera.rows = lens->rows / n;
  camera.focal = 0.5 * (lens->focal_x + lens->focal_y) / n;
  camera.centre_x = (lens->centre_x - n / 2) / n, camera.centre_y = (lens->centre_y - n / 2) / n;
  camera.mount = mount;
  if (auto valid = camera.validate(); !valid) return tl::unexpected<Error>(valid.error());
  return camera;
}

Result<vision::DepthPicture> depth_picture_of(const sensor_msgs::Image& image, const vision::DepthCamera& camera) {
  constexpr float kMillimetre = 0.001F, kFarthest = 100.0F;  // [m]
  const bool is_mm = image.encoding == "16UC1" || image.encoding == "mono16";
  if (!is_mm && image.encoding != "32FC1")
    return fail("depths as " + image.encoding + " are not read: 16UC1 in mm and 32FC1 in m are");
  const std::size_t bytes = is_mm ? 2 : 4;
  const auto n = static_cast<std::size_t>(decimation_of(image.width));
  if (static_cast<int>(image.width / n) != camera.columns || static_cast<int>(image.height / n) != camera.rows)
    return fail("pictures of " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                " pixels, which camera_info does not say");
  if (image.step < image.width * bytes || image.data.size() < std::size_t{image.step} * image.height)
    return fail("rows that do not fill the picture");
  vision::DepthPicture picture{camera.columns, camera.rows, {}};
  picture.depth.reserve(static_cast<std::size_t>(camera.columns) * static_cast<std::size_t>(camera.rows));
  for (int row = 0; row < camera.rows; ++row) {
    const std::uint8_t* begin = image.data.data() + (static_cast<std::size_t>(row) * n + n / 2) * image.step;
    for (int column = 0; column < camera.columns; ++column) {
      const std::uint8_t* at = begin + (static_cast<std::size_t>(column) * n + n / 2) * bytes;
      const float depth = is_mm ? kMillimetre * static_cast<float>(sixteen(at, image.is_bigendian != 0))
                                : metres(at, image.is_bigendian != 0);
      picture.depth.push_back(depth > 0.0F && depth < kFarthest ? depth : 0.0F);
    }
  }
  return picture;
}

}  // namespace docent::modules
