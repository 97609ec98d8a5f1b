#pragma once

extern "C" {
#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
}

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "docent/base/random.h"
#include "docent/geometry/pose2.h"
#include "docent/messages/standard_messages.h"

namespace docent::modules::tag_scene {

/// A camera that looks level ahead, and a tag on paper on a grey wall.
struct TagScene {
  int columns = 480, rows = 360;
  double focal = 350.0;               ///< [pixels]
  double x = 0.2, y = 0.0, z = 0.45;  ///< [m] base
  double side = 0.16, height = 0.35;  ///< [m]
  int id = 0;

  [[nodiscard]] sensor_msgs::CameraInfo info() const {
    sensor_msgs::CameraInfo info;
    info.width = static_cast<std::uint32_t>(columns), info.height = static_cast<std::uint32_t>(rows);
    info.distortion_model = "plumb_bob";
    info.d = {0.0, 0.0, 0.0, 0.0, 0.0};
    info.k = {focal, 0.0, 0.5 * columns - 0.5, 0.0, focal, 0.5 * rows - 0.5, 0.0, 0.0, 1.0};
    return info;
  }

  /// mono8. @param tag_from_base  the tag's middle on the floor, x out of it
  [[nodiscard]] sensor_msgs::Image picture(const Pose2& tag_from_base, Rng& rng) const {
    apriltag_family_t* family = tag36h11_create();
    image_u8_t* code = apriltag_to_image(family, id);
    const double cell = side / family->width_at_border;
    sensor_msgs::Image image;
    image.width = static_cast<std::uint32_t>(columns), image.height = static_cast<std::uint32_t>(rows);
    image.encoding = "mono8", image.step = image.width;
    const double c = std::cos(tag_from_base.theta.radians()), s = std::sin(tag_from_base.theta.radians());
    const Point2 eye = tag_from_base * Point2{x, y};
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        double sum = 0.0;
        for (int k = 0; k < 4; ++k) {  // rays a pixel
          const double right = (column + 0.25 + 0.5 * (k % 2) - 0.5 * columns) / focal;
          const double down = (row + 0.25 + 0.5 * (k / 2) - 0.5 * rows) / focal;
          const double ahead_x = c + s * right, ahead_y = s - c * right;  // the tag's frame
          if (ahead_x > -1e-6) {
            sum += 140.0;
            continue;
          }
          const double far = -eye.x / ahead_x;
          const double across = eye.y + far * ahead_y, up = z - far * down - height;
          const double u = across / cell + 0.5 * code->width, v = 0.5 * code->height - up / cell;
          const bool is_paper = u >= -1.0 && v >= -1.0 && u < code->width + 1.0 && v < code->height + 1.0;
          const bool is_code = u >= 0.0 && v >= 0.0 && u < code->width && v < code->height;
          sum += !is_paper ? 140.0
                 : !is_code
                     ? 235.0
                     : (code->buf[static_cast<int>(v) * code->stride + static_cast<int>(u)] > 127 ? 235.0 : 25.0);
        }
        image.data.push_back(static_cast<std::uint8_t>(std::lround(0.25 * sum + 3.0 * rng.uniform(-1.0, 1.0))));
      }
    std::free(code->buf);
    std::free(code);
    tag36h11_destroy(family);
    return image;
  }
};

}  // namespace docent::modules::tag_scene
