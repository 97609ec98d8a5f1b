#include "docent/modules/eyes/dock_module.h"

#include <optional>
#include <string>

#include "docent/localization/pose_watch/odometry_trail.h"
#include "docent/messages/conversions.h"
#include "docent/messages/dock_topics.h"
#include "docent/modules/eyes/dock_eye.h"
#include "docent/modules/eyes/dock_params.h"
#include "docent/modules/shared/battery.h"
#include "docent/modules/shared/pose_tracker.h"
#include "docent/modules/shared/sensor_time.h"
#include "docent/planning/dock_approach/dock_approach.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {
namespace {

using planning::DockApproach;

constexpr const char* kFrontCamera = "front_camera";
constexpr Duration kDockStep = std::chrono::milliseconds{50};
constexpr Duration kSay = std::chrono::milliseconds{500};

/// A drive to the contacts that was ordered.
struct DockOrder {
  std::string id;
  Pose2 map_from_charger;
  Time begun;
  DockApproach approach;
  std::string over{};  ///< how it ended: a word of GoalStatus
  std::string why{};
};

class DockModule final : public Module {
 public:
  DockModule(const ModuleContext& context, const DockParams& params)
      : bus_{context.bus},
        params_{params},
        eye_{params, bus_.now()},
        pose_{reach_of(context.config.body())},
        trail_{reach_of(context.config.body())},
        wishes_{bus_.publisher(topics::kDockDrive)},
        states_{bus_.publisher(topics::kDockState)},
        poses_{bus_.publisher(topics::kDockPose)} {
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const auto& odometry) {
      const Time taken = sensor_time_.of(odometry);
      pose_.on_odometry(odometry, taken);
      trail_.add(taken, from_message(odometry.pose.pose));
      if (const auto at = trail_.at(taken)) eye_.add_odometry(taken, *at);
    });
    bus_.subscribe<docent_msgs::Belief>(topics::kBelief, [this](const auto& belief) { pose_.on_belief(belief); });
    bus_.subscribe<sensor_msgs::CameraInfo>(topics::kFrontInfo, [this](const auto& info) { eye_.know(info); });
    bus_.subscribe<sensor_msgs::Image>(topics::kFrontImage, [this](const auto& image) { see(image); });
    bus_.subscribe<sensor_msgs::CompressedImage>(topics::kFrontPicture, [this](const auto& image) { see(image); });
    bus_.subscribe<sensor_msgs::BatteryState>(topics::kBattery,
                                              [this](const auto& battery) { charges_ = is_charging(battery); });
    bus_.subscribe<docent_msgs::DriveGoal>(topics::kDockOrder, [this](const auto& goal) { obey(goal); });
    bus_.every(kDockStep, [this] { step(); });
    bus_.every(kSay, [this] { say(); });
  }

  [[nodiscard]] ModuleHealth health() const override {
    const std::string reason = eye_.complaint(bus_.now());
    return reason.empty() ? ModuleHealth{} : ModuleHealth{"degraded", reason};
  }

 private:
  template <class Picture>
  void see(const Picture& picture) {
    const Time taken = sensor_time_.of(kFrontCamera, picture.header);
    if (eye_.see(bus_.now(), taken, picture)) tell_pose(taken);
  }

  void tell_pose(Time taken) {
    const auto line = eye_.line(bus_.now());
    if (!line) return;
    geometry_msgs::PoseWithCovarianceStamped message;
    message.header = {to_message(taken), "odom"};
    message.pose.pose = to_message(trail_.in_raw(line->odom_from_tag, taken));
    // Its place along its axis is known about as well as across: both come of the same corners.
    const double across = line->across_sigma * line->across_sigma;
    message.pose.covariance[0] = message.pose.covariance[7] = across;
    message.pose.covariance[35] = line->heading_sigma * line->heading_sigma;
    poses_.publish(std::move(message));
  }

  void obey(const docent_msgs::DriveGoal& goal) {
    if (order_ && order_->id == goal.id) return;
    order_.reset();
    if (!goal.id.empty()) {
      order_.emplace(DockOrder{goal.id,
                               {goal.x, goal.y, Angle::radians(goal.theta)},
                               bus_.now(),
                               DockApproach{params_.approach(), bus_.now()}});
      eye_.forget();
    }
    say();
  }

  void end(const char* how, std::string why) {
    order_->over = how;
    order_->why = std::move(why);
    wishes_.publish({{to_message(bus_.now()), "base_link"}, 0.0, 0.0});
    say();
  }

  void step() {
    if (!order_ || !order_->over.empty() || trail_.empty()) return;
    const Time now = bus_.now();
    const auto odom_from_base = trail_.at(now);
    const auto map_from_base = pose_.map_from_base_at(now);
    if (!odom_from_base || !map_from_base) return end("unreachable", "it does not know its place");
    if (now - order_->begun > seconds(params_.try_s)) return end("unreachable", "it takes too long");
    const Pose2 odom_from_expected =
        *odom_from_base * inverse(*map_from_base) * order_->map_from_charger * params_.charger_from_tag();
    eye_.expect(odom_from_expected);
    const auto line = eye_.line(now);
    const std::string complaint = eye_.complaint(now);
    if (!line && !complaint.empty()) return end("unreachable", complaint);
    planning::DockApproachView view{*odom_from_base, odom_from_expected, std::nullopt, charges_ == true};
    // The contacts' line is the tag's, shifted.
    const Pose2 tag_from_line{0.0, params_.beside, {}};
    if (line) view.odom_from_tag = line->odom_from_tag * tag_from_line;
    const DockApproach::Command command = order_->approach.step(view, now);
    if (order_->approach.state() == DockApproach::State::docked) return end("arrived", "");
    if (order_->approach.state() == DockApproach::State::failed)
      return end("unreachable",
                 line ? "no current at the contacts" : "it sees no tag " + std::to_string(params_.tag.id));
    wishes_.publish({{to_message(now), "base_link"}, command.speed, command.turn});
  }

  void say() {
    const Time now = bus_.now();
    docent_msgs::GoalState state;
    state.header = {to_message(now), "map"};
    state.state = "idle";
    if (order_) {
      state.id = order_->id;
      state.state = order_->over.empty() ? "driving" : order_->over;
      state.reason = order_->why;
    } else if (const std::string complaint = eye_.complaint(now); !complaint.empty()) {
      state.state = "unreachable";
      state.reason = complaint;
    }
    states_.publish(std::move(state));
  }

  transport::Bus& bus_;
  DockParams params_;
  DockEye eye_;
  SensorTime sensor_time_{bus_};
  PoseTracker pose_;
  localization::OdometryTrail trail_;
  transport::Publisher<docent_msgs::Drive> wishes_;
  transport::Publisher<docent_msgs::GoalState> states_;
  transport::Publisher<geometry_msgs::PoseWithCovarianceStamped> poses_;
  std::optional<bool> charges_;  ///< by the battery
  std::optional<DockOrder> order_;
};

/// A robot without such a camera.
class NoDock final : public Module {};

}  // namespace

Result<std::unique_ptr<Module>> make_dock(const ModuleContext& context) {
  auto params = context.config.section<DockParams>("dock");
  if (!params) return tl::unexpected<Error>(params.error());
  if (!params->enabled) return std::make_unique<NoDock>();
  return std::make_unique<DockModule>(context, *params);
}

Result<robot::ParameterRows> parameters_of_dock(const robot::RobotConfig& config) {
  return robot::list_parameters<DockParams>(config, "dock");
}

}  // namespace docent::modules
