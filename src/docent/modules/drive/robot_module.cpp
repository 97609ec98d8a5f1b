#include "docent/modules/drive/robot_module.h"

#include "docent/messages/conversions.h"
#include "docent/modules/drive/base_mounts.h"
#include "docent/modules/drive/create3_hazards.h"
#include "docent/modules/drive/tf_odometry.h"
#include "docent/modules/shared/stop_keeper.h"
#include "docent/robot/watchdog.h"

namespace docent::modules {

namespace {

/// Section `robot`: the base.
struct RobotParams {
  double rate = 20.0;         ///< [Hz] of cmd_vel while no command comes; one that comes goes out at once
  double battery_low = 0.15;  ///< share of the charge below which the module calls itself degraded
  bool create3 = false;       ///< the base is an iRobot Create 3, as a TurtleBot 4 has it: what it says of bumpers,
                              ///< cliffs and wheels on hazard_detection is read as tactile and obstacle_lines
  template <class V>
  void visit(V& v) {
    v("rate", rate);
    v("battery_low", battery_low);
    v("create3", create3);
  }
  [[nodiscard]] Result<void> validate() const {
    if (!(rate >= 5.0 && rate <= 200.0)) return fail("robot.rate must lie between 5 and 200 Hz");
    if (!(battery_low >= 0.0 && battery_low < 1.0)) return fail("robot.battery_low must lie in [0, 1)");
    return {};
  }
};

class RobotModule final : public Module {
 public:
  RobotModule(const ModuleContext& context, const RobotParams& params)
      : bus_{context.bus},
        params_{params},
        watchdog_{context.config.body().watchdog, context.config.body().max_speed, context.config.body().max_turn_rate},
        velocity_{bus_.publisher(topics::kCommandVelocity)},
        transforms_{bus_.publisher(topics::kTransforms)},
        mounts_{context.config.body()},
        stop_{context, "robot", [this] {
                if (stop_.holds()) command_base();
              }} {
    publish_mounts(context.config.body(), context.virtual_time);
    if (params_.create3) create3_.emplace(bus_, context.config.body().radius);
    bus_.subscribe<docent_msgs::Drive>(topics::kDrive, [this](const docent_msgs::Drive& drive) {
      watchdog_.receive(bus_.now(), {drive.linear, drive.angular});
      command_base();  // no command waits for a tick: people do not either
    });
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const nav_msgs::Odometry& odometry) {
      odometry_received_ = bus_.now();
      if (from_tf_.hear(odometry)) return;  // its driver has published the transform
      transforms_.publish(
          {{{odometry.header,
             "base_link",
             {{odometry.pose.pose.position.x, odometry.pose.pose.position.y, 0.0}, odometry.pose.pose.orientation}}}});
    });
    bus_.subscribe<tf2_msgs::TFMessage>(topics::kTransforms, [this](const tf2_msgs::TFMessage& transforms) {
      if (const auto odometry = from_tf_.take(transforms, bus_.now())) publish_odometry(*odometry);
    });
    bus_.subscribe<tf2_msgs::TFMessage>(topics::kStaticTransforms,
                                        [this](const auto& transforms) { mounts_.hear_static(transforms); });
    bus_.subscribe<sensor_msgs::BatteryState>(
        topics::kBattery, [this](const sensor_msgs::BatteryState& battery) { battery_ = battery.percentage; });
    bus_.every(seconds(1.0 / params_.rate), [this] { command_base(); });
  }

  [[nodiscard]] ModuleHealth health() const override {
    if (!odometry_received_) return {"starting", "no odometry yet"};
    if (bus_.now() - *odometry_received_ > seconds(1.0)) return {"degraded", "no fresh odometry from the base"};
    // Each would be obeyed in turn; nothing here can stop the other.
    if (const int others = bus_.other_writers(transport::topic_info(topics::kCommandVelocity)); others > 0)
      return {"degraded", "the base is commanded by " +
                              (others == 1 ? "another program" : std::to_string(others) + " other programs") +
                              ", too: cmd_vel"};
    if (create3_)
      if (std::string complaint = create3_->complaint(); !complaint.empty()) return {"degraded", std::move(complaint)};
    if (battery_ < params_.battery_low) return {"degraded", "the battery is low"};
    ModuleHealth health = stop_.health();
    if (from_tf_.is_needed() && health.reason.empty())
      health.reason = "the base publishes no odom: its transform odom -> base_link is taken";
    if (const std::string other = mounts_.contradictions(); !other.empty())
      health.reason += (health.reason.empty() ? "" : "; ") + other;
    return health;
  }

 private:
  void command_base() {
    // A second process that knows of the stop, behind the one that decides.
    const auto command = stop_.holds() ? robot::CommandWatchdog::Command{} : watchdog_.output(bus_.now());
    velocity_.publish({{command.linear, 0.0, 0.0}, {0.0, 0.0, command.angular}});
  }

  void publish_mounts(const robot::RobotBody& body, bool has_no_base) {
    // Those that the base says itself are not said again; in virtual time there is none.
    tf2_msgs::TFMessage mounts = mounts_.transforms(false);
    if (has_no_base)
      for (auto& mount : mounts_.transforms(true).transforms) mounts.transforms.push_back(std::move(mount));
    for (auto& mount : mounts.transforms) mount.header.stamp = to_message(bus_.now());
    const auto add = [&](const std::string& frame, const Pose2& base_from_sensor) {
      mounts.transforms.push_back(
          {{to_message(bus_.now()), "base_link"},
           frame,
           {{base_from_sensor.x, base_from_sensor.y, 0.0}, to_quaternion(base_from_sensor.theta)}});
    };
    for (int i = 0; i < body.sonars; ++i) {
      add(robot::RobotBody::sonar_frame(i), body.base_from_sonar(i));
    }
    for (int i = 0; i < body.infrareds; ++i) add(robot::RobotBody::infrared_frame(i), body.base_from_infrared(i));
    bus_.publisher(topics::kStaticTransforms).publish(std::move(mounts));
  }

  void publish_odometry(const nav_msgs::Odometry& odometry) {
    if (!odometry_) odometry_ = bus_.publisher(topics::kOdometry);
    odometry_->publish(odometry);
  }

  transport::Bus& bus_;
  RobotParams params_;
  robot::CommandWatchdog watchdog_;
  transport::Publisher<geometry_msgs::Twist> velocity_;
  transport::Publisher<tf2_msgs::TFMessage> transforms_;
  BaseMounts mounts_;
  std::optional<transport::Publisher<nav_msgs::Odometry>> odometry_;  ///< once it has to make it of transforms
  TfOdometry from_tf_;
  std::optional<Create3Hazards> create3_;  ///< of a base of this kind
  std::optional<Time> odometry_received_;
  float battery_ = 1.0F;
  StopKeeper stop_;  ///< last: it calls
};

}  // namespace

Result<std::unique_ptr<Module>> make_robot(const ModuleContext& context) {
  auto params = context.config.section<RobotParams>("robot");
  if (!params) return tl::unexpected<Error>(params.error());
  return std::make_unique<RobotModule>(context, *params);
}

Result<bool> base_is_create3(const robot::RobotConfig& config) {
  const auto params = config.section<RobotParams>("robot");
  if (!params) return tl::unexpected<Error>(params.error());
  return params->create3;
}

Result<robot::ParameterRows> parameters_of_robot(const robot::RobotConfig& config) {
  return robot::list_parameters<RobotParams>(config, "robot");
}

}  // namespace docent::modules
