#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/yaml.h"
#include "docent/geometry/pose2.h"
#include "docent/robot/amendments.h"

namespace docent::robot {

/// A laser scanner and its place.
struct Scanner {
  std::string name = "front";         ///< of RobotBody::kScannerNames
  std::string frame = "laser_front";  ///< of its messages
  double x = 0.0, y = 0.0;            ///< [m], robot frame
  double heading = 0.0;               ///< [deg], robot frame: of the middle of its field
  double field = 180.0;       ///< [deg] of view; this is for a simulated scanner, a real one says it in its messages
  bool upside_down = false;   ///< it hangs, and its driver does not turn the sweeps over
  double max_range = 0.0;     ///< [m] that it looks at most; 0: as its messages say, a simulated one 10 m
  std::string zero = "auto";  ///< its driver writes 0 for nothing (nothing there) or failed (no reading)
  int beams = 0;              ///< of a simulated one, evenly over the field; 0: one a degree
  double rate = 10.0;         ///< [Hz] of a simulated one
  bool clockwise = false;     ///< likewise: its beams go round so
  std::string no_return =
      "greatest";         ///< likewise: what it writes where nothing comes back: greatest, infinity or zero
  double height = 0.38;   ///< [m] above the floor; below the waist it sees legs, and people are wider than these
  std::string topic{};    ///< on which it speaks; "": scan_NAME, or scan where it is the only one
  bool has_mount = true;  ///< not a key: whether x, y or heading is said; else /tf_static says where `frame` is
  template <class V>
  void visit(V& v) {
    v("name", name);
    v("topic", topic);
    v("frame", frame);
    v("x", x);
    v("y", y);
    v("heading", heading);
    v("height", height);
    v("field", field);
    v("upside_down", upside_down);
    v("max_range", max_range);
    v("zero", zero);
    v("beams", beams);
    v("rate", rate);
    v("clockwise", clockwise);
    v("no_return", no_return);
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
  bool stamped_commands = false;             ///< it wants cmd_vel as a TwistStamped, as drivers of ROS 2 Jazzy do by
                                             ///< default, else as a Twist
  static constexpr std::array<std::string_view, 4> kScannerNames{"front", "rear", "left", "right"};
  /// What none of them sees counts as unknown: the robot drives there only when it has looked.
  std::vector<Scanner> scanners{{}, {"rear", "laser_rear", 0.0, 0.0, 180.0, 180.0}};
  /// [m] what of the body stands in the scanners' plane, [[x, y, radius], …], robot frame: simulated scanners see it.
  /// The robot finds it out by itself.
  std::vector<std::vector<double>> posts;
  int sonars = 24;                ///< evenly round the body, sonar_00 at the front, counter-clockwise; 0: it has none
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
    v("stamped_commands", stamped_commands);
    v("scanners", scanners);
    v("posts", posts);
    v("sonars", sonars);
    v("sonar_radius", sonar_radius);
    v("infrareds", infrareds);
    v("infrared_radius", infrared_radius);
    v("tactile", tactile);
  }
  /// On which a scanner of the body speaks, without a slash in front where the robot's prefix comes before it.
  [[nodiscard]] std::string topic_of(const Scanner& scanner) const;
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
  /// Where the base says that a scanner is, for one without a mount of its own. @pre scanner < body().scanners.size()
  void set_mount(std::size_t scanner, const Pose2& base_from_sensor, bool is_upside_down);
  /// Reads section `name` over the defaults of `params` (its visit and validate) and amends them; unknown keys are
  /// faults.
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
    amend(params);
    return params;
  }
  /// What a laboratory changes in the robot's parts; by default nothing.
  void set_amendments(Amendments amendments) { amendments_ = std::move(amendments); }
  /// Does so to a part of a section, or to what a module remembers.
  template <class Part>
  void amend(Part& part) const {
    amendments_.apply(part);
  }
  /// Error when the file has a section that is not in `names` and not `body`.
  [[nodiscard]] Result<void> check_sections(const std::vector<std::string>& names) const;
  /// Error, with file and line, when it has section `name`: `why` says what becomes of it.
  [[nodiscard]] Result<void> refuse_section(const std::string& name, const std::string& why) const;
  /// Hash of all that is set, as 16 hexadecimal digits.
  [[nodiscard]] std::string hash() const;

 private:
  explicit RobotConfig(YamlFile file) : file_{std::move(file)} {}
  /// Reads the sections that every module shares.
  [[nodiscard]] Result<void> read_shared();

  YamlFile file_;
  std::vector<YamlFile> settings_;  ///< one a --set, in their order; so that the file keeps its lines
  RobotBody body_;
  Amendments amendments_;
};

}  // namespace docent::robot
