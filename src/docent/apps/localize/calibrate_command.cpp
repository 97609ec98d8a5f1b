#include "docent/apps/localize/calibrate_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/log_defaults.h"
#include "docent/base/files.h"
#include "docent/mapping/mount_calibration/mount_calibrator.h"
#include "docent/recording/laser_log.h"
#include "docent/robot/robot_config.h"

namespace docent::apps::localize_command {
namespace {

struct CalibrateOptions {
  std::string log;
  std::string robot;
  recording::WantedTopics topics;
  std::string times = "stamps";
  std::string report;
  double from = 0.0;
  double to = 1.0;
  int pairs = 2000;
};

/// The scanners of a recording, each once, as it says that they are mounted.
std::vector<mapping::NominalScanner> scanners_of(const recording::LaserLog& log) {
  std::vector<mapping::NominalScanner> scanners;
  for (const recording::LoggedScan& scan : log.scans) {
    const auto is_it = [&](const mapping::NominalScanner& known) {
      return distance(known.base_from_sensor.position(), scan.base_from_laser.position()) < 1e-9 &&
             std::abs((known.base_from_sensor.theta - scan.base_from_laser.theta).radians()) < 1e-9;
    };
    if (std::none_of(scanners.begin(), scanners.end(), is_it))
      scanners.push_back({"laser " + std::to_string(scanners.size() + 1), scan.base_from_laser,
                          scan.bearing_step < 0.0});  // turned over as it was read: it is said to hang
  }
  return scanners;
}

/// As robot.yaml has them, with their names: in its order where the recording has as many.
void name_by_robot(std::vector<mapping::NominalScanner>& scanners, const robot::RobotBody& body) {
  std::vector<bool> is_taken(body.scanners.size());
  for (mapping::NominalScanner& scanner : scanners) {
    std::optional<std::size_t> nearest;
    const auto apart = [&](std::size_t i) {
      const Pose2 mount = body.scanners[i].base_from_sensor();
      return distance(mount.position(), scanner.base_from_sensor.position()) +
             std::abs((mount.theta - scanner.base_from_sensor.theta).radians());
    };
    for (std::size_t i = 0; i < body.scanners.size(); ++i)
      if (!is_taken[i] && (!nearest || apart(i) < apart(*nearest))) nearest = i;
    if (!nearest) continue;
    is_taken[*nearest] = true;
    scanner = {body.scanners[*nearest].name, body.scanners[*nearest].base_from_sensor(), scanner.is_upside_down};
  }
}

/// Goes over a part of the recording.
void replay(const recording::LaserLog& log, const CalibrateOptions& options,
            const std::vector<mapping::NominalScanner>& as_recorded, mapping::MountCalibrator& calibrator) {
  const auto first = static_cast<std::size_t>(options.from * static_cast<double>(log.scans.size()));
  const auto last = static_cast<std::size_t>(options.to * static_cast<double>(log.scans.size()));
  const bool has_own_odometry = log.odometry.size() >= log.scans.size() / 2;
  std::size_t read = 0;
  for (std::size_t i = 0; i < last; ++i) {
    const recording::LoggedScan& scan = log.scans[i];
    for (; has_own_odometry && read < log.odometry.size() && log.odometry[read].time <= scan.time; ++read)
      calibrator.move(log.odometry[read].time, log.odometry[read].odom_from_base);
    if (!has_own_odometry) calibrator.move(scan.time, scan.odom_from_base);
    if (i < first) continue;
    for (std::size_t k = 0; k < as_recorded.size(); ++k) {
      const Pose2& mount = as_recorded[k].base_from_sensor;
      if (distance(mount.position(), scan.base_from_laser.position()) > 1e-9 ||
          std::abs((mount.theta - scan.base_from_laser.theta).radians()) > 1e-9)
        continue;
      calibrator.see(
          k, scan.time,
          {scan.ranges, scan.first_bearing, scan.bearing_step, 0.02, log.max_range > 0.0 ? log.max_range : 1e3});
    }
    calibrator.work();
  }
}

nlohmann::json report_of(const mapping::MountCalibrator& calibrator) {
  nlohmann::json scanners = nlohmann::json::array();
  for (std::size_t i = 0; i < calibrator.scanners().size(); ++i) {
    const mapping::CalibratedScanner& scanner = calibrator.scanners()[i];
    const mapping::MountState& state = scanner.estimate.state;
    scanners.push_back({{"name", calibrator.nominal()[i].name},
                        {"pairs", scanner.pairs},
                        {"x_m", state.base_from_sensor.x},
                        {"y_m", state.base_from_sensor.y},
                        {"heading_deg", state.base_from_sensor.theta.degrees()},
                        {"delay_s", state.delay},
                        {"way_scale", state.way_scale},
                        {"turn_scale", state.turn_scale},
                        {"veer_rad_per_m", state.veer},
                        {"sigma_x_m", scanner.estimate.sigma(mapping::kMountX)},
                        {"sigma_y_m", scanner.estimate.sigma(mapping::kMountY)},
                        {"sigma_heading_deg", scanner.estimate.sigma(mapping::kMountHeading) * 57.29577951308232},
                        {"sigma_delay_s", scanner.estimate.sigma(mapping::kMountDelay)},
                        {"misfit", scanner.estimate.misfit},
                        {"is_known", scanner.is_known},
                        {"finding", scanner.finding}});
  }
  const mapping::CalibratedBase base = calibrator.base();
  return {{"scanners", scanners},          {"way_scale", base.way_scale},   {"way_sigma", base.way_sigma},
          {"turn_scale", base.turn_scale}, {"turn_sigma", base.turn_sigma}, {"finding", calibrator.finding()}};
}

/// The block for robot.yaml: what is known is as it was found, the rest as it stands.
void print_block(const mapping::MountCalibrator& calibrator, const robot::RobotBody* body) {
  std::printf("body:\n  scanners:\n");
  for (std::size_t i = 0; i < calibrator.scanners().size(); ++i) {
    const mapping::CalibratedScanner& scanner = calibrator.scanners()[i];
    const mapping::NominalScanner& nominal = calibrator.nominal()[i];
    const Pose2& mount = scanner.is_known ? scanner.estimate.state.base_from_sensor : nominal.base_from_sensor;
    std::string rest;
    if (body != nullptr) {
      for (const robot::Scanner& known : body->scanners) {
        if (known.name != nominal.name) continue;
        char text[96];
        std::snprintf(text, sizeof text, ", field: %g", known.field);
        rest = ", frame: " + known.frame + text;
      }
    }
    std::printf("    - {name: %s%s, x: %.3f, y: %.3f, heading: %.2f}  # ", nominal.name.c_str(), rest.c_str(), mount.x,
                mount.y, mount.theta.degrees());
    const mapping::MountEstimate& estimate = scanner.estimate;
    if (scanner.is_known)
      std::printf("+- %.3f m, %.2f degrees, from %zu pairs of scans\n", estimate.sigma_position(),
                  estimate.sigma(mapping::kMountHeading) * 57.29577951308232, scanner.pairs);
    else
      std::printf("as it was said: %zu pairs of scans tell too little; drive straight ways and turn\n", scanner.pairs);
  }
  for (std::size_t i = 0; i < calibrator.scanners().size(); ++i) {
    const mapping::MountEstimate& estimate = calibrator.scanners()[i].estimate;
    std::printf("# %s: stamps %+.0f +- %.0f ms late\n", calibrator.nominal()[i].name.c_str(),
                1000.0 * estimate.state.delay, 1000.0 * estimate.sigma(mapping::kMountDelay));
  }
  const mapping::CalibratedBase base = calibrator.base();
  std::printf("# base: each metre of odometry is %.3f +- %.3f m, each degree %.3f +- %.3f degrees\n", base.way_scale,
              base.way_sigma, base.turn_scale, base.turn_sigma);
}

void calibrate(const CalibrateOptions& options) {
  if (!(options.from >= 0.0 && options.from < options.to && options.to <= 1.0))
    throw CommandFailed{"0 <= --from < --to <= 1 must hold", 2};
  const recording::LaserLogOptions reading{.topics = options.topics, .times = times_of(options.times)};
  const recording::LaserLog log = value_or_fail(recording::read_laser_log(options.log, reading));
  for (const std::string& note : log.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
  const std::vector<mapping::NominalScanner> as_recorded = scanners_of(log);
  std::vector<mapping::NominalScanner> scanners = as_recorded;
  std::optional<robot::RobotConfig> config;
  if (!options.robot.empty()) {
    config.emplace(value_or_fail(robot::RobotConfig::load(options.robot)));
    name_by_robot(scanners, config->body());
  }
  mapping::MountCalibratorParams params;
  params.pairs = options.pairs;
  params.rest_way = params.rest_turn = 0.0;  // every sweep counts
  mapping::MountCalibrator calibrator{params, scanners};
  replay(log, options, as_recorded, calibrator);
  if (!options.report.empty())
    value_or_fail(write_file_atomically(options.report, report_of(calibrator).dump(2) + "\n"));
  print_block(calibrator, config ? &config->body() : nullptr);
  const std::string finding = calibrator.finding();
  std::fprintf(stderr, "%s\n", finding.empty() ? "nothing contradicts what is said of the scanners" : finding.c_str());
}

}  // namespace

void add_calibrate_command(CLI::App& app) {
  auto options = std::make_shared<CalibrateOptions>();
  CLI::App* command =
      app.add_subcommand("calibrate", "Where the scanners of a recorded drive are mounted, as a block for robot.yaml");
  command->add_option("--log", options->log, "recording: MCAP, rosbag2, a bag of ROS 1 or CARMEN")
      ->check(CLI::ExistingPath)
      ->required();
  add_topic_options(*command, options->topics, false);
  add_times_option(*command, options->times);
  command
      ->add_option("--robot", options->robot, "robot.yaml whose scanners these are; without: as the recording has them")
      ->check(CLI::ExistingFile);
  command->add_option("--from", options->from, "share of the recording at which to begin")->capture_default_str();
  command->add_option("--to", options->to, "and at which to end")->capture_default_str();
  command->add_option("--pairs", options->pairs, "of scans that count, the last ones")
      ->check(CLI::Range(20, 20000))
      ->capture_default_str();
  command->add_option("--report", options->report, "JSON file to write")->check(output_file());
  command->callback([options] { calibrate(*options); });
}

}  // namespace docent::apps::localize_command
