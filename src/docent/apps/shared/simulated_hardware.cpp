#include "docent/apps/shared/simulated_hardware.h"

#include <algorithm>
#include <numbers>

#include "docent/modules/eyes/dock_params.h"
#include "docent/modules/eyes/eye_places.h"

namespace docent::apps {

namespace {

simulator::ScannerKind kind_of(const robot::Scanner& scanner) {
  simulator::ScannerKind kind;
  kind.field = scanner.field * std::numbers::pi / 180.0;
  kind.beams = scanner.beams;
  kind.rate = scanner.rate;
  if (scanner.max_range > 0.0) kind.max_range = scanner.max_range;
  kind.is_clockwise = scanner.clockwise;
  kind.is_upside_down = scanner.upside_down;
  kind.no_return = scanner.no_return == "infinity" ? simulator::NoReturn::infinity
                   : scanner.no_return == "zero"   ? simulator::NoReturn::zero
                                                   : simulator::NoReturn::greatest;
  return kind;
}

simulator::CameraMount mount_of(const modules::EyePlace& place) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  return {place.x, place.y, place.z, place.pan * kDegree, place.tilt * kDegree, place.roll * kDegree};
}

}  // namespace

simulator::Hardware simulated_hardware(const robot::RobotBody& body) {
  simulator::Hardware hardware;
  hardware.scanners.clear();
  for (const robot::Scanner& scanner : body.scanners) {
    hardware.scanners.push_back(
        {scanner.name, scanner.frame, scanner.base_from_sensor(), kind_of(scanner), 0.0, scanner.height});
  }
  for (const auto& post : body.posts) hardware.posts.push_back({{post[0], post[1]}, post[2]});
  hardware.sonars = body.sonars;
  hardware.sonar_radius = body.sonar_radius;
  hardware.infrareds = body.infrareds;
  hardware.infrared_radius = body.infrared_radius;
  hardware.has_tactile = body.tactile;
  return hardware;
}

Result<simulator::EyeOptions> simulated_eyes(const robot::RobotConfig& config) {
  const auto sight = config.section<modules::SightParams>("sight");
  if (!sight) return tl::unexpected<Error>(sight.error());
  simulator::EyeOptions options;
  const auto ceiling = config.section<modules::CeilingParams>("ceiling");
  if (!ceiling) return tl::unexpected<Error>(ceiling.error());
  options.up = ceiling->enabled;
  options.eyes.rig.up_mount = mount_of(ceiling->place);
  const auto dock = config.section<modules::DockParams>("dock");
  if (!dock) return tl::unexpected<Error>(dock.error());
  options.depth = sight->enabled;
  const auto things = config.section<modules::ThingsParams>("things");
  if (!things) return tl::unexpected<Error>(things.error());
  options.front = dock->enabled || things->enabled;
  options.eyes.rig.front_mount = mount_of(dock->enabled ? dock->place : things->place);
  constexpr double kFrontTimes = 1.5;  // 480 pixels across: the tag is seen 1.5 m away
  if (dock->enabled) options.eyes.rig.front_times = kFrontTimes;
  options.eyes.rig.depth_mount = mount_of(sight->place);
  return options;
}

Result<void> build_wrongly(simulator::Hardware& hardware, const simulator::BuildErrors& errors) {
  const auto find = [&](const std::string& name) {
    return std::find_if(hardware.scanners.begin(), hardware.scanners.end(),
                        [&](const auto& scanner) { return scanner.name == name; });
  };
  for (const auto& [name, error] : errors.mounts) {
    const auto scanner = find(name);
    if (scanner == hardware.scanners.end()) return fail("build.mounts: there is no scanner " + name);
    Pose2& mount = scanner->base_from_scanner;
    mount = {mount.x + error.x, mount.y + error.y, mount.theta + error.theta};
  }
  for (const auto& [name, late] : errors.late) {
    const auto scanner = find(name);
    if (scanner == hardware.scanners.end()) return fail("build.late: there is no scanner " + name);
    scanner->late = late;
  }
  for (const std::string& name : errors.mirrored) {
    const auto scanner = find(name);
    if (scanner == hardware.scanners.end()) return fail("build.mirrored: there is no scanner " + name);
    scanner->kind.is_upside_down = !scanner->kind.is_upside_down;
  }
  hardware.odometry_way = errors.way;
  hardware.odometry_rate = errors.rate;
  hardware.odometry_turn = errors.turn;
  return {};
}

}  // namespace docent::apps
