#include "rgbd_frames.h"

#include <gtest/gtest.h>
#include <png.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>

#include "docent/base/files.h"
#include "docent/pictures/jpeg/jpeg.h"

namespace docent::floor_beside_depth {
namespace {

namespace fs = std::filesystem;

vision::DepthPicture read_depth(const fs::path& path) {
  constexpr float kFarthest = 10.0F;  // [m]: 65535 stands for nothing
  vision::DepthPicture picture;
  std::FILE* file = std::fopen(path.c_str(), "rb");
  EXPECT_NE(file, nullptr) << path;
  if (file == nullptr) return picture;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  EXPECT_EQ(png_get_bit_depth(png, info), 16) << path;
  picture.columns = static_cast<int>(png_get_image_width(png, info));
  picture.rows = static_cast<int>(png_get_image_height(png, info));
  png_bytepp rows = png_get_rows(png, info);
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.columns; ++column) {
      const float metres = static_cast<float>(rows[row][2 * column] << 8 | rows[row][2 * column + 1]) * 0.001F;
      picture.depth.push_back(metres < kFarthest ? metres : 0.0F);
    }
  }
  png_destroy_read_struct(&png, &info, nullptr);
  std::fclose(file);
  return picture;
}

Eigen::Vector3d camera_point(const Frame& frame, double focal, int column, int row) {
  const auto depth = static_cast<double>(frame.depth.depth[frame.depth.index(column, row)]);
  return {(column - 0.5 * frame.depth.columns) / focal * depth, (row - 0.5 * frame.depth.rows) / focal * depth, depth};
}

vision::DepthCameraMount mount_of(const Frame& frame, const WorldFloor& floor) {
  const Eigen::Vector3d up = frame.world_from_camera.transpose() * floor.up;
  vision::DepthCameraMount mount;
  mount.z = floor.up.dot(frame.position) - floor.height;
  mount.down = Angle::radians(std::asin(-up.z()));
  mount.roll = Angle::radians(std::atan2(-up.x(), -up.y()));
  return mount;
}

/// The normal of the plane that most points lie on, of 2,000 trials.
Eigen::Vector3d main_normal(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& about_up) {
  constexpr double kWithin = 0.02, kTilt = 0.8;  // [m], cosine
  Rng rng{1};
  const auto draw = [&] {
    return points[static_cast<std::size_t>(rng.integer(0, static_cast<std::int64_t>(points.size()) - 1))];
  };
  Eigen::Vector3d best = about_up;
  int most = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Eigen::Vector3d a = draw(), b = draw(), c = draw();
    Eigen::Vector3d normal = (b - a).cross(c - a);
    if (normal.norm() < 1e-6) continue;
    normal.normalize();
    if (normal.dot(about_up) < 0.0) normal = -normal;
    if (normal.dot(about_up) < kTilt) continue;
    int count = 0;
    for (std::size_t i = 0; i < points.size(); i += 37) count += std::abs(normal.dot(points[i] - a)) < kWithin ? 1 : 0;
    if (count > most) best = normal;
    most = std::max(most, count);
  }
  return best;
}

}  // namespace

std::vector<Frame> frames_of(const fs::path& folder, double& focal) {
  std::vector<Frame> frames;
  std::error_code error;
  std::vector<fs::path> colours;
  for (const auto& entry : fs::directory_iterator{folder, error})
    if (entry.path().filename().string().ends_with(".color.jpg")) colours.push_back(entry.path());
  std::sort(colours.begin(), colours.end());
  if (colours.empty()) return frames;
  std::ifstream{folder / "camera-intrinsics.txt"} >> focal;
  for (const fs::path& colour : colours) {
    Frame frame;
    const std::string file = colour.filename().string();
    frame.name = file.substr(0, file.find(".color"));
    const auto bytes = read_file(colour);
    EXPECT_TRUE(bytes) << colour;
    auto picture = pictures::decode_jpeg({reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()});
    EXPECT_TRUE(picture) << colour;
    frame.colour = std::move(*picture);
    frame.depth = read_depth(folder / (frame.name + ".depth.png"));
    std::ifstream pose{folder / (frame.name + ".pose.txt")};
    for (int row = 0; row < 3; ++row)
      pose >> frame.world_from_camera(row, 0) >> frame.world_from_camera(row, 1) >> frame.world_from_camera(row, 2) >>
          frame.position(row);
    EXPECT_TRUE(pose) << frame.name;
    frames.push_back(std::move(frame));
  }
  return frames;
}

