#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/yaml.h"
#include "docent/geometry/pose2.h"

namespace docent {

/// A sensor's place on the robot, robot frame.
struct Mount {
  std::string frame;        ///< header.frame_id of its messages
  double x = 0.0, y = 0.0;  ///< [m] of the sensor, x ahead, y to the left
  double heading = 0.0;     ///< [deg] of the middle of its field, counter-clockwise
  template <class V>
  void visit(V& v) {
    v("frame", frame);
    v("x", x);
    v("y", y);
    v("heading", heading);
  }
  [[nodiscard]] Pose2 base_from_sensor() const { return {x, y, Angle::degrees(heading)}; }
};

/// Body, limits and sensors, section `body` of robot.yaml.
struct RobotBody {
  double radius = 0.265;                     ///< [m], the body is a disc,
  std::vector<std::vector<double>> outline;  ///< [m] or this convex polygon [[x, y], …], robot frame; then `radius`
                                             ///< holds it: plans and steering take that
  double max_speed = 1.63;                   ///< [m/s] that the base can do; museums limit it further
  double max_turn_rate = 1.2;                ///< [rad/s] that the base can do
  double acceleration = 0.5;                 ///< [m/s2] of the base when it speeds up
  double deceleration = 1.0;                 ///< [m/s2] of the base when it brakes; safety counts on it
  double turn_acceleration = 1.5;            ///< [rad/s2] of the base when it begins or ends a turn
  double latency = 0.15;                     ///< [s] from a command to the wheels
  double watchdog = 0.3;                     ///< [s] without a command, then the base stops
  Mount scan_front{"laser_front", 0.0, 0.0, 0.0};
  Mount scan_rear{"laser_rear", 0.0, 0.0, 180.0};
  int sonars = 24;                ///< evenly round the body, sonar_00 at the front, counter-clockwise
  double sonar_radius = 0.25;     ///< [m] from the centre
  int infrareds = 24;             ///< likewise, infrared_00 at the front; 0: it has none
  double infrared_radius = 0.25;  ///< [m] from the centre
  bool tactile = true;            ///< it has a tactile ring, which may not be silent
  template <class V>
  void visit(V& v) {
    v("radius", radius);
    v("outline", outline);
    v("max_speed", max_speed);
    v("max_turn_rate", max_turn_rate);
    v("acceleration", acceleration);
    v("deceleration", deceleration);
    v("turn_acceleration", turn_acceleration);
    v("latency", latency);
    v("watchdog", watchdog);
    v("scan_front", scan_front);
    v("scan_rear", scan_rear);
    v("sonars", sonars);
    v("sonar_radius", sonar_radius);
    v("infrareds", infrareds);
    v("infrared_radius", infrared_radius);
    v("tactile", tactile);
  }
  [[nodiscard]] Pose2 base_from_sonar(int index) const;
  /// The frame of a sonar: sonar_00, sonar_01, … and back; nullopt for what is none of this body's.
  [[nodiscard]] static std::string sonar_frame(int index);
  [[nodiscard]] std::optional<int> sonar_of(std::string_view frame) const;
  [[nodiscard]] Pose2 base_from_infrared(int index) const;
  [[nodiscard]] static std::string infrared_frame(int index);
  [[nodiscard]] std::optional<int> infrared_of(std::string_view frame) const;
  [[nodiscard]] Result<void> validate() const;
};

/// robot.yaml: one section a module, read at start (architecture 10.11).
class RobotConfig {
 public:
  /// All defaults.
  RobotConfig();
  [[nodiscard]] static Result<RobotConfig> load(const std::filesystem::path& path);
  /// `--set localize.beams=90`: section.key=value over what the file says; section.part.key=value where a section has
  /// parts.
  [[nodiscard]] Result<void> set(const std::string& assignment);

  [[nodiscard]] const RobotBody& body() const { return body_; }
  /// Reads section `name` over the defaults of `params` (its visit and validate); unknown keys are faults.
  template <class Params>
  [[nodiscard]] Result<Params> section(const std::string& name) const {
    Params params;
    const YamlFile* last = &file_;
    const auto read_from = [&](const YamlFile& file) -> Result<void> {
      const YAML::Node node = file.root()[name];
      if (!node.IsDefined()) return {};
      last = &file;
      return read_yaml(file, node, params);
    };
    auto read = read_from(file_);
    for (std::size_t i = 0; read && i < settings_.size(); ++i) read = read_from(settings_[i]);
    if (!read) return tl::unexpected<Error>(read.error());
    if constexpr (requires { params.validate(); }) {
      auto valid = params.validate();
      if (!valid) return tl::unexpected<Error>(last->fault(last->root()[name], valid.error().message));
    }
    return params;
  }
  /// Error when the file has a section that is not in `names` (and not `body`).
  [[nodiscard]] Result<void> check_sections(const std::vector<std::string>& names) const;
  /// Hash of all that is set, as 16 hexadecimal digits.
  [[nodiscard]] std::string hash() const;

 private:
  explicit RobotConfig(YamlFile file) : file_{std::move(file)} {}
  YamlFile file_;
  std::vector<YamlFile> settings_;  ///< one a --set, in their order; so that the file keeps its lines
  RobotBody body_;
};

}  // namespace docent
