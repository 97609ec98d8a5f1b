#include "docent/robot/robot_config.h"

#include <algorithm>
#include <cstdio>
#include <numbers>

#include "docent/base/random.h"

namespace docent {

Pose2 RobotBody::base_from_sonar(int index) const {
  const Angle heading = Angle::radians(2.0 * std::numbers::pi * index / sonars);
  const Point2 place = sonar_radius * unit(heading);
  return {place.x, place.y, heading};
}

RobotConfig::RobotConfig() : file_{YamlFile::parse("{}", "robot.yaml (defaults)").value()} {}

Result<RobotConfig> RobotConfig::load(const std::filesystem::path& path) {
  auto file = YamlFile::load(path);
  if (!file) return tl::unexpected<Error>(file.error());
  if (!file->root().IsMap() && !file->root().IsNull()) {
    return tl::unexpected<Error>(file->fault(file->root(), "expected sections (name: …)"));
  }
  RobotConfig config{std::move(*file)};
  auto body = config.section<RobotBody>("body");
  if (!body) return tl::unexpected<Error>(body.error());
  config.body_ = *body;
  return config;
}

Result<void> RobotConfig::set(const std::string& assignment) {
  const auto equals = assignment.find('=');
  const auto dot = assignment.find('.');
  if (equals == std::string::npos || dot == std::string::npos || dot > equals || dot == 0 || dot + 1 == equals) {
    return fail("--set " + assignment + ": expected section.key=value");
  }
  std::string text;
  try {
    YAML::Node root = YAML::Clone(file_.root());
    const YAML::Node value = YAML::Load(assignment.substr(equals + 1));
    root[assignment.substr(0, dot)][assignment.substr(dot + 1, equals - dot - 1)] = value;
    text = YAML::Dump(root);
  } catch (const YAML::Exception& exception) {
    return fail("--set " + assignment + ": " + exception.msg);
  }
  auto file = YamlFile::parse(text, file_.name() + " with --set");
  if (!file) return tl::unexpected<Error>(file.error());
  RobotConfig changed{std::move(*file)};
  auto body = changed.section<RobotBody>("body");
  if (!body) return tl::unexpected<Error>(body.error());
  changed.body_ = *body;
  *this = std::move(changed);
  return {};
}

Result<void> RobotConfig::check_sections(const std::vector<std::string>& names) const {
  for (const auto& entry : file_.root()) {
    const auto name = entry.first.as<std::string>();
    if (name == "body" || std::find(names.begin(), names.end(), name) != names.end()) continue;
    return tl::unexpected<Error>(file_.fault(entry.first, "unknown section '" + name + "'"));
  }
  return {};
}

std::string RobotConfig::hash() const {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash_of(YAML::Dump(file_.root()))));
  return text;
}

}  // namespace docent