WorldFloor floor_of(const std::vector<Frame>& frames, double focal) {
  std::vector<Eigen::Vector3d> points;
  Eigen::Vector3d about_up = Eigen::Vector3d::Zero();
  for (const Frame& frame : frames) {
    about_up -= frame.world_from_camera.col(1);
    for (int row = 0; row < frame.depth.rows; row += 8) {
      for (int column = 0; column < frame.depth.columns; column += 8) {
        const Eigen::Vector3d at = camera_point(frame, focal, column, row);
        if (at.z() > 0.4 && at.z() < 5.0) points.push_back(frame.world_from_camera * at + frame.position);
      }
    }
  }
  WorldFloor floor{main_normal(points, about_up.normalized()), 0.0};
  constexpr double kBin = 0.04;  // [m]
  std::map<int, std::size_t> heights;
  for (const auto& point : points) ++heights[static_cast<int>(std::floor(floor.up.dot(point) / kBin))];
  for (const auto& [bin, count] : heights) {
    if (count * 100 < points.size() || count < heights[bin + 1]) continue;
    floor.height = (bin + 0.5) * kBin;
    break;
  }
  for (int i = 0; i < 20; ++i) {
    const double within = i < 10 ? 0.05 : 0.03;  // [m]
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    double count = 0.0;
    for (const auto& point : points) {
      if (std::abs(floor.up.dot(point) - floor.height) > within) continue;
      mean += point;
      squares += point * point.transpose();
      count += 1.0;
    }
    mean /= count;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver{squares / count - mean * mean.transpose()};
    const Eigen::Vector3d normal = solver.eigenvectors().col(0);
    floor.up = normal.dot(floor.up) < 0.0 ? -normal : normal;
    floor.height = floor.up.dot(mean);
  }
  return floor;
}

vision::DepthCamera depth_camera_of(const Frame& frame, const WorldFloor& floor, double focal) {
  return {frame.depth.columns,       frame.depth.rows,       focal,
          0.5 * frame.depth.columns, 0.5 * frame.depth.rows, mount_of(frame, floor)};
}

vision::DepthCamera colour_camera_of(const Frame& frame, const WorldFloor& floor) {
  const ColourCamera colour;
  vision::DepthCamera camera{frame.colour.width(), frame.colour.height(), colour.focal,
                             colour.centre_x,      colour.centre_y,       mount_of(frame, floor)};
  // Its centre lies where what it sees is at -(right, down): in the base frame of the depth camera.
  const Eigen::Vector3d at =
      camera.position() - camera.base_from_camera() * Eigen::Vector3d{colour.right, colour.down, 0.0};
  camera.mount.x = at.x();
  camera.mount.y = at.y();
  camera.mount.z = at.z();
  return camera;
}

DepthInColour depth_in_colour(const Frame& frame, const WorldFloor& floor, double focal) {
  const ColourCamera colour;
  const vision::DepthCamera camera = depth_camera_of(frame, floor, focal);
  const Eigen::Vector3d eye = colour_camera_of(frame, floor).position();
  vision::DepthPoints points;
  points.fill(camera, frame.depth);
  Rng rng{1};
  const vision::GroundPlane plane = vision::find_ground_plane(frame.depth, points, {}, rng);
  DepthInColour seen;
  seen.is_plane_seen = plane.is_seen;
  seen.off_degrees = std::acos(std::min(1.0, plane.normal.z())) * 180.0 / std::numbers::pi;
  const int width = frame.colour.width(), height = frame.colour.height();
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  seen.kinds.assign(pixels, vision::SiteKind::unknown);
  seen.away.assign(pixels, 0.0F);
  std::vector<float> nearest(pixels, 1e9F);
  for (int row = 0; row < frame.depth.rows; ++row) {
    for (int column = 0; column < frame.depth.columns; ++column) {
      const std::size_t i = frame.depth.index(column, row);
      const float depth = frame.depth.depth[i];
      if (!(depth > 0.4F && depth < 6.0F)) continue;
      const Eigen::Vector3d base{points.x[i], points.y[i], points.z[i]};
      const bool is_floor = std::abs(plane.normal.dot(base) + plane.offset) < 0.03 + 0.01 * static_cast<double>(depth);
      const Eigen::Vector3d at = camera_point(frame, focal, column, row);
      const double x = colour.focal * (at.x() + colour.right) / at.z() + colour.centre_x;
      const double y = colour.focal * (at.y() + colour.down) / at.z() + colour.centre_y;
      // Depth pixels lie closer than colour pixels: each is a square of 2 x 2, the nearest thing before what is behind.
      for (int dy = 0; dy < 2; ++dy) {
        for (int dx = 0; dx < 2; ++dx) {
          const int u = static_cast<int>(std::floor(x - 0.5)) + dx, v = static_cast<int>(std::floor(y - 0.5)) + dy;
          if (u < 0 || v < 0 || u >= width || v >= height) continue;
          const std::size_t pixel =
              static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
          if (depth >= nearest[pixel]) continue;
          nearest[pixel] = depth;
          seen.kinds[pixel] = is_floor ? vision::SiteKind::floor : vision::SiteKind::other;
          seen.away[pixel] = static_cast<float>(std::hypot(base.x() - eye.x(), base.y() - eye.y()));
        }
      }
    }
  }
  return seen;
}

}  // namespace docent::floor_beside_depth
