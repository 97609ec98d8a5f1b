#include "docent/modules/perception/calibrate_module.h"

#include <utility>
#include <vector>

#include "docent/mapping/mount_calibration/calibration_store.h"
#include "docent/mapping/mount_calibration/mount_calibrator.h"
#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/modules/shared/scanners.h"
#include "docent/modules/shared/sensor_time.h"

namespace docent::modules {
namespace {

constexpr Duration kWorkPeriod = std::chrono::milliseconds{250};
constexpr Duration kSavePeriod = std::chrono::seconds{20};

std::vector<mapping::NominalScanner> scanners_of(const robot::RobotBody& body) {
  std::vector<mapping::NominalScanner> scanners;
  for (const robot::Scanner& scanner : body.scanners)
    scanners.push_back({scanner.name, scanner.base_from_sensor(), scanner.upside_down});
  return scanners;
}

class CalibrateModule final : public Module {
 public:
  CalibrateModule(const ModuleContext& context, const mapping::MountCalibratorParams& params)
      : bus_{context.bus},
        params_{params},
        calibrator_{params, scanners_of(context.config.body())},
        store_{context.state / "calibrate.yaml"},
        calibration_{bus_.publisher(topics::kCalibration)} {
    if (const auto before = store_.load(calibrator_.nominal()))
      for (std::size_t i = 0; i < before->size(); ++i)
        calibrator_.remember(i, (*before)[i].estimate, (*before)[i].pairs);
    publish();
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const auto& odometry) {
      calibrator_.move(sensor_time_.of(odometry), from_message(odometry.pose.pose));
    });
    subscribe_stamped_scanners(bus_, context.config.body(), [this](std::size_t i, const sensor_msgs::LaserScan& scan) {
      calibrator_.see(
          i, sensor_time_.of(i, scan),
          {scan.ranges, Angle::radians(static_cast<double>(scan.angle_min)), static_cast<double>(scan.angle_increment),
           static_cast<double>(scan.range_min), static_cast<double>(scan.range_max)});
    });
    bus_.every(kWorkPeriod, [this] {
      if (calibrator_.work() || calibrator_.is_slow() != was_slow_) publish();
    });
    bus_.every(kSavePeriod, [this] { save(); });
  }

  [[nodiscard]] ModuleHealth health() const override {
    const std::string finding = calibrator_.finding();
    if (!finding.empty()) return {"degraded", "robot.yaml is wrong: " + finding};
    if (!fault_.empty()) return {"degraded", fault_};
    if (calibrator_.is_slow()) return {"ready", "slow until the drive has shown where the scanners are mounted"};
    if (!calibrator_.is_known()) return {"ready", "the drive has not shown where the scanners are mounted"};
    return {};
  }

 private:
  void publish() {
    docent_msgs::Calibration message;
    message.header = {to_message(bus_.now()), "base_link"};
    for (std::size_t i = 0; i < calibrator_.scanners().size(); ++i) {
      const mapping::CalibratedScanner& scanner = calibrator_.scanners()[i];
      message.mounts.push_back({calibrator_.nominal()[i].name, scanner.base_from_sensor.x, scanner.base_from_sensor.y,
                                scanner.base_from_sensor.theta.radians(), scanner.delay, scanner.doubt_heading,
                                scanner.doubt_position, scanner.is_known});
    }
    was_slow_ = calibrator_.is_slow();
    if (was_slow_) message.most_speed = calibrator_.is_mirrored() ? params_.mirrored_speed : params_.unknown_speed;
    const mapping::CalibratedBase base = calibrator_.base();
    message.way_scale = base.way_scale;
    message.turn_scale = base.turn_scale;
    message.finding = calibrator_.finding();
    calibration_.publish(std::move(message));
    is_saved_ = false;
  }

  void save() {
    if (std::exchange(is_saved_, true) || !calibrator_.is_known()) return;
    const auto saved = store_.save(calibrator_.nominal(), calibrator_.scanners());
    fault_ = saved ? "" : saved.error().message;
  }

  transport::Bus& bus_;
  SensorTime sensor_time_{bus_};
  mapping::MountCalibratorParams params_;
  mapping::MountCalibrator calibrator_;
  mapping::CalibrationStore store_;
  transport::Publisher<docent_msgs::Calibration> calibration_;
  std::string fault_;  ///< why nothing can be remembered
  bool was_slow_ = false;
  bool is_saved_ = true;  ///< nothing was found since
};

}  // namespace

Result<std::unique_ptr<Module>> make_calibrate(const ModuleContext& context) {
  auto params = context.config.section<mapping::MountCalibratorParams>("calibrate");
  if (!params) return tl::unexpected<Error>(params.error());
  return std::make_unique<CalibrateModule>(context, *params);
}

Result<robot::ParameterRows> parameters_of_calibrate(const robot::RobotConfig& config) {
  return robot::list_parameters<mapping::MountCalibratorParams>(config, "calibrate");
}

}  // namespace docent::modules
