#include "docent/simulator/scenario/build_errors.h"

#include <cmath>

namespace docent::simulator {
namespace {

constexpr double kMostMetres = 1.0;
constexpr double kMostLate = 1.0;  // [s]

double number(const YamlFile& file, const YAML::Node& node, double low, double high) {
  double value = 0.0;
  try {
    value = node.as<double>();
  } catch (const YAML::Exception&) {
    throw YamlFault{file.fault(node, "expected a number")};
  }
  if (!(value >= low && value <= high))
    throw YamlFault{file.fault(node, "expected a number from " + std::to_string(low) + " to " + std::to_string(high))};
  return value;
}

const YAML::Node& mapping(const YamlFile& file, const YAML::Node& node) {
  if (!node.IsMap()) throw YamlFault{file.fault(node, "expected a mapping (key: value)")};
  return node;
}

[[noreturn]] void refuse(const YamlFile& file, const YAML::Node& key, const std::string& known) {
  throw YamlFault{file.fault(key, "unknown key '" + (key.IsScalar() ? key.Scalar() : "") + "' (known: " + known + ")")};
}

Pose2 pose(const YamlFile& file, const YAML::Node& node) {
  Pose2 result;
  for (const auto& entry : mapping(file, node)) {
    const std::string key = entry.first.Scalar();
    if (key == "x")
      result.x = number(file, entry.second, -kMostMetres, kMostMetres);
    else if (key == "y")
      result.y = number(file, entry.second, -kMostMetres, kMostMetres);
    else if (key == "heading")
      result.theta = Angle::degrees(number(file, entry.second, -180.0, 180.0));
    else
      refuse(file, entry.first, "x, y, heading");
  }
  return result;
}

}  // namespace

BuildErrors read_build_errors(const YamlFile& file, const YAML::Node& node) {
  BuildErrors errors;
  for (const auto& entry : mapping(file, node)) {
    const std::string key = entry.first.Scalar();
    if (key == "mounts") {
      for (const auto& mount : mapping(file, entry.second))
        errors.mounts[mount.first.Scalar()] = pose(file, mount.second);
    } else if (key == "late") {
      for (const auto& scanner : mapping(file, entry.second))
        errors.late[scanner.first.Scalar()] = number(file, scanner.second, 0.0, kMostLate);
    } else if (key == "mirrored") {
      if (!entry.second.IsSequence()) throw YamlFault{file.fault(entry.second, "expected a list of scanners")};
      for (const auto& scanner : entry.second) errors.mirrored.insert(scanner.Scalar());
    } else if (key == "odometry") {
      for (const auto& scale : mapping(file, entry.second)) {
        if (scale.first.Scalar() == "way")
          errors.way = number(file, scale.second, 0.5, 2.0);
        else if (scale.first.Scalar() == "turn")
          errors.turn = number(file, scale.second, 0.5, 2.0);
        else if (scale.first.Scalar() == "rate")
          errors.rate = number(file, scale.second, 1.0, 100.0);
        else
          refuse(file, scale.first, "way, turn, rate");
      }
    } else if (key == "start") {
      errors.start = pose(file, entry.second);
    } else {
      refuse(file, entry.first, "mounts, late, mirrored, odometry, start");
    }
  }
  return errors;
}

Pose2 OdometryScale::apply(const Pose2& odom_from_base) {
  if (way_ == 1.0 && turn_ == 1.0) return odom_from_base;
  if (!has_last_) scaled_ = odom_from_base;
  if (has_last_) {
    const Pose2 motion = inverse(last_) * odom_from_base;
    scaled_ = scaled_ * Pose2{way_ * motion.x, way_ * motion.y, Angle::radians(turn_ * motion.theta.radians())};
  }
  has_last_ = true;
  last_ = odom_from_base;
  return scaled_;
}

}  // namespace docent::simulator
