#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "docent/base/random.h"
#include "docent/vision/calibration/board_finder.h"

namespace docent::vision::board_pictures {

/// A lens of the test's own, written as the models' papers have them and not as vision/lens or OpenCV do: from a
/// direction to a place in the picture, with the centre of the first pixel at 0.
struct TrueLens {
  bool is_fisheye = false;
  int columns = 640, rows = 480;
  double focal_x = 520.0, focal_y = 521.5, centre_x = 326.0, centre_y = 236.5;
  std::vector<double> bend{-0.22, 0.07, 0.0008, -0.0006, 0.0};

  [[nodiscard]] Eigen::Vector2d pixel_of(const Eigen::Vector3d& p) const {
    double x = p.x() / p.z(), y = p.y() / p.z();
    const double r2 = x * x + y * y;
    if (is_fisheye) {
      const double r = std::sqrt(r2), t = std::atan(r), t2 = t * t;
      const double bent = t * (1 + t2 * (bend[0] + t2 * (bend[1] + t2 * (bend[2] + t2 * bend[3]))));
      const double by = r > 1e-9 ? bent / r : 1.0;
      x *= by, y *= by;
    } else {
      const double radial = 1 + r2 * (bend[0] + r2 * (bend[1] + r2 * bend[4]));
      const double bx = x * radial + 2 * bend[2] * x * y + bend[3] * (r2 + 2 * x * x);
      const double by = y * radial + bend[2] * (r2 + 2 * y * y) + 2 * bend[3] * x * y;
      x = bx, y = by;
    }
    return {focal_x * x + centre_x, focal_y * y + centre_y};
  }
};

/// Where a board is held; its first corner is its frame's origin.
struct Held {
  Eigen::Matrix3d turn;
  Eigen::Vector3d place;
};

/// So that its middle is at `middle` [m], turned by `across`, `down` and `round` [rad].
inline Held held(const Board& board, const Eigen::Vector3d& middle, double across, double down, double round) {
  Held made;
  made.turn = (Eigen::AngleAxisd{across, Eigen::Vector3d::UnitY()} * Eigen::AngleAxisd{down, Eigen::Vector3d::UnitX()} *
               Eigen::AngleAxisd{round, Eigen::Vector3d::UnitZ()})
                  .toRotationMatrix();
  const Eigen::Vector3d half{0.5 * (board.columns - 1) * board.square, 0.5 * (board.rows - 1) * board.square, 0.0};
  made.place = middle - made.turn * half;
  return made;
}

/// The board drawn forwards: many small dots of its squares, each put where the lens puts it, so that no lens has to be
/// turned round. A pixel is the mean of its dots. White paper a square wide about it, on grey.
inline std::vector<std::uint8_t> picture_of(const TrueLens& lens, const Board& board, const Held& at, double noise,
                                            Rng& rng) {
  const auto pixels = static_cast<std::size_t>(lens.columns) * static_cast<std::size_t>(lens.rows);
  std::vector<float> sum(pixels), dots(pixels);
  const auto point = [&](double u, double v) {
    return Eigen::Vector3d{at.turn * Eigen::Vector3d{u * board.square, v * board.square, 0.0} + at.place};
  };
  // Dots so close that a pixel gets some six.
  const double pixels_a_square = lens.focal_x * board.square / std::max(0.05, at.place.z());
  const int fine = std::clamp(static_cast<int>(2.5 * pixels_a_square), 12, 200);
  for (int i = -2 * fine; i < (board.columns + 1) * fine; ++i) {
    for (int j = -2 * fine; j < (board.rows + 1) * fine; ++j) {
      const double u = (i + 0.5) / fine, v = (j + 0.5) / fine;
      const Eigen::Vector3d p = point(u, v);
      if (p.z() < 0.02) continue;
      const Eigen::Vector2d pixel = lens.pixel_of(p);
      const long column = std::lround(pixel.x()), row = std::lround(pixel.y());
      if (column < 0 || row < 0 || column >= lens.columns || row >= lens.rows) continue;
      const bool is_paper = u < -1 || v < -1 || u >= board.columns || v >= board.rows;
      const auto parity = static_cast<long>(std::floor(u)) + static_cast<long>(std::floor(v));
      const float shade = is_paper || (parity & 1) != 0 ? 225.0F : 30.0F;
      const auto index = static_cast<std::size_t>(row * lens.columns + column);
      sum[index] += shade;
      dots[index] += 1.0F;
    }
  }
  std::vector<std::uint8_t> grey(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const double shade = dots[i] > 0.0F ? static_cast<double>(sum[i] / dots[i]) : 120.0;
    grey[i] = static_cast<std::uint8_t>(std::clamp(shade + noise * rng.normal(), 0.0, 255.0));
  }
  return grey;
}

/// Boards held all over the picture, near and far and turned.
inline std::vector<Held> held_all_over(const TrueLens& lens, const Board& board, int count, Rng& rng) {
  std::vector<Held> all;
  const double width = (board.columns + 1) * board.square;
  const double wide =
      lens.is_fisheye ? 0.75 : 1.0;  // of the half picture: a fisheye's edge is farther off than it looks
  for (int i = 0; i < count; ++i) {
    const double z = width * rng.uniform(1.1, 2.0) * lens.focal_x / 520.0;
    const double x = z * wide * (0.5 * lens.columns / lens.focal_x) * rng.uniform(-0.62, 0.62);
    const double y = z * wide * (0.5 * lens.rows / lens.focal_y) * rng.uniform(-0.62, 0.62);
    all.push_back(held(board, {x, y, z}, rng.uniform(-0.6, 0.6), rng.uniform(-0.6, 0.6), rng.uniform(-0.3, 0.3)));
  }
  return all;
}

}  // namespace docent::vision::board_pictures
