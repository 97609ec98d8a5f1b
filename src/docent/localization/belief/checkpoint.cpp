#include "docent/localization/belief/checkpoint.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "docent/base/files.h"
#include "docent/base/text.h"
#include "docent/base/yaml.h"

namespace docent::localization {

namespace {

struct StoredMode {
  std::vector<double> pose;        // x, y [m], theta [rad]
  std::vector<double> covariance;  // nine, row-major
  double mass = 0.0;
  template <class V>
  void visit(V& v) {
    v("pose", pose);
    v("covariance", covariance);
    v("mass", mass);
  }
};

struct Stored {
  std::string map_hash;
  std::int64_t nanoseconds = 0;
  std::vector<double> odometry;
  std::vector<StoredMode> modes;
  template <class V>
  void visit(V& v) {
    v("map_hash", map_hash);
    v("nanoseconds", nanoseconds);
    v("odometry", odometry);
    v("modes", modes);
  }
};

constexpr double kMostOfAnything = 1e4;  // [m], [rad] and their squares: no building is so wide

}  // namespace

Result<void> save_localizer_checkpoint(const LocalizerCheckpoint& checkpoint, const std::filesystem::path& path) {
  const auto pose_of = [](const Pose2& pose) { return std::array{pose.x, pose.y, pose.theta.radians()}; };
  std::string text = "map_hash: \"" + checkpoint.map_hash +
                     "\"\nnanoseconds: " + std::to_string(checkpoint.time.nanoseconds) +
                     "\nodometry: " + yaml_list(pose_of(checkpoint.odom_from_robot)) + "\nmodes:\n";
  for (const BeliefMode& mode : checkpoint.modes)
    text += "  - {pose: " + yaml_list(pose_of(mode.map_from_robot)) + ", covariance: " + yaml_list(mode.covariance) +
            ", mass: " + std::to_string(mode.mass) + "}\n";
  return write_file_atomically(path, text, Survives::process_death);
}

Result<LocalizerCheckpoint> load_localizer_checkpoint(const std::filesystem::path& path) {
  const auto file = YamlFile::load(path);
  if (!file) return tl::unexpected<Error>(file.error());
  Stored stored;
  if (auto read = read_yaml(*file, file->root(), stored); !read) return tl::unexpected<Error>(read.error());
  if (stored.odometry.size() != 3 || stored.modes.empty()) return fail(path.string() + ": not a checkpoint");
  LocalizerCheckpoint checkpoint{stored.map_hash,
                                 Time{stored.nanoseconds},
                                 {stored.odometry[0], stored.odometry[1], Angle::radians(stored.odometry[2])},
                                 {}};
  for (const StoredMode& mode : stored.modes) {
    const auto is_sane = [](double value) { return std::abs(value) < kMostOfAnything; };  // false for NaN
    if (mode.pose.size() != 3 || mode.covariance.size() != 9 || !(mode.mass > 0.0 && mode.mass <= 1.0) ||
        !std::all_of(mode.pose.begin(), mode.pose.end(), is_sane) ||
        !std::all_of(mode.covariance.begin(), mode.covariance.end(), is_sane))
      return fail(path.string() + ": not a checkpoint");
    BeliefMode restored{{mode.pose[0], mode.pose[1], Angle::radians(mode.pose[2])}, {}, mode.mass};
    std::copy(mode.covariance.begin(), mode.covariance.end(), restored.covariance.begin());
    checkpoint.modes.push_back(restored);
  }
  return checkpoint;
}

std::optional<LocalizerCheckpoint> recent_checkpoint(const std::filesystem::path& path, const std::string& map_hash,
                                                     Time now, Duration ahead) {
  auto checkpoint = load_localizer_checkpoint(path);
  if (!checkpoint || checkpoint->map_hash != map_hash) return std::nullopt;
  const Duration age = now - checkpoint->time;
  if (age < -ahead || age > kCheckpointAge) return std::nullopt;
  return *checkpoint;
}

}  // namespace docent::localization
