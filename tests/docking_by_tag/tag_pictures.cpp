#include "tag_pictures.h"

extern "C" {
#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
}

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace docent::docking_by_tag {
namespace {

constexpr int kColumns = 640, kRows = 480;
constexpr double kWall = 150.0;  // shade

/// Columns of the camera in the base frame: the world's own way to say it.
Eigen::Matrix3d base_from_camera(const TrueCamera& camera) {
  const Eigen::Vector3d axis{std::cos(camera.pan) * std::cos(camera.down), std::sin(camera.pan) * std::cos(camera.down),
                             -std::sin(camera.down)};
  const Eigen::Vector3d level = axis.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d below = axis.cross(level);
  Eigen::Matrix3d turned;
  turned.col(0) = std::cos(camera.roll) * level + std::sin(camera.roll) * below;
  turned.col(1) = std::cos(camera.roll) * below - std::sin(camera.roll) * level;
  turned.col(2) = axis;
  return turned;
}

struct PictureFrame {
  int left = kColumns, right = -1, top = kRows, bottom = -1;
};

/// Where the tag and its paper are seen, and some pixels about it.
PictureFrame around_tag(const TrueCamera& camera, const Pose2& tag_from_base, double side, double height) {
  constexpr int kMargin = 12;  // [pixels]
  const Eigen::Matrix3d turn = base_from_camera(camera).transpose();
  PictureFrame frame;
  for (const double dy : {-0.8, 0.8}) {
    for (const double dz : {-0.8, 0.8}) {
      const Point2 in_base = inverse(tag_from_base) * Point2{0.0, dy * side};
      const Eigen::Vector3d seen =
          turn * Eigen::Vector3d{in_base.x - camera.x, in_base.y - camera.y, height + dz * side - camera.z};
      if (seen.z() < 0.05) continue;
      const int column = static_cast<int>(camera.centre_x + camera.focal * seen.x() / seen.z());
      const int row = static_cast<int>(camera.centre_y + camera.focal * seen.y() / seen.z());
      frame.left = std::max(0, std::min(frame.left, column - kMargin));
      frame.right = std::min(kColumns - 1, std::max(frame.right, column + kMargin));
      frame.top = std::max(0, std::min(frame.top, row - kMargin));
      frame.bottom = std::min(kRows - 1, std::max(frame.bottom, row + kMargin));
    }
  }
  return frame;
}

}  // namespace

TagPictures::TagPictures(int id, double side, double height) : side_{side}, height_{height} {
  apriltag_family_t* family = tag36h11_create();
  image_u8_t* image = apriltag_to_image(family, id);
  cells_ = image->width;
  border_cells_ = family->width_at_border;
  for (int row = 0; row < cells_; ++row)
    for (int column = 0; column < cells_; ++column) code_.push_back(image->buf[row * image->stride + column]);
  std::free(image->buf);  // what image_u8_destroy does; it lies in a library of its own
  std::free(image);
  tag36h11_destroy(family);
}

double TagPictures::shade_at(double right, double up) const {
  const double cell = side_ / border_cells_;
  const double column = right / cell + 0.5 * cells_, row = 0.5 * cells_ - up / cell;
  constexpr double kPaper = 1.0;  // cells of white about the code's own
  if (column < -kPaper || row < -kPaper || column >= cells_ + kPaper || row >= cells_ + kPaper)
    return kWall + 25.0 * std::sin(3.0 * right) + 15.0 * std::sin(5.0 * up);
  if (column < 0.0 || row < 0.0 || column >= cells_ || row >= cells_) return 235.0;
  return code_[static_cast<std::size_t>(static_cast<int>(row) * cells_ + static_cast<int>(column))] > 127 ? 235.0
                                                                                                          : 25.0;
}

vision::GreyPicture TagPictures::picture(const TrueCamera& camera, const Pose2& tag_from_base, double turn,
                                         Rng& rng) const {
  vision::GreyPicture picture{kColumns, kRows, std::vector<std::uint8_t>(std::size_t{kColumns} * std::size_t{kRows})};
  const Eigen::Matrix3d from_camera = base_from_camera(camera);
  std::vector<float> noise(4096);
  for (float& value : noise) value = static_cast<float>(camera.noise * rng.normal());
  const auto at_noise = [&](int pixel) {
    return static_cast<double>(noise[(static_cast<unsigned>(pixel) * 2654435761U >> 12U) % 4096U]);
  };
  // Only near the tag are rays worth their time.
  const Eigen::Vector3d eye_in_base{camera.x, camera.y, camera.z};
  const double c = std::cos(tag_from_base.theta.radians()), s = std::sin(tag_from_base.theta.radians());
  const auto to_tag = [&](const Eigen::Vector3d& v, double angle) {
    const double ca = c * std::cos(angle) - s * std::sin(angle), sa = s * std::cos(angle) + c * std::sin(angle);
    return Eigen::Vector3d{ca * v.x() - sa * v.y(), sa * v.x() + ca * v.y(), v.z()};
  };
  const auto [left, right, top, bottom] = around_tag(camera, tag_from_base, side_, height_);
  for (int i = 0; i < kColumns * kRows; ++i)
    picture.shades[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(std::clamp(kWall + at_noise(i), 0.0, 255.0));
  constexpr int kRays = 4;
  std::vector<float> jitter(512);
  for (float& value : jitter) value = static_cast<float>(camera.blur * rng.normal());
  std::size_t next = 0;
  const auto blurred = [&] { return static_cast<double>(jitter[next++ % 509]); };
  std::array<Eigen::Matrix3d, kRays> turns;
  std::array<Eigen::Vector3d, kRays> eyes;
  for (std::size_t k = 0; k < kRays; ++k) {
    const double angle = turn * ((static_cast<double>(k) + 0.5) / kRays - 0.5);
    for (int i = 0; i < 3; ++i) turns[k].col(i) = to_tag(from_camera.col(i), angle);
    eyes[k] = to_tag(eye_in_base, angle) + Eigen::Vector3d{tag_from_base.x, tag_from_base.y, 0.0};
  }
  for (int row = top; row <= bottom; ++row) {
    for (int column = left; column <= right; ++column) {
      double sum = 0.0;
      for (std::size_t k = 0; k < kRays; ++k) {
        const double u = column + 0.5 + blurred(), v = row + 0.5 + blurred();
        const double dx = (u - camera.centre_x) / camera.focal, dy = (v - camera.centre_y) / camera.focal;
        double x = dx, y = dy;
        for (int j = 0; j < 2; ++j) {
          const double r2 = x * x + y * y, stretch = 1.0 + camera.radial * r2 + camera.radial4 * r2 * r2;
          x = dx / stretch;
          y = dy / stretch;
        }
        const Eigen::Vector3d& eye = eyes[k];
        const Eigen::Vector3d ray = turns[k] * Eigen::Vector3d{x, y, 1.0};
        if (ray.x() > -1e-6) {
          sum += kWall;
          continue;
        }
        const Eigen::Vector3d at = eye - eye.x() / ray.x() * ray;
        sum += shade_at(at.y(), at.z() - height_);
      }
      const int pixel = row * kColumns + column;
      picture.shades[static_cast<std::size_t>(pixel)] =
          static_cast<std::uint8_t>(std::clamp(sum / kRays + at_noise(pixel), 0.0, 255.0));
    }
  }
  return picture;
}

}  // namespace docent::docking_by_tag
