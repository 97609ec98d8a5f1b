#include "docent/robot/robot_config.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <numbers>

#include "docent/base/random.h"
#include "docent/base/suggestion.h"
#include "docent/geometry/convex.h"

namespace docent::robot {

namespace {

Result<void> check_outline(const RobotBody& body) {
  if (body.outline.empty()) return {};
  Polygon corners;
  for (const auto& corner : body.outline) {
    if (corner.size() != 2) return fail("body.outline must be a list of corners [x, y]");
    corners.push_back({corner[0], corner[1]});
    if (!(norm(corners.back()) <= body.radius)) return fail("body.radius must reach to every corner of body.outline");
  }
  if (!is_convex(corners)) return fail("body.outline must be convex, with three corners and none on a straight line");
  if (!holds_inside(corners, {})) return fail("body.outline must hold the robot's centre");
  return {};
}

Result<void> check_kind(const Scanner& scanner) {
  const std::string at = "body.scanners: of " + scanner.name + " ";
  if (scanner.max_range != 0.0 && !(scanner.max_range >= 0.5 && scanner.max_range <= 1000.0))
    return fail(at + "max_range must be 0.5..1000 m, or 0: as its messages say");
  if (scanner.zero != "auto" && scanner.zero != "nothing" && scanner.zero != "failed")
    return fail(at + "zero must be auto, nothing or failed, not '" + scanner.zero + "'");
  if (!(scanner.beams == 0 || (scanner.beams >= 16 && scanner.beams <= 10000)))
    return fail(at + "beams must be 16..10000, or 0: one a degree");
  if (!(scanner.rate >= 1.0 && scanner.rate <= 100.0)) return fail(at + "rate must be 1..100 Hz");
  if (scanner.no_return != "greatest" && scanner.no_return != "infinity" && scanner.no_return != "zero")
    return fail(at + "no_return must be greatest, infinity or zero, not '" + scanner.no_return + "'");
  return {};
}

/// What ROS 2 allows: parts of letters, digits and underscores, none of which begins with a digit.
bool is_topic(const std::string& name) {
  char before = '/';
  for (std::size_t i = name.starts_with('/') ? 1 : 0; i < name.size(); ++i) {
    const char c = name[i];
    const bool is_digit = c >= '0' && c <= '9';
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    if (before == '/' ? !is_letter : !(is_letter || is_digit || c == '/')) return false;
    before = c;
  }
  return before != '/';
}

/// Of one scanner of several, without a slash at its head.
std::string spoken_topic(const Scanner& scanner) {
  if (scanner.topic.empty()) return "scan_" + scanner.name;
  return scanner.topic.front() == '/' ? scanner.topic.substr(1) : scanner.topic;
}

Result<void> check_scanners(const std::vector<Scanner>& scanners) {
  constexpr auto& kNames = RobotBody::kScannerNames;
  for (auto scanner = scanners.begin(); scanner != scanners.end(); ++scanner) {
    if (std::find(kNames.begin(), kNames.end(), scanner->name) == kNames.end())
      return fail("body.scanners: a name must be front, rear, left or right, not '" + scanner->name + "'");
    const auto is_like = [&](const Scanner& other) {
      return other.name == scanner->name || other.frame == scanner->frame;
    };
    if (scanner->frame.empty() || std::any_of(scanners.begin(), scanner, is_like))
      return fail("body.scanners: each needs a name and a frame of its own");
    if (!(norm(scanner->base_from_sensor().position()) <= 1.0))
      return fail("body.scanners: " + scanner->name + " must lie within 1 m of the robot's centre");
    if (!(scanner->field > 0.0 && scanner->field <= 360.0))
      return fail("body.scanners: the field of " + scanner->name + " must be > 0 and <= 360 degrees");
    if (!(scanner->height >= 0.02 && scanner->height <= 3.0))
      return fail("body.scanners: the height of " + scanner->name + " must be 0.02..3 m");
    if (!scanner->topic.empty() && !is_topic(scanner->topic))
      return fail("body.scanners: '" + scanner->topic + "' is no topic of ROS 2");
    const auto speaks_there = [&](const Scanner& other) { return spoken_topic(other) == spoken_topic(*scanner); };
    if (const auto other = std::find_if(scanners.begin(), scanner, speaks_there); other != scanner)
      return fail("body.scanners: " + other->name + " and " + scanner->name + " have one topic, " +
                  spoken_topic(*scanner) + ": each needs its own");
    if (auto valid = check_kind(*scanner); !valid) return valid;
  }
  return {};
}

Result<void> check_posts(const RobotBody& body) {
  for (const auto& post : body.posts) {
    if (post.size() != 3) return fail("body.posts must be a list of [x, y, radius]");
    if (!(post[2] > 0.0 && norm({post[0], post[1]}) + post[2] <= body.radius))
      return fail("body.posts: each must have a radius > 0 and lie within body.radius");
  }
  return {};
}

}  // namespace

Result<void> RobotBody::validate() const {
  if (!(radius > 0.05 && radius <= 1.0)) return fail("body.radius must be 0.05..1 m");
  if (auto valid = check_outline(*this); !valid) return valid;
  if (!(max_speed > 0.0 && max_speed <= 3.0)) return fail("body.max_speed must be > 0 and <= 3 m/s");
  if (!(max_turn_rate > 0.0 && max_turn_rate <= 6.3)) return fail("body.max_turn_rate must be > 0 and <= 6.3 rad/s");
  for (const double limit : {acceleration, deceleration, turn_acceleration})
    if (!(limit > 0.0 && limit <= 20.0)) return fail("body: accelerations must be > 0 and <= 20");
  if (!(latency >= 0.0 && latency <= 1.0)) return fail("body.latency must be 0..1 s");
  if (!(watchdog > 0.0 && watchdog <= 0.3)) return fail("body.watchdog must be > 0 and <= 0.3 s");
  // `avoid` looks 3.5 m far: what it cannot brake within that it cannot promise.
  if (!(max_speed * (watchdog + latency) + max_speed * max_speed / (2.0 * deceleration) <= 3.0 &&
        watchdog + latency + max_speed / deceleration <= 3.0))
    return fail("body: from max_speed it must stand within 3 m and 3 s (watchdog and latency included)");
  if (auto valid = check_scanners(scanners); !valid) return valid;
  if (auto valid = check_posts(*this); !valid) return valid;
  if (!(sonars >= 0 && sonars <= 100)) return fail("body.sonars must be 0..100");
  constexpr int kRing = 16;  // fewer leave gaps between their cones
  if (scanners.empty() && sonars < kRing)
    return fail("body: without scanners it needs a ring of at least 16 sonars, which look all round");
  if (sonars > 0 && !(sonar_radius >= 0.0 && sonar_radius <= radius))
    return fail("body.sonar_radius must be 0 to the body's radius");
  if (!(infrareds >= 0 && infrareds <= 100)) return fail("body.infrareds must be 0..100");
  if (infrareds > 0 && !(infrared_radius >= 0.0 && infrared_radius <= radius))
    return fail("body.infrared_radius must be 0 to the body's radius");
  return {};
}

namespace {

Pose2 place_on_ring(int index, int count, double radius) {
  const Angle heading = Angle::radians(2.0 * std::numbers::pi * index / count);
  const Point2 place = radius * unit(heading);
  return {place.x, place.y, heading};
}

std::string numbered(const std::string& prefix, int index) {
  return prefix + (index < 10 ? "0" : "") + std::to_string(index);
}

std::optional<int> number_of(std::string_view frame, std::string_view prefix, int count) {
  if (!frame.starts_with(prefix)) return std::nullopt;
  frame.remove_prefix(prefix.size());
  int index = -1;
  const auto [end, error] = std::from_chars(frame.data(), frame.data() + frame.size(), index);
  const bool is_number = error == std::errc{} && end == frame.data() + frame.size();
  return is_number && index >= 0 && index < count ? std::optional<int>{index} : std::nullopt;
}

}  // namespace

std::string RobotBody::topic_of(const Scanner& scanner) const {
  if (!scanner.topic.empty()) return scanner.topic;
  return scanners.size() == 1 ? "scan" : "scan_" + scanner.name;
}

Pose2 RobotBody::base_from_sonar(int index) const { return place_on_ring(index, sonars, sonar_radius); }
std::string RobotBody::sonar_frame(int index) { return numbered("sonar_", index); }
std::optional<int> RobotBody::sonar_of(std::string_view frame) const { return number_of(frame, "sonar_", sonars); }

Pose2 RobotBody::base_from_infrared(int index) const { return place_on_ring(index, infrareds, infrared_radius); }
std::string RobotBody::infrared_frame(int index) { return numbered("infrared_", index); }
std::optional<int> RobotBody::infrared_of(std::string_view frame) const {
  return number_of(frame, "infrared_", infrareds);
}

RobotConfig::RobotConfig() : file_{YamlFile::parse("{}", "robot.yaml (defaults)").value()} {}

Result<RobotConfig> RobotConfig::load(const std::filesystem::path& path) {
  auto file = YamlFile::load(path);
  if (!file) return tl::unexpected<Error>(file.error());
  if (!file->root().IsMap() && !file->root().IsNull()) {
    return tl::unexpected<Error>(file->fault(file->root(), "expected sections (name: …)"));
  }
  RobotConfig config{std::move(*file)};
  if (auto read = config.read_shared(); !read) return tl::unexpected<Error>(read.error());
  return config;
}

Result<void> RobotConfig::set(const std::string& assignment) {
  const auto equals = assignment.find('=');
  const auto dot = assignment.find('.');
  const bool is_yaml = assignment.find_first_of("'\"`{}[]#&*!|>%@,:?\\\n\t") < equals;  // '...' that a shell left
  if (equals == std::string::npos || dot == std::string::npos || dot > equals || dot == 0 || dot + 1 == equals ||
      is_yaml) {
    return fail("--set " + assignment + ": expected section.key=value");
  }
  // Every further dot opens a part of the section.
  std::string text;
  std::string indent;
  for (std::size_t from = 0; from < equals;) {
    const std::size_t to = std::min(assignment.find('.', from), equals);
    if (to == from || to + 1 == equals) return fail("--set " + assignment + ": expected section.key=value");
    text += (from == 0 ? "" : "\n" + indent) + assignment.substr(from, to - from) + ":";
    indent += "  ";
    from = to + 1;
  }
  text += " " + assignment.substr(equals + 1);
  auto setting = YamlFile::parse(text, "--set " + assignment);
  if (!setting) return tl::unexpected<Error>(setting.error());
  settings_.push_back(std::move(*setting));
  auto read = read_shared();
  if (!read) settings_.pop_back();
  return read;
}

Result<void> RobotConfig::read_shared() {
  auto body = section<RobotBody>("body");
  if (!body) return tl::unexpected<Error>(body.error());
  body_ = *body;
  const auto look_for_mounts = [this](const YamlFile& file) {
    const YAML::Node said = file.root()["body"];
    if (!said.IsDefined() || !said.IsMap()) return;
    const YAML::Node scanners = said["scanners"];
    if (!scanners.IsDefined() || scanners.size() != body_.scanners.size()) return;
    for (std::size_t i = 0; i < scanners.size(); ++i) {
      const YAML::Node scanner = scanners[i];
      body_.scanners[i].has_mount =
          scanner["x"].IsDefined() || scanner["y"].IsDefined() || scanner["heading"].IsDefined();
    }
  };
  look_for_mounts(file_);
  for (const YamlFile& setting : settings_) look_for_mounts(setting);
  return {};
}

void RobotConfig::set_mount(std::size_t scanner, const Pose2& base_from_sensor, bool is_upside_down) {
  Scanner& mounted = body_.scanners.at(scanner);
  mounted.x = base_from_sensor.x;
  mounted.y = base_from_sensor.y;
  mounted.heading = base_from_sensor.theta.degrees();
  mounted.upside_down = mounted.upside_down || is_upside_down;
}

Result<void> RobotConfig::refuse_section(const std::string& name, const std::string& why) const {
  const auto refuse = [&](const YamlFile& file) -> Result<void> {
    const YAML::Node node = file.root()[name];
    if (!node.IsDefined()) return {};
    return tl::unexpected<Error>(file.fault(node, "section " + name + " " + why));
  };
  auto checked = refuse(file_);
  for (std::size_t i = 0; checked && i < settings_.size(); ++i) checked = refuse(settings_[i]);
  return checked;
}

Result<void> RobotConfig::check_sections(const std::vector<std::string>& names) const {
  const auto check = [&](const YamlFile& file) -> Result<void> {
    for (const auto& entry : file.root()) {
      const auto name = entry.first.as<std::string>();
      if (name == "body" || std::find(names.begin(), names.end(), name) != names.end()) continue;
      std::string known = "body";
      for (const std::string& one : names) known += ", " + one;
      const std::string meant = did_you_mean(name, names);
      return tl::unexpected<Error>(
          file.fault(entry.first, "unknown section '" + name + "'" + meant + " (known: " + known + ")"));
    }
    return {};
  };
  auto checked = check(file_);
  for (std::size_t i = 0; checked && i < settings_.size(); ++i) checked = check(settings_[i]);
  return checked;
}

std::string RobotConfig::hash() const {
  char text[17];
  std::string all = YAML::Dump(file_.root());
  for (const auto& setting : settings_) all += "\n" + YAML::Dump(setting.root());
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash_of(all)));
  return text;
}

}  // namespace docent::robot
