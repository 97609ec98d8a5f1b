#include "docent/vision/ceiling/drive/ceiling_drive.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

#include "docent/base/files.h"
#include "docent/base/yaml.h"
#include "docent/grid/map_image.h"
#include "docent/vision/lens/lens_file.h"

namespace docent::vision {
namespace {

namespace fs = std::filesystem;

constexpr double kFarthest = 1e7;  // [m] a coordinate

struct MountYaml {
  double x = 0.0, y = 0.0, z = 0.0, pan = 0.0, tilt = 90.0, roll = 0.0;
  template <class V>
  void visit(V& v) {
    v.required("x", x);
    v.required("y", y);
    v.required("z", z);
    v("pan", pan);
    v("tilt", tilt);
    v("roll", roll);
  }
};

vision::CameraMount mount_of(const MountYaml& yaml) {
  // Looks ahead, its picture's right to the robot's right; then turned about its own axis, upwards, and to the left.
  Eigen::Matrix3d ahead;
  ahead << 0.0, 0.0, 1.0,  //
      -1.0, 0.0, 0.0,      //
      0.0, -1.0, 0.0;
  const auto turned = [](double degrees, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd{degrees * kDegree, axis}.toRotationMatrix();
  };
  return {{yaml.x, yaml.y, yaml.z},
          turned(yaml.pan, Eigen::Vector3d::UnitZ()) * turned(-yaml.tilt, Eigen::Vector3d::UnitY()) *
              turned(yaml.roll, Eigen::Vector3d::UnitX()) * ahead};
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

bool read_number(std::string_view text, double& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() && std::isfinite(number);
}

struct NumberedPose {
  int picture = 0;
  Pose2 map_from_robot;
  std::optional<Pose2> odom_from_robot;
};

Result<std::vector<NumberedPose>> read_poses(const fs::path& path) {
  const auto text = read_file(path);
  if (!text) return tl::unexpected<Error>(text.error());
  constexpr std::array<std::string_view, 7> kColumns{"picture",    "map_x",      "map_y",         "map_theta",
                                                     "odometry_x", "odometry_y", "odometry_theta"};
  constexpr std::size_t kRequired = 4;
  std::array<std::size_t, 7> at{};
  std::size_t columns = kRequired;
  std::vector<NumberedPose> poses;
  std::size_t number = 0;
  for (std::string_view rest = *text; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    const auto fault = [&](const std::string& what) {
      return fail(path.string() + ":" + std::to_string(number) + ": " + what);
    };
    ++number;
    const auto fields = fields_of(line);
    if (number == 1) {
      bool has_odometry = true;
      for (std::size_t i = 0; i < kColumns.size(); ++i) {
        const auto found = std::find(fields.begin(), fields.end(), kColumns[i]);
        if (found == fields.end() && i < kRequired) return fault("has no column '" + std::string{kColumns[i]} + "'");
        has_odometry = has_odometry && found != fields.end();
        at[i] = static_cast<std::size_t>(found - fields.begin());
      }
      if (has_odometry) columns = kColumns.size();
      continue;
    }
    if (line.empty()) continue;
    std::array<double, 7> values{};
    for (std::size_t i = 0; i < columns; ++i)
      if (at[i] >= fields.size() || !read_number(fields[at[i]], values[i]) || !(std::abs(values[i]) <= kFarthest))
        return fault("expected a number under '" + std::string{kColumns[i]} + "'");
    if (values[0] < 0.0 || values[0] != std::floor(values[0])) return fault("picture must be a whole number");
    poses.push_back({static_cast<int>(values[0]), {values[1], values[2], Angle::radians(values[3])}, {}});
    if (columns == kColumns.size())
      poses.back().odom_from_robot = Pose2{values[4], values[5], Angle::radians(values[6])};
  }
  if (poses.empty()) return fail(path.string() + ":1: has no poses");
  return poses;
}

Result<std::vector<std::uint8_t>> read_grey(const fs::path& path, const vision::LensParams& lens) {
  auto image = open_map_image(path);
  if (!image) return tl::unexpected<Error>(image.error());
  if ((*image)->width() != lens.columns || (*image)->height() != lens.rows)
    return fail(path.string() + ":1: is " + std::to_string((*image)->width()) + " x " +
                std::to_string((*image)->height()) + " pixels, but the lens is said to have " +
                std::to_string(lens.columns) + " x " + std::to_string(lens.rows));
  std::vector<std::uint8_t> bytes;
  bytes.reserve(static_cast<std::size_t>(lens.columns) * static_cast<std::size_t>(lens.rows));
  std::vector<std::uint32_t> shades;
  const double white = (*image)->white();
  for (int row = 0; row < lens.rows; ++row) {
    if (auto read = (*image)->read_row(shades); !read) return tl::unexpected<Error>(read.error());
    for (const std::uint32_t shade : shades)
      bytes.push_back(shade == MapImage::kClear ? std::uint8_t{0}
                                                : static_cast<std::uint8_t>(std::lround(255.0 * shade / white)));
  }
  return bytes;
}

}  // namespace

std::vector<vision::PlacedPicture> CeilingDrive::placed() const {
  std::vector<vision::PlacedPicture> placed;
  const vision::LensParams& lens = camera.lens.params();
  for (std::size_t i = 0; i < bytes.size(); ++i)
    placed.push_back({{lens.columns, lens.rows, bytes[i]},
                      map_from_robot[i],
                      1.0,
                      0.0,
                      odom_from_robot.empty() ? std::nullopt : std::optional{odom_from_robot[i]}});
  return placed;
}

Result<vision::CeilingCamera> read_up_camera(const fs::path& path) {
  const auto file = YamlFile::load(path);
  if (!file) return tl::unexpected<Error>(file.error());
  const YAML::Node up = file->root().IsMap() ? file->root()["up"] : YAML::Node{};
  if (!up.IsDefined() || !up.IsMap()) return fail(path.string() + ":1: has no camera 'up'");
  const auto lens = vision::read_lens(*file, up);
  if (!lens) return tl::unexpected<Error>(lens.error());
  if (!up["mount"].IsDefined()) return tl::unexpected<Error>(file->fault(up, "the camera 'up' has no mount"));
  MountYaml mount;
  if (auto read = read_yaml(*file, up["mount"], mount); !read) return tl::unexpected<Error>(read.error());
  vision::CeilingCamera camera{*lens, mount_of(mount)};
  const bool is_finite = camera.mount.position.allFinite() && camera.mount.robot_from_camera.allFinite();
  if (!is_finite || camera.mount.robot_from_camera(2, 2) < 0.5)
    return tl::unexpected<Error>(file->fault(up["mount"], "this camera does not look up"));
  return camera;
}

Result<CeilingDrive> read_ceiling_drive(const fs::path& folder) {
  const auto camera = read_up_camera(folder / "cameras.yaml");
  if (!camera) return tl::unexpected<Error>(camera.error());
  const auto poses = read_poses(folder / "poses.csv");
  if (!poses) return tl::unexpected<Error>(poses.error());
  CeilingDrive drive{*camera, {}, {}, {}, {}};
  for (const NumberedPose& pose : *poses) {
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "%06d.png", pose.picture);
    auto bytes = read_grey(folder / "up" / name.data(), camera->lens.params());
    if (!bytes) return tl::unexpected<Error>(bytes.error());
    drive.numbers.push_back(pose.picture);
    drive.bytes.push_back(std::move(*bytes));
    drive.map_from_robot.push_back(pose.map_from_robot);
    if (pose.odom_from_robot) drive.odom_from_robot.push_back(*pose.odom_from_robot);
  }
  return drive;
}

}  // namespace docent::vision
