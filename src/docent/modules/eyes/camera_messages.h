#pragma once

#include <cstdint>
#include <vector>

#include "docent/base/result.h"
#include "docent/messages/standard_messages.h"
#include "docent/pictures/image.h"
#include "docent/vision/depth/depth_camera.h"
#include "docent/vision/lens/lens.h"

namespace docent::modules {

/// Whether two messages tell of the same lens.
[[nodiscard]] bool is_same_lens(const sensor_msgs::CameraInfo& a, const sensor_msgs::CameraInfo& b);

/// How a lens bends light, as its driver says. Error: a model that is not read, a lens that nobody has calibrated, a
/// part of the sensor's picture, numbers of another count than the model has.
[[nodiscard]] Result<vision::LensParams> lens_of(const sensor_msgs::CameraInfo& info);

/// What a driver says of such a lens; without header.
[[nodiscard]] sensor_msgs::CameraInfo info_of(const vision::LensParams& lens);

/// Brightness of a picture's pixels, row after row. Error: an encoding that is not read, rows that do not fill it.
[[nodiscard]] Result<std::vector<std::uint8_t>> grey_of(const sensor_msgs::Image& image);
[[nodiscard]] std::vector<std::uint8_t> grey_of(const pictures::Image& image);

/// One of several pixels of a camera's pictures, so that none is wider than `kWidest`: floor and things need no more.
inline constexpr int kWidestDepth = 320;  ///< [pixels]
[[nodiscard]] int decimation_of(std::uint32_t width);

/// A depth camera as its driver says, decimated. Error: as above, or pictures that are not rectified.
[[nodiscard]] Result<vision::DepthCamera> depth_camera_of(const sensor_msgs::CameraInfo& info,
                                                          const vision::DepthCameraMount& mount);

/// [m] of one of several pixels; 0 where nothing came back. Error: neither 16UC1 [mm] nor 32FC1 [m], or of another size
/// than the camera. O(pixels).
[[nodiscard]] Result<vision::DepthPicture> depth_picture_of(const sensor_msgs::Image& image,
                                                            const vision::DepthCamera& camera);

}  // namespace docent::modules
